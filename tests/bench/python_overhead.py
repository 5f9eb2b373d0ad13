#!/usr/bin/env python3
"""What `retrace.search` takes beside the call of the library that it makes, on 3576 x 3576 costs, one thread.

    PYTHONPATH=build/release/python /usr/bin/python3 tests/bench/python_overhead.py [METHOD]

Both are run in turn, five times; printed are the least processor times, and the share by which Python's is longer, for costs
that a call of retrace gave and for an array of numpy, which is read where it is.
"""

import json
import pathlib
import subprocess
import sys
import tempfile
import time

import numpy
import retrace

BENCH = pathlib.Path(__file__).resolve().parents[2] / "build" / "release" / "bin" / "search_bench"
SIZE = 3576


def cpu_s(call):
    start = time.process_time()
    call()
    return time.process_time() - start


def bench_s(costs, method):
    run = subprocess.run([BENCH, "--costs", costs, f"--benchmark_filter=^surely/{method}/", "--benchmark_min_time=0.2",
                          "--benchmark_format=json"], stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, check=True)
    return json.loads(run.stdout)["benchmarks"][0]["cpu_time"] / 1e3


def main():
    method = sys.argv[1] if len(sys.argv) > 1 else "path"
    costs = numpy.random.default_rng(1).standard_normal((SIZE, SIZE), dtype=numpy.float32)
    costs[numpy.arange(SIZE), numpy.arange(SIZE)] -= 3
    given = retrace.enhance(costs, method="none")
    retrace.set_threads(1)
    least = {"library": [], "retrace's costs": [], "numpy's array": []}
    with tempfile.TemporaryDirectory() as folder:
        file = pathlib.Path(folder) / "costs.npy"
        numpy.save(file, costs)
        for _ in range(5):
            least["library"].append(bench_s(file, method))
            for name, argument in (("retrace's costs", given), ("numpy's array", costs)):
                least[name].append(min(cpu_s(lambda argument=argument: retrace.search(argument, method=method, sequence_length=10))
                                       for _ in range(3)))
    library = min(least["library"])
    for name, times in least.items():
        print(f"{name:16s} {min(times) * 1e3:8.1f} ms  {100 * (min(times) / library - 1):+5.1f} %")


if __name__ == "__main__":
    main()
