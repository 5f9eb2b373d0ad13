#!/usr/bin/env bash
# From a fresh Debian 12 machine to a first result: installs what is missing, builds, and runs the whole road on a walk by
# day and one by night that the program draws itself.
#   bash apps/quickstart.sh [FOLDER]     results go to FOLDER, by default out/quickstart
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

bash apps/setup.sh
cmake --preset release -DRETRACE_BUILD_TESTS=OFF -DRETRACE_BUILD_BENCHMARKS=OFF >/dev/null
cmake --build --preset release --target retrace
build/release/bin/retrace demo -o "${1:-out/quickstart}" --force
