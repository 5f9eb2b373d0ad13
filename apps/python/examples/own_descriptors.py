"""Sequence search over the descriptors of any model: two .npy files of one row for each picture, in order of the walk.

    python3 own_descriptors.py query.npy reference.npy [true_reference.npy]

`retrace describe` writes such files too. With the true reference index of each query (NaN where there is none), prints precision and
recall: of single pictures, of sequences, and of the path through the whole walk, which is the default.
"""

import sys

import numpy as np

import retrace

query, reference = np.load(sys.argv[1]), np.load(sys.argv[2])
costs = retrace.enhance(retrace.cost_matrix(query, reference))
for name, settings in (("single pictures", {"method": "lines", "sequence_length": 1}),
                       ("sequences of 10", {"method": "lines", "sequence_length": 10}), ("path", {"method": "path"})):
    found = retrace.search(costs, **settings)
    print(f"{name}: {np.sum(found.probability >= 0.95)} of {len(query)} at a probability of 0.95 or more")
    if len(sys.argv) > 3:
        metrics = retrace.evaluate_matches(found.reference, found.score, np.load(sys.argv[3]), tolerance=2)
        print(f"  max-F1 {metrics['max_f1']:.3f}, precision {metrics['precision']:.3f}, recall {metrics['recall']:.3f}")
