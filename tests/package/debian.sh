#!/usr/bin/env bash
# Makes the Debian packages of a build, checks them with lintian, and uses what is in them; in a bare chroot too if asked.
#   debian.sh BUILD WORK     a build tree of everything, and a folder to use
# RETRACE_CHROOT=1 installs and runs them in a new Debian made by debootstrap: needs root, the network and minutes.
# Exits 77, which ctest shows as skipped, where dpkg-deb, dpkg-shlibdeps or lintian is missing.
set -euo pipefail
build=$(realpath "$1") work=$2
for tool in dpkg-deb dpkg-shlibdeps lintian; do
  command -v "$tool" >/dev/null || { echo "skipped: $tool is not installed"; exit 77; }
done
rm -rf "$work" && mkdir -p "$work"
work=$(realpath "$work")
(cd "$build" && cpack -B "$work" >"$work/cpack.log" 2>&1) || { cat "$work/cpack.log"; exit 1; }

for package in retrace libretrace-dev python3-retrace; do
  compgen -G "$work/${package}_*.deb" >/dev/null || { echo "$package was not made"; exit 1; }
  dpkg-deb -x "$work/${package}"_*.deb "$work/root"
done
# The project has no address for mail.
lintian --fail-on error --suppress-tags bogus-mail-host "$work"/*.deb

echo "-- the program, its manual and completions"
root=$work/root/usr
"$root/bin/retrace" --version
zcat "$root/share/man/man1/retrace-localise.1.gz" | grep -q -- '--route\|\\-\\-route'
for command in $("$root/bin/retrace" --help | sed -n '/^Subcommands:/,/^$/s/^  \([a-z-]\+\) .*/\1/p'); do
  [[ -f "$root/share/man/man1/retrace-$command.1.gz" ]] || { echo "no manual of $command"; exit 1; }
done
bash -n "$root/share/bash-completion/completions/retrace"

echo "-- the libraries, by pkg-config"
export PKG_CONFIG_PATH=$(dirname "$(find "$root/lib" -name retrace.pc)")
flags=$(pkg-config --define-variable=prefix="$root" --cflags --libs retrace)
# shellcheck disable=SC2086
g++ -std=c++20 -O1 "$(dirname "${BASH_SOURCE[0]}")/consumer.cpp" -o "$work/consumer" $flags
"$work/consumer"

echo "-- the Python module"
PYTHONPATH=$root/lib/python3/dist-packages /usr/bin/python3 -c \
  "import numpy, retrace; print('retrace', retrace.__version__, retrace.cost_matrix(numpy.zeros((2, 8), numpy.uint8), numpy.zeros((3, 8), numpy.uint8)).shape)"

if [[ "${RETRACE_CHROOT:-}" != 1 ]]; then
  echo "-- no chroot: RETRACE_CHROOT=1 asks for it"
  exit 0
fi
chroot=$work/chroot
debootstrap --variant=minbase bookworm "$chroot" >"$work/debootstrap.log"
cp "$work"/*.deb "$chroot/tmp/"
mount -t proc proc "$chroot/proc"  # the loader asks it where the program is
trap 'umount "$chroot/proc"' EXIT
chroot "$chroot" bash -c 'export DEBIAN_FRONTEND=noninteractive; apt-get update -qq && apt-get install -y -qq --no-install-recommends /tmp/*.deb >/tmp/apt.log &&
  retrace --version && retrace demo -o /root/demo >/dev/null && test -n "$(find /root/demo -name matches.csv)" &&
  python3 -c "import retrace; print(retrace.__version__)"'
echo "-- installed and run in a bare Debian"
