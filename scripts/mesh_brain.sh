#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# From a fresh clone to a meshed brain: installs what is missing, builds the
# command-line mesher, meshes data/brain.off refined in data/region.off, and
# draws the result and the histogram of its aspect ratios.
#
#   scripts/mesh_brain.sh [VERTICES]      the vertex budget, 660 by default
#
# Writes to out/. BUILD_DIR overrides the build directory, build/release.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/setup.sh
source "$root/scripts/setup.sh"

vertices=${1:-660}
build=${BUILD_DIR:-$root/build/release}
out=$root/out

install_packages build pictures

if [[ ! -f $build/build.ninja ]]; then
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF
fi
cmake --build "$build" --target mixed_mesh_3 --parallel "$(build_jobs 1500)"

mkdir -p "$out"
"$build/bin/mixed_mesh_3" "$root/data/brain.off" --region "$root/data/region.off" --vertices "$vertices" \
  --output "$out/brain.vtu" --output "$out/brain.msh" --report "$out/brain.json"

# Debian's Python, which has Debian's VTK, whatever other Python the PATH leads to.
timeout --foreground 600 /usr/bin/python3 "$root/scripts/pictures/render_mesh.py" "$out/brain.vtu" \
  --surface "$root/data/brain.off" --region "$root/data/region.off" --output-prefix "$out/brain"
timeout --foreground 600 /usr/bin/python3 "$root/scripts/pictures/plot_quality.py" \
  "$out/brain.json" "$out/brain_quality.png"

cat << END

mesh:     $out/brain.vtu (ParaView)
          $out/brain.msh (Gmsh)
report:   $out/brain.json
pictures: $out/brain_surface.png
          $out/brain_kinds.png
          $out/brain_ARC.png
          $out/brain_quality.png
program:  $build/bin/mixed_mesh_3

Next, mesh a surface of your own, and open its page in a browser:

    export PATH="$build/bin:\$PATH"
    mixed_mesh_3 SURFACE.stl --output mesh.vtu --page mesh.html
END
