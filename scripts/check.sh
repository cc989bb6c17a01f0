#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, and checks what a Release build and its tests do not show:
#
#   scripts/check.sh [PART...]            all parts, or those named
#
#   format      C++ and JavaScript are as clang-format 14 makes them with .clang-format; no line is longer than
#               110 columns
#   shell       shell scripts, by shellcheck
#   python      programs in Python, by pyflakes
#   layers      arrows between folders run one way: scripts/check_layers.py
#   doc         the manual, by doxygen; a warning is an error
#   headers     every header compiles alone, without a warning
#   layout      the repository as it would lie in CGAL's tree: scripts/lay_out_as_cgal.py; examples and a test
#               are compiled there, with -Wpedantic, by LAYOUT_COMPILERS (default: g++ clang++), also with the CGAL of
#               CGAL_DIR_61
#   benchmarks  the benchmarks are built
#   debug       the examples run with CGAL's assertions and preconditions
#   sanitize    short tests run with these, AddressSanitizer and UndefinedBehaviorSanitizer
#   fuzz        targets of libFuzzer, one a reader, run for FUZZ_SECONDS each (default: 12), from test/fuzz/corpus;
#               what makes one fail is kept in the build directory
#   cgal61      headers, examples and short tests are built with another CGAL, if CGAL_DIR_61 names the folder
#               that has its include/CGAL/version.h
#
# A part that fails does not keep the next ones from running. BUILD_DIR overrides where the build directories
# are, build/check.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/setup.sh
source "$root/scripts/setup.sh"

build=$(realpath -m "${BUILD_DIR:-$root/build/check}")
parts=(format shell python layers doc headers layout benchmarks debug sanitize fuzz cgal61)

# The tests that sanitizers run. Not those that read a surface or mesh one: with sanitizers, a compiler takes three
# minutes and 4 GB for CGAL's polygon meshes. `cmake --preset sanitize` and `ctest --preset sanitize` run all.
short_tests=(
  test_base test_elements test_elements_traits test_elements_certificate test_elements_locator test_octree
  test_transitions test_boundary test_image_io
)

# Prints the files whose names end in one of the ways given, a line each.
sources() {
  local ending
  for ending in "$@"; do
    find benchmark cmake demo doc examples include python scripts src test workflow -type f -name "*$ending"
  done | sort
}

check_format() {
  local -a files
  local formatter
  formatter=$(command -v clang-format-14 || command -v clang-format)
  # without what is generated, and a library
  mapfile -t files < <(sources .h .cpp .js | grep -vE '/(transition_tables\.h|three\.js)$')
  "$formatter" --dry-run --Werror "${files[@]}"
  # Comments, which it leaves alone.
  if LC_ALL=C.UTF-8 grep -nE '^.{111,}' "${files[@]}"; then
    fail "lines of more than 110 columns"
  fi
}

check_shell() {
  local -a files
  mapfile -t files < <(sources .sh)
  shellcheck --external-sources .ci/run "${files[@]}"
}

check_python() {
  local -a files
  mapfile -t files < <(sources .py)
  pyflakes3 "${files[@]}"
}

check_layers() {
  /usr/bin/python3 scripts/check_layers.py
}

# Makes a build directory unless it is there.
configure() {
  local directory=$1
  shift
  [[ -f $directory/build.ninja ]] ||
    cmake -S . -B "$directory" -DCGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE=TRUE "$@" > "$directory.log" ||
    fail "could not configure $directory: see $directory.log"
}

# The build directory of what is compiled without optimization.
configure_debug() {
  configure "$1" -G Ninja -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG=-O0 \
    -DMIXED_MESH_3_BUILD_BENCHMARKS=ON "${@:2}"
}

# Builds targets.
build() {
  local directory=$1
  shift
  cmake --build "$directory" --parallel "$(build_jobs 1500)" --target "$@"
}

# Runs tests of a build directory that must have assertions on; the rest is for ctest.
run_tests() {
  local directory=$1
  shift
  if grep -qE 'NDEBUG|CGAL_NO_(PRECONDITIONS|ASSERTIONS)' "$directory/build.ninja"; then
    fail "assertions are off in $directory"
  fi
  ctest --test-dir "$directory" --output-on-failure --no-tests=error --parallel "$(nproc)" "$@"
}

check_doc() {
  configure_debug "$build/debug"
  build "$build/debug" doc
}

check_headers() {
  configure_debug "$build/debug"
  build "$build/debug" test_headers
}

# Compiles an example of each package in the layout, and runs a test with the CMakeLists.txt that is written there.
# What follows the folder is for the compilers.
compile_layout() {
  local tree=$1 compiler source package
  shift
  local -a flags=("$@")
  for package in Installation Mixed_mesh_3 Linear_elasticity_3; do
    flags+=("-I$tree/$package/include")
  done
  for compiler in ${LAYOUT_COMPILERS:-g++ clang++}; do
    for source in "$tree"/*/examples/*/{mixed_mesh_of_a_brain,elasticity_of_brain_shift}.cpp; do
      [[ -f $source ]] || continue # a name for each package
      "$compiler" -std=c++17 -fsyntax-only -Wall -Wextra -Wpedantic -Werror -isystem /usr/include/eigen3 \
        -DMIXED_MESH_3_DATA_DIR='"data"' "${flags[@]}" "$source" || fail "$source does not compile with $compiler"
    done
  done
  rm -rf "$tree-build"
  cmake -S "$tree/Mixed_mesh_3/test/Mixed_mesh_3" -B "$tree-build" -DCMAKE_BUILD_TYPE=Debug \
    -DCGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE=TRUE "-DCMAKE_CXX_FLAGS=${flags[*]}" > "$tree-build.log"
  cmake --build "$tree-build" --target test_mixed_mesh_elements_traits >> "$tree-build.log"
  (cd "$tree/Mixed_mesh_3/test/Mixed_mesh_3" && "$tree-build/test_mixed_mesh_elements_traits" data)
}

check_layout() {
  scripts/lay_out_as_cgal.py "$build/layout"
  compile_layout "$build/layout"
  if [[ -n ${CGAL_DIR_61:-} ]]; then
    compile_layout "$build/layout" -isystem "$CGAL_DIR_61/include"
  fi
}

check_benchmarks() {
  configure_debug "$build/debug"
  build "$build/debug" benchmark/all
}

check_debug() {
  configure_debug "$build/debug"
  build "$build/debug" examples/all
  run_tests "$build/debug" -R '^example_'
}

check_sanitize() {
  configure "$build/sanitize" --preset sanitize
  build "$build/sanitize" "${short_tests[@]}"
  export UBSAN_OPTIONS=print_stacktrace=1 ASAN_OPTIONS=detect_stack_use_after_return=1
  run_tests "$build/sanitize" -R "^($(IFS='|' && echo "${short_tests[*]}"))\$"
}

check_fuzz() {
  local reader work failed=0
  local -a readers=(VTU MSH MEDIT NETGEN NIFTI control_points surface)
  [[ ! -w /dev/shm ]] || export TMPDIR=/dev/shm # inputs become files, which takes 20 times as long on a disk
  configure "$build/fuzz" -G Ninja -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ -DBUILD_TESTING=OFF \
    -DMIXED_MESH_3_BUILD_DEMOS=OFF -DMIXED_MESH_3_BUILD_FUZZERS=ON
  build "$build/fuzz" "${readers[@]/#/fuzz_}"
  for reader in "${readers[@]}"; do
    work=$build/fuzz/$reader # what is found new is put there, and not into the corpus
    mkdir -p "$work"
    if "$build/fuzz/bin/fuzz_$reader" -max_total_time="${FUZZ_SECONDS:-12}" -timeout=10 -rss_limit_mb=2048 \
      -max_len=4096 -artifact_prefix="$work-" "$work" "test/fuzz/corpus/$reader" \
      > "$work.log" 2>&1; then
      echo "fuzz_$reader: nothing found"
    else
      tail -n 40 "$work.log"
      failed=1
    fi
  done
  [[ $failed -eq 0 ]] || fail "a reader fails: see the files in $build/fuzz"
}

check_cgal61() {
  if [[ -z ${CGAL_DIR_61:-} ]]; then
    echo "CGAL_DIR_61 is not set: nothing to check"
    return
  fi
  local version=$CGAL_DIR_61/include/CGAL/version.h
  [[ -f $version ]] || fail "there is no $version"
  grep 'define CGAL_VERSION ' "$version"
  configure_debug "$build/cgal61" "-DCMAKE_CXX_FLAGS=-isystem $CGAL_DIR_61/include"
  build "$build/cgal61" test_headers examples/all "${short_tests[@]}"
}

[[ $# -gt 0 ]] || set -- "${parts[@]}"
for part in "$@"; do
  [[ " ${parts[*]} " == *" $part "* ]] || fail "unknown part '$part': expected one of ${parts[*]}"
done
install_packages build checks
mkdir -p "$build"

if [[ $# -eq 1 ]]; then
  cd "$root"
  "check_$1"
  exit
fi

# Each part in a process of its own, which ends at its first error.
failed=0
summary=""
for part in "$@"; do
  echo "--- $part"
  started=$SECONDS
  result=passed
  SKIP_SETUP=1 bash "${BASH_SOURCE[0]}" "$part" || result=FAILED
  [[ $result == passed ]] || failed=$((failed + 1))
  summary+=$(printf '%-10s %s in %d s' "$part" "$result" $((SECONDS - started)))$'\n'
done
printf '\n%s' "$summary"
echo "$(($# - failed)) of $# parts passed"
[[ $failed -eq 0 ]]
