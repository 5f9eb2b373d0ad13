#!/usr/bin/env python3
"""How right the probabilities of matches are, and which search finds most: a table over all walks.

    RETRACE_DATA=... python3 tests/data/certainty.py [--descriptor blocks thumbnail] [--search lines path ...]
                                                     [--sequence-length 10] [--walks park footpath ...]

Every pair of walks is taken in both directions. Prints, for each pair and search, the max-F1, the expected calibration error
(ten bins of equal counts), and the precision and recall of what is accepted at 0.90, 0.95 and 0.99, beside the best recall
that any threshold of the score reaches at that precision; then the same of all pairs together. Only needs Python.
"""

import argparse
import os
import pathlib
import sys
import tempfile
from dataclasses import dataclass, field

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from support.retrace_cli import SOURCE, check, rows  # noqa: E402

DATA = pathlib.Path(os.environ.get("RETRACE_DATA", SOURCE.parent / "shared" / "data"))
ASKED = (0.90, 0.95, 0.99)
SEARCHES = ("lines", "cone", "hybrid", "graph", "path")
VANILLA = ("--motion", "none", "--every", 1)


@dataclass
class Pair:
    name: str
    reference: pathlib.Path
    query: pathlib.Path
    truth: tuple
    build: tuple = ()


@dataclass
class Matched:
    """A query keyframe with a match: its score, its probability if it has one, and whether it is right."""

    score: float
    probability: float | None
    right: bool


@dataclass
class Outcome:
    with_truth: int = 0  # queries that have a true place
    matches: list = field(default_factory=list)

    def add(self, other):
        self.with_truth += other.with_truth
        self.matches += other.matches

    def thresholds(self):
        """(accepted, right ones among them) at every distinct score, the surest first."""
        ordered = sorted(self.matches, key=lambda m: -m.score)
        right = 0
        for i, match in enumerate(ordered):
            right += match.right
            if i + 1 == len(ordered) or ordered[i + 1].score != match.score:
                yield i + 1, right

    def max_f1(self):
        return max((2 * right / (accepted + self.with_truth) for accepted, right in self.thresholds()), default=0)

    def best_recall(self, precision):
        return max((right / self.with_truth for accepted, right in self.thresholds() if right >= precision * accepted), default=0)

    def accepted(self, probability):
        """Precision (none of nothing) and recall."""
        taken = [m for m in self.matches if m.probability is not None and m.probability >= probability]
        right = sum(m.right for m in taken)
        return (right / len(taken) if taken else None, right / self.with_truth if self.with_truth else 0)

    def calibration_error(self, bins=10):
        known = sorted((m for m in self.matches if m.probability is not None), key=lambda m: m.probability)
        count, error = min(bins, len(known)), 0
        for i in range(count):
            group = known[i * len(known) // count:(i + 1) * len(known) // count]
            error += abs(sum(m.probability for m in group) - sum(m.right for m in group))
        return error / len(known) if known else None


def outcome(run, tolerance):
    """Of a folder that `localise` and `evaluate` wrote."""
    result = Outcome()
    for match, error in zip(rows(run / "matches.csv"), rows(run / "errors.csv")):
        result.with_truth += error["has_truth"] == "1"
        if match["reference_frame"]:
            right = error["error"] != "" and float(error["error"]) <= tolerance
            probability = float(match["probability"]) if match["probability"] else None
            result.matches.append(Matched(float(match["score"]), probability, right))
    return result


def both_ways(name, a, b, truth_ab, truth_ba, build=()):
    return [Pair(name, a, b, truth_ab, build), Pair(name + ", the other way", b, a, truth_ba, build)]


def turned(pairs, folder):
    """Landmarks of the query taken for the reference."""
    path = folder / f"{len(list(folder.iterdir()))}.csv"
    lines = [f"{row['reference_frame']},{row['query_frame']}" for row in rows(pairs)]
    path.write_text("query_frame,reference_frame\n" + "\n".join(lines) + "\n")
    return path


def real_pairs(folder):
    found = []
    for name, where, a, b, tolerances in (("park", "stromovka", "autumn", "winter", (1, 1)),
                                          ("office corridor", "corridor", "reference", "query", (2, 2)),
                                          ("Nordland", "nordland_64x32", "summer", "winter", (2, 2))):
        pairs = DATA / where / "pairs.csv"
        truths = [("--pairs", p, "--tolerance-frames", t) for p, t in zip((pairs, turned(pairs, folder)), tolerances)]
        found += both_ways(name, DATA / where / a, DATA / where / b, *truths, VANILLA)
    pairs = DATA / "gopro_footpath" / "pairs.csv"
    # A metre: 17 frames of the one walk, 25 of the other.
    found += both_ways("footpath", DATA / "gopro_footpath" / "reference.mp4", DATA / "gopro_footpath" / "query.mp4",
                       ("--pairs", pairs, "--tolerance-frames", 17), ("--pairs", turned(pairs, folder), "--tolerance-frames", 25))
    return found


def drawn_pairs():
    found = []
    for name, a, b in (("street", "street_day", "street_night"), ("corridor", "corridor_a", "corridor_b")):
        a, b = DATA / "sim" / a, DATA / "sim" / b

        def truth(query, reference):
            return ("--query-truth", query.with_suffix(".csv"), "--reference-truth", reference.with_suffix(".csv"), "--tolerance-m", 4)
        found += both_ways(f"drawn {name}", a.with_suffix(".mp4"), b.with_suffix(".mp4"), truth(b, a), truth(a, b))
    return found


def number(value):
    return "-" if value is None else f"{value:.3f}"


def row_of(name, search, result):
    cells = [name, search, number(result.max_f1()), number(result.calibration_error())]
    for asked in ASKED:
        precision, recall = result.accepted(asked)
        cells.append(f"{number(precision)}, {number(recall)} of {number(result.best_recall(asked))}")
    return "| " + " | ".join(cells) + " |"


def measure(pair, search, folder, descriptor, *localise):
    route, run = folder / "route.db", folder / "run"
    route.unlink(missing_ok=True)  # a walk that is built onto a route is added to it
    check("build", pair.reference, "-o", route, *pair.build, "--descriptor", descriptor)
    check("localise", pair.query, "--route", route, "-o", run, "--force", "--search", search, *localise)
    check("evaluate", run, *pair.truth)
    return outcome(run, pair.truth[-1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--descriptor", nargs="+", default=["blocks", "thumbnail"])
    parser.add_argument("--search", nargs="+", default=SEARCHES, choices=SEARCHES)
    parser.add_argument("--sequence-length", type=int, default=10)
    parser.add_argument("--walks", nargs="+", default=[], help="only pairs whose name has one of these in it")
    options = parser.parse_args()
    if not DATA.is_dir():
        print(f"skipped: no data folder {DATA}; set RETRACE_DATA")
        return 77
    with tempfile.TemporaryDirectory(prefix="retrace-certainty-") as name:
        folder = pathlib.Path(name)
        (folder / "pairs").mkdir()
        pairs = real_pairs(folder / "pairs") + drawn_pairs()
        print("| walks | `--search` | max-F1 | calibration error | " + " | ".join(f"at {p:.2f}: precision, recall of best" for p in ASKED) + " |")
        print("|---" * (4 + len(ASKED)) + "|")
        for descriptor in options.descriptor:
            together = {search: Outcome() for search in options.search}
            for pair in pairs:
                if options.walks and not any(word in pair.name for word in options.walks):
                    continue
                for search in options.search:
                    result = measure(pair, search, folder, descriptor, "--sequence-length", options.sequence_length)
                    together[search].add(result)
                    print(row_of(f"{pair.name}, {descriptor}", search, result), flush=True)
            for search in options.search:
                print(row_of(f"all, {descriptor}", search, together[search]), flush=True)
    return 0


if __name__ == "__main__":
    sys.exit(main())
