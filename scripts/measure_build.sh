#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Measures what building takes, as rows of benchmark/results/build.md:
#
#   scripts/measure_build.sh [PART...]    all parts, or those named
#
#   sample    README's program in C++, with the library and header-only: CPU seconds and memory of the compiler
#   program   the size of mixed_mesh_3, stripped
#   driver    how many objects of the Release build have the driver
#   fitting   a header of the fitting changes: until its tests have been built and run
#   test      scripts/test.sh in a fresh clone, without a compiler cache
#   ci        .ci/run in a fresh clone, with an empty compiler cache, and again in another clone with what that left
#
# All but the last two use build/release, with all built. The last two take up to an hour together. Wall times are for
# a machine that does nothing else.

set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
build=$PWD/build/release
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# Prints a row: what a command took, as /usr/bin/time has it in a format.
row() {
  local name=$1 format=$2
  shift 2
  if ! /usr/bin/time --format "$format" --output "$work/time" "$@" > "$work/log" 2>&1; then
    tail -n 40 "$work/log" >&2
    echo "measure_build.sh: error: $name failed" >&2
    return 1
  fi
  echo "| $name | $(tail -n 1 "$work/time") |"
}

measure_sample() {
  local -a flags=(-std=c++17 -O3 -DNDEBUG -DCGAL_USE_ZLIB -DCGAL_LINKED_WITH_TBB -Iinclude -isystem
    /usr/include/eigen3 -c "$work/sample.cpp" -o "$work/sample.o")
  # shellcheck disable=SC2016 # those are backquotes of Markdown
  sed -n '/^## In C++/,/^## In Python/{/^```cpp/,/^```$/{/^```/!p}}' README.md > "$work/sample.cpp"
  row "sample with the library" "%U CPU s, %M kB" g++ -DCGAL_MIXED_MESH_3_COMPILED "${flags[@]}"
  row "sample header-only" "%U CPU s, %M kB" g++ "${flags[@]}"
}

measure_program() {
  strip -o "$work/program" "$build/bin/mixed_mesh_3"
  echo "| mixed_mesh_3, stripped | $(stat --format %s "$work/program") bytes |"
}

measure_driver() {
  local count=0 object
  while read -r object; do
    if nm --demangle "$object" | grep ' [TW] .*internal::mesh_domain(' > /dev/null; then
      count=$((count + 1))
    fi
  done < <(find "$build" -name '*.o')
  echo "| objects with the driver | $count |"
}

measure_fitting() {
  touch include/CGAL/Mixed_mesh_3/internal/moves/flips.h
  row "flips.h touched: test_fitting built and run" "%e s, %U CPU s" env CCACHE_DISABLE=1 bash -c "
    cmake --build '$build' --target test_fitting && ctest --test-dir '$build' -R '^test_fitting' -j $(nproc)"
}

measure_test() {
  git clone --quiet . "$work/clone"
  row "scripts/test.sh, fresh clone, no compiler cache" "%e s, %U CPU s" env NO_CCACHE=1 "$work/clone/scripts/test.sh"
  rm -rf "$work/clone"
}

measure_ci() {
  local cache
  for cache in empty warm; do
    git clone --quiet . "$work/clone-$cache"
    row ".ci/run, fresh clone, $cache compiler cache" "%e s, %U CPU s" env CCACHE_DIR="$work/cache" \
      "$work/clone-$cache/.ci/run"
    rm -rf "$work/clone-$cache"
  done
}

[[ $# -gt 0 ]] || set -- sample program driver fitting test ci
echo "| $(git rev-parse --short HEAD), load $(cut -d ' ' -f 1 /proc/loadavg) | |"
echo "|---|--:|"
for part in "$@"; do
  "measure_$part"
done
