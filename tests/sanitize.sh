#!/usr/bin/env bash
# The unit tests of the libraries under sanitizers, those that are quick enough: tests of whole walks take minutes here and
# are left to the other builds, as is the one test that opens a camera (libusb, which OpenCV asks for cameras, leaks).
#   bash tests/sanitize.sh [asan | tsan] [gtest filter]     by default asan, all but the slow ones
# asan: AddressSanitizer and UndefinedBehaviorSanitizer. tsan: ThreadSanitizer, four threads in every test, and the program's
# tests too; what it does not see is in tests/tsan.supp.
# Only the libraries are instrumented, so the object files of the tests are those of build/release where that is there.
# One process for each core, at most RETRACE_SANITIZE_S seconds (default 180); what was not reached is no failure.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=asan
case ${1:-} in asan | tsan) preset=$1 && shift ;; esac
slow=MonocularVo.*:SceneTracking.MeasuresTheHeight*:RouteDatabase.AnyDamage*:SearchStreamed.*:FixedLag.IsAsGood*:LocaliserTest.Shrinks*
camera=FrameSource.RefusesACamera*
tests=(unit_tests)
export OMP_WAIT_POLICY=passive  # the shards' threads leave each other the cores
if [[ $preset == tsan ]]; then
  tests+=(program_tests)
  slow+=:SweepTest.*:CompareMethods.*:PartSearches.FindLinesThatCross*:DotKernels.DoNotOverflow  # minutes each
  export OMP_NUM_THREADS=4 TSAN_OPTIONS=suppressions=$PWD/tests/tsan.supp
fi
objects=
if [[ -d build/release/tests ]]; then
  cmake --preset release -DRETRACE_BUILD_TESTS=ON >/dev/null
  cmake --build --preset release --target unit_tests
  objects=$PWD/build/release/tests/CMakeFiles/unit_tests.dir
fi
cmake --preset "$preset" -DRETRACE_BUILD_TESTS=ON -DRETRACE_UNIT_TEST_OBJECTS="$objects" >/dev/null
cmake --build --preset "$preset" --target "${tests[@]}"

GTEST_TOTAL_SHARDS=$(nproc)
export GTEST_TOTAL_SHARDS
status=0
for program in "${tests[@]}"; do
  shards=()
  for ((shard = 0; shard < GTEST_TOTAL_SHARDS; ++shard)); do
    GTEST_SHARD_INDEX=$shard timeout "${RETRACE_SANITIZE_S:-180}" "build/$preset/bin/$program" --gtest_brief=1 \
      --gtest_filter="${1:--$slow:$camera}" &
    shards+=($!)
  done
  for shard in "${shards[@]}"; do
    result=0
    wait "$shard" || result=$?
    case $result in
      0) ;;
      124) echo "time is up; the last tests were not run" ;;
      *) status=$result ;;
    esac
  done
done
exit "$status"
