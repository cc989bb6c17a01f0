#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, and checks what a Release build and its tests do not show:
#
#   scripts/check.sh [PART...]            all parts but `threads`, or those named; `quick` are those that need no
#                                         compiler, `compiled` the others
#
#   format      C++ and JavaScript are as clang-format 14 makes them with .clang-format; no line is longer than
#               110 columns
#   shell       shell scripts, by shellcheck
#   python      programs in Python, by pyflakes
#   layers      arrows between folders run one way: scripts/check_layers.py; the graph of ARCHITECTURE.md has
#               them: scripts/draw_architecture.py
#   tests       a test includes each header of internal/meshing and internal/fitting: scripts/check_tests.py
#   version     the version number is the same in all places: scripts/check_version.py
#   checked     some examples, one for each way through the stages, and short tests run with CGAL's assertions and
#               preconditions, the tests also with AddressSanitizer and UndefinedBehaviorSanitizer
#   headers     headers compile alone, by clang, without a warning: public ones that the change since BASE (default:
#               origin/main, or 20 commits ago on main itself) reaches, and internal ones that changed; all with
#               CHECK_ALL=1, and where nothing is known to have changed
#   same_bytes  meshes have the same bytes if clang++ compiles the mesher, for all instructions of this processor,
#               as in the Release build
#   instructions  a few meshes take at most a tenth more instructions than is recorded, in the Release build:
#               benchmark/count_instructions.py
#   doc         the manual, by doxygen; a warning is an error
#   fuzz        targets of libFuzzer, one a reader, run for FUZZ_SECONDS each (default: 12), from test/fuzz/corpus;
#               what makes one fail is kept in the build directory
#   threads     meshes of a surface and of an image by four threads, with ThreadSanitizer, by g++: a data race is an
#               error; test/threads has the parallel loop that it understands. Only if it is named
#   layout      the repository as it would lie in CGAL's tree: scripts/lay_out_as_cgal.py; examples and a test
#               are compiled there, with -Wpedantic, by LAYOUT_COMPILERS (default: g++ clang++), also with the CGAL of
#               CGAL_DIR_61
#   benchmarks  the benchmarks compile, by clang
#   cgal61      headers, programs, examples and tests are built with another CGAL, and run, if CGAL_DIR_61 names the
#               folder that has its include/CGAL/version.h
#
# A part that fails does not keep the next ones from running. If DEADLINE is set, in seconds since 1970, parts that
# have not ended by then are left out, and named: those that find most come first. BUILD_DIR overrides the folder of
# the build directories, build: release and checked, as the presets have them, clang, threads, cgal61 and layout.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/setup.sh
source "$root/scripts/setup.sh"

build=$(realpath -m "${BUILD_DIR:-$root/build}")
quick=(format shell python layers tests version)
compiled=(checked headers same_bytes instructions doc fuzz layout benchmarks cgal61)
by_name=(threads)

# The tests that run with sanitizers, and their programs. Not those that read a surface or mesh one: with
# sanitizers, a compiler takes long for CGAL's polygon meshes. The preset `checked` has all.
short_tests=(
  test_base test_elements test_elements_traits test_elements_certificate test_elements_locator test_octree
  test_transitions test_boundary test_image_io
)
checked_examples=(
  mixed_mesh_subdomains mixed_mesh_custom_domain elasticity_of_brain_shift
)
short_programs=(test_base test_elements test_octree test_transitions test_boundary test_images)

# Prints the files whose names end in one of the ways given, a line each.
sources() {
  local ending
  for ending in "$@"; do
    find apps benchmark cmake doc examples include python scripts src test workflow -type f -name "*$ending"
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
  /usr/bin/python3 scripts/draw_architecture.py --check
}

check_tests() {
  /usr/bin/python3 scripts/check_tests.py
}

check_version() {
  /usr/bin/python3 scripts/check_version.py > /dev/null
}

# Makes a build directory in the folder of these, or brings it up to date.
configure() {
  local directory=$build/$1
  shift
  if ! cmake -S . -B "$directory" -G Ninja -DCGAL_DO_NOT_WARN_ABOUT_CMAKE_BUILD_TYPE=TRUE "$@" \
    > "$directory.log" 2>&1; then
    fail "could not configure $directory: $(cat "$directory.log")"
  fi
}

# For what clang compiles: headers alone, fuzz targets, the mesher for all instructions of this processor.
configure_clang() {
  configure clang -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_CXX_FLAGS=-march=native \
    -DMIXED_MESH_3_BUILD_FUZZERS=ON "$@"
}

# Builds targets.
build() {
  local directory=$1
  shift
  cmake --build "$directory" --parallel "$(build_jobs "${megabytes:-1500}")" --target "$@"
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
  configure release -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=ON
  build "$build/release" doc
}

check_headers() {
  local -a headers=()
  if [[ ${CHECK_ALL:-} != 1 ]]; then
    mapfile -t headers < <(scripts/changed_headers.py "${BASE:-origin/main}")
    [[ ${#headers[@]} -gt 0 ]] || { echo "the change reaches no header" && return; }
  fi
  configure_clang "-DMIXED_MESH_3_HEADERS_ALONE=$(IFS=';' && echo "${headers[*]}")"
  build "$build/clang" test_headers
}

# Compiles an example of each package in the layout, and runs a test with the CMakeLists.txt that is written there.
# What follows the folder is for the compilers.
compile_layout() {
  local tree=$1 compiler source package process
  shift
  local -a flags=("$@") running
  for package in Installation Mixed_mesh_3 Linear_elasticity_3; do
    flags+=("-I$tree/$package/include")
  done
  for source in "$tree"/*/examples/*/{mixed_mesh_of_a_brain,elasticity_of_brain_shift}.cpp; do
    [[ -f $source ]] || continue # a name for each package
    running=()
    for compiler in ${LAYOUT_COMPILERS:-g++ clang++}; do
      "$compiler" -std=c++17 -fsyntax-only -Wall -Wextra -Wpedantic -Werror -isystem /usr/include/eigen3 \
        "${flags[@]}" "$source" &
      running+=("$!")
    done
    for process in "${running[@]}"; do
      wait "$process" || fail "$source does not compile with each of ${LAYOUT_COMPILERS:-g++ clang++}"
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
  configure_clang -DMIXED_MESH_3_BUILD_BENCHMARKS=ON -DMIXED_MESH_3_BENCHMARKS_SYNTAX_ONLY=ON
  build "$build/clang" benchmark/all
}

check_same_bytes() {
  local of meshes=$build/same_bytes
  configure release --preset release
  configure_clang
  for of in release clang; do
    build "$build/$of" mixed_mesh_3
    mkdir -p "$meshes/$of"
    mesh() {
      "$build/$of/bin/mixed_mesh_3" "${@:2}" --quiet --output "$meshes/$of/$1.msh"
    }
    mesh brain_660 data/brain.off --region data/region.off --vertices 660
    mesh brain_10000 data/brain.off --region data/region.off --vertices 10000 --threads 2
    mesh tetrahedra data/brain.off --vertices 3000 --tetrahedra
    mesh subdomains data/brain.off --subdomain data/tumour.off --vertices 4000
  done
  diff -r "$meshes/release" "$meshes/clang" || fail "meshes differ between the builds release and clang"
}

check_instructions() {
  configure release --preset release
  build "$build/release" mixed_mesh_3
  benchmark/count_instructions.py "$build/release/bin/mixed_mesh_3"
}

check_checked() {
  local megabytes=2500 # of a compiler with sanitizers
  configure checked --preset checked
  build "$build/checked" "${checked_examples[@]}" "${short_programs[@]}"
  export UBSAN_OPTIONS=print_stacktrace=1 ASAN_OPTIONS=detect_stack_use_after_return=1
  run_tests "$build/checked" -R "^($(IFS='|' && echo "${short_tests[*]}|${checked_examples[*]/#/example_}"))\$"
}

# Runs the fuzz target of a reader, and shows what it says if it fails.
fuzz() {
  local reader=$1
  local work=$build/clang/fuzz/$reader # what is found new is put there, and not into the corpus
  mkdir -p "$work"
  if "$build/clang/bin/fuzz_$reader" -max_total_time="${FUZZ_SECONDS:-12}" -timeout=10 -rss_limit_mb=2048 \
    -max_len=4096 -artifact_prefix="$work-" "$work" "test/fuzz/corpus/$reader" > "$work.log" 2>&1; then
    echo "fuzz_$reader: nothing found"
  else
    printf 'fuzz_%s FAILED\n%s\n' "$reader" "$(tail -n 40 "$work.log")" # at once, as others write, too
    return 1
  fi
}

check_fuzz() {
  local -a readers
  read -ra readers <<< "${FUZZ_READERS:-VTU MSH MEDIT NETGEN NIFTI MGH control_points landmarks surface}"
  [[ ! -w /dev/shm ]] || export TMPDIR=/dev/shm # inputs become files, which takes 20 times as long on a disk
  configure_clang
  build "$build/clang" "${readers[@]/#/fuzz_}"
  export build
  export -f fuzz
  printf '%s\n' "${readers[@]}" | xargs --max-procs="$(nproc)" -I{} bash -c 'fuzz {}' ||
    fail "a reader fails: see the files in $build/clang/fuzz"
}

check_threads() {
  local meshes=$build/threads/meshes mesher=$build/threads/bin/mixed_mesh_3 megabytes=2500
  local sanitizer="-O1 -g1 -DNDEBUG -fsanitize=thread -I$root/test/threads"
  configure threads -DCMAKE_BUILD_TYPE=Debug "-DCMAKE_CXX_FLAGS_DEBUG=$sanitizer" -DMIXED_MESH_3_BUILD_APPS=ON
  build "$build/threads" mixed_mesh_3
  mkdir -p "$meshes"
  export TSAN_OPTIONS=halt_on_error=1 # with exit status 66
  mesh() {
    "$mesher" "${@:2}" --threads 4 --quiet --output "$meshes/$1.msh"
  }
  mesh brain data/brain.off --region data/region.off --vertices 3000
  mesh subdomains data/brain.off --subdomain data/tumour.off --vertices 2000
  mesh labels test/corpus/bridge_of_a_voxel.nii.gz --labels a=1,b=2,c=3 --vertices 1000
  echo "no data races in $(find "$meshes" -name '*.msh' | wc -l) meshes"
}

check_cgal61() {
  if [[ -z ${CGAL_DIR_61:-} ]]; then
    echo "CGAL_DIR_61 is not set: nothing to check"
    return
  fi
  local version=$CGAL_DIR_61/include/CGAL/version.h
  [[ -f $version ]] || fail "there is no $version"
  grep 'define CGAL_VERSION ' "$version"
  configure cgal61 -DCMAKE_BUILD_TYPE=Release "-DCMAKE_CXX_FLAGS=-isystem $CGAL_DIR_61/include"
  build "$build/cgal61" test_headers apps/all examples/all test/all
  ctest --test-dir "$build/cgal61" --output-on-failure --no-tests=error --parallel "$(nproc)"
}

parts=()
[[ $# -gt 0 ]] || set -- quick compiled
parts=()
for part in "$@"; do
  case $part in
    quick) parts+=("${quick[@]}") ;;
    compiled) parts+=("${compiled[@]}") ;;
    *)
      [[ " ${quick[*]} ${compiled[*]} ${by_name[*]} " == *" $part "* ]] ||
        fail "unknown part '$part': expected one of ${quick[*]} ${compiled[*]} ${by_name[*]}"
      parts+=("$part")
      ;;
  esac
done
set -- "${parts[@]}"
install_packages build checks
mkdir -p "$build"

if [[ $# -eq 1 ]]; then
  cd "$root"
  "check_$1"
  exit
fi

# Each part in a process of its own, which ends at its first error.
failed=0 left_out=0
summary=""
for part in "$@"; do
  echo "--- $part"
  started=$SECONDS
  limit=()
  [[ -z ${DEADLINE:-} ]] || limit=(timeout "$((DEADLINE > $(date +%s) ? DEADLINE - $(date +%s) : 1))")
  status=0
  SKIP_SETUP=1 "${limit[@]}" bash "${BASH_SOURCE[0]}" "$part" || status=$?
  case $status in
    0) result=passed ;;
    124) result="left out: no time" left_out=$((left_out + 1)) ;; # of timeout
    *) result=FAILED failed=$((failed + 1)) ;;
  esac
  summary+=$(printf '  %-22s %s in %s' "$part" "$result" "$(minutes_since "$started")")$'\n'
done
printf '\n%s' "$summary" | tee -a "${SUMMARY:-/dev/null}"
echo "$(($# - failed - left_out)) of $# parts passed, $left_out left out"
[[ $failed -eq 0 ]]
