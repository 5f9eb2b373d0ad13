#!/usr/bin/env bash
# `retrace build` against bare decoding by ffmpeg, one after the other on the same machine.
#   tests/bench/throughput.sh WALK.mp4
set -euo pipefail
retrace=${RETRACE:-"$(dirname "${BASH_SOURCE[0]}")/../../build/release/bin/retrace"}
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
seconds() { local start; start=$(date +%s.%N); "$@" >/dev/null 2>&1; echo "$(date +%s.%N) - $start" | bc; }
for round in 1 2 3; do
  rm -f "$folder/route.db"
  build=$(seconds "$retrace" build "$1" -o "$folder/route.db")
  decode=$(seconds ffmpeg -v error -i "$1" -f null -)
  echo "round $round: retrace build $build s, ffmpeg -f null $decode s, ratio $(echo "scale=2; $build / $decode" | bc)"
done
