#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds all but the benchmarks, and runs the tests:
#
#   scripts/test.sh [CTEST_OPTION...]     for example: scripts/test.sh -R octree
#
# Tests that need a browser, PETSc, snakemake, plastimatch, GetFEM, Gmsh or VTK run where these are, and are named
# as skipped where not: `scripts/setup.sh pictures tests cohort page petsc` installs them. REQUIRE_ALL_TESTS=1
# makes a skipped test a failure. BUILD_DIR overrides the build directory, build/release.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/setup.sh
source "$root/scripts/setup.sh"

build=${BUILD_DIR:-$root/build/release}

echo "The first time this takes about 25 minutes on two cores, and what it installs."
install_packages build python

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=ON \
  -DMIXED_MESH_3_BUILD_PYTHON=ON -DPython_EXECUTABLE=/usr/bin/python3
NINJA_STATUS=${NINJA_STATUS:-'[%f/%t, %e s] '} cmake --build "$build" --parallel "$(build_jobs 1500)"
echo "built in $(minutes_since 0), packages included"

log=$build/ctest.log
ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$(nproc)" "$@" | tee "$log"
# A test may leave out a part of itself: only its own output says so.
if [[ ${REQUIRE_ALL_TESTS:-} == 1 ]]; then
  if grep -A 99 '^The following tests did not run:' "$log" ||
    grep -E '^"[^"]+" start time:|^(OK|FAILED) \(.*skipped=|^skipped:' "$build/Testing/Temporary/LastTest.log" |
    grep -B 1 'skipped'; then
    fail "tests or parts of them were skipped, and REQUIRE_ALL_TESTS is set: see above"
  fi
fi
