#!/usr/bin/env bash
# Builds libFuzzer's targets with Clang and runs each on its reader, as many at a time as there are cores; fails on any
# finding, which stays in build/fuzz/findings. What is found is mended and becomes a unit test.
#   bash tests/fuzz/run.sh SECONDS [target ...]     by default all of them, each for so many seconds
# Inputs that reached something new stay in build/fuzz/corpus, and the next run begins with them. With
# RETRACE_FUZZ_RUNS=N each stops after N executions, or after SECONDS. RETRACE_FUZZ_SEED=N makes runs alike; CI has one, so
# that a change answers for what it changed and not for its luck.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

export seconds=${1:?seconds for each target} fuzz=$PWD/build/fuzz
shift
cmake --preset fuzz >/dev/null
cmake --build --preset fuzz
mkdir -p "$fuzz/findings" "$fuzz/logs"
"$fuzz/bin/make_seeds" "$fuzz/seeds"
targets=("$@")
((${#targets[@]} > 0)) || mapfile -t targets < <(cd "$fuzz/bin" && printf '%s\n' fuzz_* | sed 's/^fuzz_//')

# Files are in memory, in a folder that goes whatever happens.
RETRACE_FUZZ_FOLDER=$(mktemp -d /dev/shm/retrace-fuzz-XXXXXX || mktemp -d)
export RETRACE_FUZZ_FOLDER
trap 'rm -rf "$RETRACE_FUZZ_FOLDER"' EXIT
export ASAN_OPTIONS=quarantine_size_mb=16:malloc_context_size=8:allocator_release_to_os_interval_ms=-1

run() {
  local target=$1 dictionary=binary longest=4096 status=0 log=$fuzz/logs/$1
  case $target in
    truth | poses) dictionary=csv ;;
    track) dictionary=xml ;;
    run | report | odometry_report) dictionary=json ;;
    calibration) dictionary=calibration ;;
    pairs) dictionary=pairs ;;
    route_database) longest=65536 ;;  # bytes of an input; the seeds have 13 000
  esac
  dictionary=tests/fuzz/dictionaries/$dictionary.dict
  [[ $target == settings ]] && dictionary=$fuzz/seeds/settings.dict  # their names
  mkdir -p "$fuzz/corpus/$target"
  # Beside the 50 times its file that a reader is held to (fuzz.hpp): at most 80 MB at once, 1 GB with what the sanitizers need.
  "$fuzz/bin/fuzz_$target" -max_total_time="$seconds" -runs="${RETRACE_FUZZ_RUNS:--1}" -seed="${RETRACE_FUZZ_SEED:-0}" -max_len="$longest" -timeout=20 -malloc_limit_mb=80 \
    -rss_limit_mb=1024 -dict="$dictionary" -artifact_prefix="$fuzz/findings/$target-" -print_final_stats=1 \
    "$fuzz/corpus/$target" "$fuzz/seeds/$target" >"$log" 2>&1 </dev/null || status=$?
  if ((status == 0)); then
    echo "$target: $(sed -n 's/^stat::number_of_executed_units: *//p' "$log") executions, $(find "$fuzz/corpus/$target" -type f | wc -l) inputs kept"
  else
    echo "$target: a finding; see $log"
    grep -a -m 3 -E 'FINDING|ERROR:|SUMMARY|runtime error' "$log" || true
  fi
  return "$status"
}
export -f run
printf '%s\n' "${targets[@]}" | xargs -P "$(nproc)" -I{} bash -c 'run {}'
