#!/usr/bin/env bash
# Installs what is missing of the Debian packages that retrace needs. Sourced by quickstart.sh and tests/run.sh.
#   setup.sh [--tests | --benches]     with --tests also what the tests need, with --benches what the benches compare with
set -euo pipefail

packages=(cmake g++ ninja-build libopencv-dev libavformat-dev libswscale-dev libeigen3-dev libceres-dev libsqlite3-dev libpugixml-dev libexiv2-dev libcli11-dev nlohmann-json3-dev
  libspdlog-dev libfmt-dev libflann-dev liblz4-dev libcpp-httplib-dev libjs-chart.js)
if [[ "${1:-}" == --tests ]]; then
  packages+=(libgtest-dev libgmock-dev clang-format clang-tidy clang-14 libclang-rt-14-dev python3 python3-dev python3-numpy python3-pytest python3-matplotlib python3-opencv pybind11-dev ffmpeg bc
    chromium chromium-driver python3-selenium lintian dpkg-dev file slurmctld slurmd slurm-client munge openmpi-bin libopenmpi-dev g++-aarch64-linux-gnu libc6-dev-arm64-cross qemu-user-static)
fi
if [[ "${1:-}" == --benches ]]; then
  packages+=(libbenchmark-dev libdlib-dev libfaiss-dev ffmpeg bc python3)
fi

missing=()
for package in "${packages[@]}"; do
  dpkg-query -W -f='${Status}' "$package" 2>/dev/null | grep -q 'install ok installed' || missing+=("$package")
done
if ((${#missing[@]} > 0)); then
  echo "installing: ${missing[*]}"
  as_root=()
  [[ $EUID -eq 0 ]] || as_root=(sudo)
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
fi
