#!/usr/bin/env bash
# Compiles every header of the named folders by itself: each must include all that it uses.
#
#   headers_alone.sh ROOT FOLDER...    folders relative to ROOT, from where headers include each other
#
# All headers are submodules of one Clang module. The compiler parses each of them as if no other came before it, but parses
# the standard library, a module as well, only once: 500 headers take about 10 seconds of one processor.
set -euo pipefail
root=$(realpath "$1")
shift
compiler=${CLANGXX:-clang++-16}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

mapfile -t headers < <(cd "$root" && find "$@" -name '*.h' | LC_ALL=C sort)
((${#headers[@]} > 0)) || { echo "headers_alone.sh: no headers in $*" >&2; exit 1; }

# The headers of the standard library that the project includes, as "<vector>" a line.
standard_headers() {
  (cd "$root" && grep -hoE '^#include <[a-z_0-9]+>' "${headers[@]}") | sort -u | cut -d' ' -f2
}

# Where the compiler finds them: the last path of each "#include" that -H lists with one dot.
standard_paths() {
  standard_headers | sed 's/^/#include /' | "$compiler" -std=c++20 -x c++ -fsyntax-only -H - 2>&1 | sed -n 's/^\. //p'
}

{
  echo 'module std [system] {'
  while read -r path; do
    echo "  module \"$(basename "$path")\" { header \"$path\" export * }"
  done < <(standard_paths)
  echo '}'
  echo 'module project {'
  for header in "${headers[@]}"; do
    echo "  module \"$header\" { header \"$root/$header\" export * }"
  done
  echo '}'
} >"$work/headers.modulemap"

echo "#include \"${headers[0]}\"" >"$work/all.cpp"
# hearth.hpp is found as users of the installation find it
"$compiler" -std=c++20 -I"$root" -I"$root/runtime/c" -Wall -Wextra -Werror -fsyntax-only -ferror-limit=0 \
  -fmodules -fmodules-cache-path="$work/cache" -fmodule-map-file="$work/headers.modulemap" "$work/all.cpp"
echo "${#headers[@]} headers compile alone"
