"""Max-F1 over search ranges and sequence lengths, drawn with matplotlib [SSS Fig. 8].

    python3 sweep_ranges.py night.mp4 day.mp4 night.csv day.csv heat_map.png

The last two are truth.csv of the walks, as `retrace simulate` writes them.
"""

import sys

import matplotlib
import numpy as np

import retrace

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

night, day, night_csv, day_csv, output = sys.argv[1:6]
ranges, lengths = (0.0, 0.2, 0.4, 0.6), (5, 10, 20, 40)
route = retrace.build(day, truth=day_csv)
walk = retrace.read_walk(night, route)
table = np.array([[retrace.evaluate(retrace.localise(route, walk, search="lines", search_range_rad=r, sequence_length=n),
                                    query_truth=night_csv, reference_truth=day_csv, tolerance_m=4)["max_f1"]
                   for r in ranges] for n in lengths])
plt.imshow(table, vmin=0, vmax=1)
plt.xticks(range(len(ranges)), ranges)
plt.yticks(range(len(lengths)), lengths)
plt.xlabel("search range, rad")
plt.ylabel("sequence length, keyframes")
for (row, column), value in np.ndenumerate(table):
    plt.text(column, row, f"{value:.2f}", ha="center", va="center", color="white" if value < 0.6 else "black")
plt.savefig(output)
print(f"best {table.max():.3f}; see {output}")
