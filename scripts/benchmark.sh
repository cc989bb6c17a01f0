#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Compares with other meshers and with the paper: installs what is missing,
# builds the programs, and writes tables (Markdown, CSV, JSON) and plots.
#
#   scripts/benchmark.sh [PART] [VERTICES...]     all parts, or one
#
#   peers     Mesh_3, TetGen, Gmsh, Netgen and ours with as many vertices:
#             quality, fidelity, times (660 to 200000); MIXED_OCTREE may name
#             a build of MixedOcTree
#   paper     the paper's tables and figures beside ours
#   scale     time and memory of ours for growing budgets (660 to 5000000)
#   accuracy  the error of brain shift, beside meshes of Mesh_3; takes an hour
#
# Writes to out/benchmark/; benchmark/fill_tables.py out/benchmark puts the
# tables into benchmark/results, README and manual. RUNS is the number of runs that a median is of, 5
# by default. BUILD_DIR overrides the build directory, build/release.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/setup.sh
source "$root/scripts/setup.sh"

all=(peers paper scale accuracy)
parts=("${all[@]}")
if [[ $# -gt 0 ]]; then
  [[ " ${all[*]} " == *" $1 "* ]] || fail "unknown part '$1': expected one of ${all[*]}"
  parts=("$1")
  shift
fi
sizes=()
if [[ $# -gt 0 ]]; then
  [[ ! "$*" =~ [^0-9\ ] ]] || fail "expected numbers of vertices: $*"
  sizes=(--vertices "$@")
fi
build=${BUILD_DIR:-$root/build/release}
out=$root/out/benchmark
install_packages build pictures benchmark

cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMIXED_MESH_3_BUILD_BENCHMARKS=ON > /dev/null
cmake --build "$build" --parallel "$(build_jobs 2000)" --target mixed_mesh_3 brain_shift measure_mesh \
  benchmark_mesh_3 coarsen_surface make_region measure_accuracy benchmark_make_mixed_mesh_3
programs=$build/bin
mkdir -p "$out"

run_peers() {
  /usr/bin/python3 "$root/benchmark/Mixed_mesh_3/Peers/compare_with_peers.py" "$programs" "$out/peers" \
    --runs "${RUNS:-5}" --save "$out/peers" "${sizes[@]}" ${MIXED_OCTREE:+--mixed-octree "$MIXED_OCTREE"}
  /usr/bin/python3 "$root/benchmark/Mixed_mesh_3/Peers/plot_peers.py" "$out/peers.json" "$out/peers.png"
}

run_paper() {
  /usr/bin/python3 "$root/benchmark/Mixed_mesh_3/Quality/reproduce_paper.py" "$programs" "$out/paper" \
    --save "$out/paper"
}

run_scale() {
  /usr/bin/python3 "$root/benchmark/Mixed_mesh_3/Performance/run.py" "$programs/benchmark_make_mixed_mesh_3" \
    --runs "${RUNS:-5}" --threads 1 2 --save "$out/scale" "${sizes[@]}"
  /usr/bin/python3 "$root/benchmark/Mixed_mesh_3/Performance/plot_scale.py" "$out/scale.json" "$out/scale.png"
}

run_accuracy() {
  /usr/bin/python3 "$root/benchmark/Linear_elasticity_3/compare_accuracy.py" "$programs" "$out/accuracy" \
    --plot "$out/accuracy.png" "${sizes[@]}" | tee "$out/accuracy.md"
}

failed=()
for part in "${parts[@]}"; do
  echo "== $part"
  "run_$part" || failed+=("$part")
done
echo "tables: $out"
[[ ${#failed[@]} -eq 0 ]] || fail "not finished: ${failed[*]}"
