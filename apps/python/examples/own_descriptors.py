"""Sequence search over the descriptors of any model: two .npy files of one row for each picture, in order of the walk.

    python3 own_descriptors.py query.npy reference.npy [true_reference.npy]

`retrace describe` writes such files too. With the true reference index of each query (NaN where there is none), prints precision and
recall, with single pictures beside sequences.
"""

import sys

import numpy as np

import retrace

query, reference = np.load(sys.argv[1]), np.load(sys.argv[2])
costs = retrace.enhance(retrace.cost_matrix(query, reference))
for length in (1, 10):
    found = retrace.search(costs, sequence_length=length)
    print(f"sequences of {length}: {np.sum(found.probability >= 0.95)} of {len(query)} at a probability of 0.95 or more")
    if len(sys.argv) > 3:
        metrics = retrace.evaluate_matches(found.reference, found.score, np.load(sys.argv[3]), tolerance=2)
        print(f"  max-F1 {metrics['max_f1']:.3f}, precision {metrics['precision']:.3f}, recall {metrics['recall']:.3f}")
