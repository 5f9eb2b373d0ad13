#!/usr/bin/env bash
# clang-tidy with the committed .clang-tidy on the sources that changed; fails if it finds anything.
#   bash tests/tidy.sh [REVISION]    since REVISION, by default where this branch left main, or the last ten commits on main
# Newest changes first, at most RETRACE_TIDY_S seconds (default 240); what was not reached is said.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

since=${1:-$(git merge-base HEAD origin/main 2>/dev/null || git rev-parse HEAD)}
[[ $(git rev-parse "$since") != $(git rev-parse HEAD) ]] || since=$(git rev-list --max-count=11 HEAD | tail -1)
cmake --preset dev -DRETRACE_BUILD_TESTS=OFF >/dev/null  # whose files are compiled one by one

# Newest first; a header counts as its source.
mapfile -t changed < <(git log --format= --name-only "$since..HEAD" -- 'libvo/*' 'libplace/*' 'apps/*' |
  sed -E 's,(libvo|libplace)/include/(vo|place)/(.*)\.hpp$,\1/src/\3.cpp,; s,\.hpp$,.cpp,' | grep '\.cpp$' | awk '!seen[$0]++')
files=()
for file in "${changed[@]}"; do
  [[ -f $file ]] && grep -q "/$file\"" build/dev/compile_commands.json && files+=("$file")
done
echo "clang-tidy on ${#files[@]} files changed since $(git rev-parse --short "$since")"

status=0
printf '%s\n' "${files[@]}" | timeout "${RETRACE_TIDY_S:-240}" xargs -r -P "$(nproc)" -I{} bash -c \
  'clang-tidy --quiet --warnings-as-errors="*" -p build/dev "$1" 2>/dev/null && echo "clean: $1"' _ {} || status=$?
case $status in
  0) ;;
  124) echo "time is up; the older changes were not checked" ;;
  *) exit 1 ;;
esac
