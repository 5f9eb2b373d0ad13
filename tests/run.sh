#!/usr/bin/env bash
# Installs what is missing, builds, and runs every test.
#   bash tests/run.sh [ctest options]    for example: bash tests/run.sh -L unit
# RETRACE_PRESET=asan takes another preset; RETRACE_WERROR=ON makes warnings errors; RETRACE_DATA names the folder of
# recordings that the `data` tests read (they are skipped, and say so, without it).
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

preset=${RETRACE_PRESET:-release}
bash apps/setup.sh --tests
python=(-DRETRACE_BUILD_PYTHON=ON -DPython3_EXECUTABLE=/usr/bin/python3)  # Debian's, which has numpy and pytest
[[ "$preset" == release ]] || python=()
cmake --preset "$preset" "${python[@]}" -DRETRACE_BUILD_TESTS=ON -DRETRACE_WERROR="${RETRACE_WERROR:-OFF}" >/dev/null
cmake --build --preset "$preset"
ctest --preset "$preset" "$@"
