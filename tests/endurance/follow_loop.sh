#!/usr/bin/env bash
# Follows a drawn walk that goes round and round: memory, time and places stay what they were. See follow_loop.py.
#   RETRACE=build/release/bin/retrace bash tests/endurance/follow_loop.sh [--frames 2000000]
exec nice -n 15 python3 "$(dirname "$0")/follow_loop.py" "$@"
