#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs what is missing, builds the tests and the examples, and runs them:
#
#   scripts/test.sh [CTEST_OPTION...]     for example: scripts/test.sh -R octree
#
# BUILD_DIR overrides the build directory, build/test.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/setup.sh
source "$root/scripts/setup.sh"

build=${BUILD_DIR:-$root/build/test}

install_packages build pictures tests cohort page python petsc

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=ON \
  -DMIXED_MESH_3_BUILD_PYTHON=ON -DPython_EXECUTABLE=/usr/bin/python3
cmake --build "$build" --parallel "$(build_jobs 1500)"
echo "built in $((SECONDS / 60)) min $((SECONDS % 60)) s, packages included"
ctest --test-dir "$build" --output-on-failure --no-tests=error --parallel "$(nproc)" "$@"
