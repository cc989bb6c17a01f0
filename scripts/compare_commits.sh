#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds mixed_mesh_3 of two commits, and says what became slower or worse by
# more than the noise: exit status 1 then.
#
#   scripts/compare_commits.sh OLD NEW [CASE...]     for example: main HEAD
#
# Cases: brain_660 brain_2000 brain_10000 cube torus tumor; all by default.
# RUNS is the number of runs that a median is of, 5 by default. Sources and
# builds are kept in out/compare/COMMIT for the next time.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/setup.sh
source "$root/scripts/setup.sh"
[[ $# -ge 2 ]] || fail "expected two commits: scripts/compare_commits.sh OLD NEW [CASE...]"

work=$root/out/compare
programs=()
for name in "$1" "$2"; do
  commit=$(git -C "$root" rev-parse --verify --quiet "$name^{commit}") || fail "no commit '$name'"
  programs+=("$work/$commit/build/bin/mixed_mesh_3")
done
shift 2

install_packages build
for program in "${programs[@]}"; do
  folder=${program%/build/bin/*}
  if [[ ! -d $folder/source ]]; then
    mkdir -p "$folder/part"
    git -C "$root" archive "${folder##*/}" | tar -x -C "$folder/part"
    mv "$folder/part" "$folder/source"
  fi
  launcher=()
  ! command -v ccache > /dev/null || launcher=(-DCMAKE_CXX_COMPILER_LAUNCHER=ccache)
  cmake -S "$folder/source" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=Release "${launcher[@]}" > /dev/null
  cmake --build "$folder/build" --parallel "$(build_jobs 2000)" --target mixed_mesh_3 > "$folder/build.log" \
    || fail "${folder##*/} does not build: see $folder/build.log"
done

/usr/bin/python3 "$root/benchmark/compare_programs.py" "${programs[@]}" "$work/meshes" --runs "${RUNS:-5}" \
  ${1:+--cases "$@"}
