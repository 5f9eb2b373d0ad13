#!/usr/bin/env bash
# What takes too long for CI; its last figures stand in tests/RESULTS.md. Needs build/release (`bash tests/run.sh` makes it).
#   bash tests/endurance/run.sh [part ...]     by default all: fuzz threads faults kills readers follow walk routes
# RETRACE_FUZZ_S is the time of each fuzzing target, 600 s unless given.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

bin=$PWD/build/release/bin
export RETRACE=$bin/retrace RETRACE_DISK_SHIM=$bin/disk_shim.so RETRACE_SOURCE_DIR=$PWD
[[ -x "$RETRACE" ]] || { echo "build/release is missing: bash tests/run.sh" >&2; exit 1; }

parts=("$@")
((${#parts[@]} > 0)) || parts=(fuzz threads faults kills readers follow walk routes)
for part in "${parts[@]}"; do
  echo "== $part ($SECONDS s)"
  case $part in
    fuzz) bash tests/fuzz/run.sh "${RETRACE_FUZZ_S:-600}" ;;
    threads) RETRACE_SANITIZE_S=3600 bash tests/sanitize.sh tsan ;;
    faults) RETRACE_FAULTS=all python3 tests/faults/faults_test.py ;;
    kills) python3 tests/endurance/killed_builds.py "$RETRACE" "$RETRACE_DISK_SHIM" ;;
    readers) python3 tests/endurance/many_readers.py "$RETRACE" ;;
    follow) bash tests/endurance/follow_loop.sh ;;
    walk) /usr/bin/python3 tests/endurance/long_walk.py --memory 14G ;;
    routes) /usr/bin/python3 tests/endurance/long_routes.py ;;
    *) echo "no part called $part: fuzz, threads, faults, kills, readers, follow, walk or routes" >&2; exit 2 ;;
  esac
done
