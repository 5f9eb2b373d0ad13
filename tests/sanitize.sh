#!/usr/bin/env bash
# The unit tests of the libraries under AddressSanitizer and UndefinedBehaviorSanitizer, those that are quick enough: tests
# of whole walks take minutes here and are left to the other builds.
#   bash tests/sanitize.sh [gtest filter]     by default all but the slow ones
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

slow=MonocularVo.*:SceneTracking.MeasuresTheHeight*:RouteDatabase.AnyDamage*:SearchStreamed.*:FixedLag.IsAsGood*:LocaliserTest.Shrinks*
cmake --preset asan >/dev/null
cmake --build --preset asan --target unit_tests
ASAN_OPTIONS=detect_leaks=1 build/asan/bin/unit_tests --gtest_brief=1 --gtest_filter="${1:--$slow}"
