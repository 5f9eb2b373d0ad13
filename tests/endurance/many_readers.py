"""Many localisers on one route at once, while builds add walks to it and replace them: every answer must be the one that one
of the versions of the route gives, to the byte.

    many_readers.py RETRACE [READERS] [ROUNDS]
"""

import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "support"))
from retrace_cli import draw_walk, street  # noqa: E402


def main():
    retrace = sys.argv[1]
    readers = int(sys.argv[2]) if len(sys.argv) > 2 else 32
    rounds = int(sys.argv[3]) if len(sys.argv) > 3 else 4
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        wall = street(length=3000)
        for walk, offset in (("a", 0), ("b", 3), ("query", 5)):
            draw_walk(folder / walk, wall, [9.0 * i + offset for i in range(150)])
        route = folder / "route.db"

        def build(walk, *more):
            return [retrace, "build", folder / walk, "-o", route, "--name", walk, *more]

        def localise(run):
            return [retrace, "localise", folder / "query", "--route", route, "-o", folder / run, "--threads", "1"]

        def answer(run):
            return (folder / run / "matches.csv").read_bytes()

        quiet = {"stdout": subprocess.DEVNULL, "stderr": subprocess.DEVNULL}
        subprocess.run(build("a", "--motion", "none", "--every", "1"), check=True, **quiet)
        one = folder / "one.db"
        one.write_bytes(route.read_bytes())
        subprocess.run(localise("before"), check=True, **quiet)
        subprocess.run(build("b"), check=True, **quiet)
        subprocess.run(localise("after"), check=True, **quiet)
        versions = {answer("before"): "of one walk", answer("after"): "of two"}
        counts, wrong, failed = {}, 0, 0
        for r in range(rounds):
            route.write_bytes(one.read_bytes()) if r % 2 == 0 else None
            writer = subprocess.Popen(build("b", "--force"), **quiet)
            running = [(f"run{r}_{i}", subprocess.Popen(localise(f"run{r}_{i}"), **quiet)) for i in range(readers)]
            failed += writer.wait() != 0
            for run, process in running:
                if process.wait() != 0:
                    failed += 1
                elif answer(run) in versions:
                    version = versions[answer(run)]
                    counts[version] = counts.get(version, 0) + 1
                else:
                    wrong += 1
        print(f"{rounds} rounds of {readers} localisers beside a build: answers "
              + ", ".join(f"{kind}: {count}" for kind, count in sorted(counts.items()))
              + f"; neither: {wrong}; failed: {failed}")
        return 0 if wrong == 0 and failed == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
