#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# From a fresh clone to brain shift: installs what is missing, builds the
# mesher and brain_shift, meshes the brain of an MRI image with the tumor
# data/tumour.off in it, each of its own stiffness, moves the control points of
# data/control_points.csv, resects the tumor along its interface, deforms the
# image, and draws the mesh and the image before and after.
#
#   scripts/brain_shift.sh [VERTICES]     the vertex budget, 2000 by default
#
# Writes to out/. BUILD_DIR overrides the build directory, build/release; IMAGE
# the image, without skull, that of Debian's package mricron-data; BRAIN the
# image or closed surface of the brain, which is what is not 0 in IMAGE.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/setup.sh
source "$root/scripts/setup.sh"

vertices=${1:-2000}
build=${BUILD_DIR:-$root/build/release}
out=$root/out
purposes=(build pictures)
if [[ -z ${IMAGE:-} ]]; then
  IMAGE=/usr/share/mricron/templates/ch2bet.nii.gz
  purposes+=(image)
fi

BRAIN=${BRAIN:-$IMAGE}
install_packages "${purposes[@]}"

if [[ ! -f $build/build.ninja ]]; then
  cmake -S "$root" -B "$build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF
fi
cmake --build "$build" --target mixed_mesh_3 brain_shift --parallel "$(build_jobs 1500)"

mkdir -p "$out"
"$build/bin/mixed_mesh_3" "$BRAIN" --smoothing 3 --subdomain "tumor=$root/data/tumour.off" \
  --region "$root/data/region.off" --vertices "$vertices" --output "$out/brain.vtu" --report "$out/brain.json"

"$build/bin/brain_shift" "$out/brain.vtu" --control-points "$root/data/control_points.csv" \
  --control-radius 8 --material 2=9,0.45 --tumor-label 2 --image "$IMAGE" --output "$out/brain_shift.vtu" \
  --output-deformed "$out/brain_deformed.vtu" --output-image "$out/brain_shift" --field nrrd \
  --report "$out/brain_shift.json"

# Debian's Python, which has Debian's VTK, whatever other Python the PATH leads to.
timeout --foreground 600 /usr/bin/python3 "$root/scripts/pictures/render_brain_shift.py" "$out/brain_shift.vtu" \
  --tumor "$root/data/tumour.off" --control-points "$root/data/control_points.csv" \
  --image "$IMAGE" --warped-image "$out/brain_shift.nii.gz" --output-prefix "$out/brain_shift"

cat << END

mesh:     $out/brain_shift.vtu (ParaView: Warp By Vector, displacement; Threshold, resected)
          $out/brain_deformed.vtu (what is left, deformed)
image:    $out/brain_shift.nii.gz, $out/brain_shift_mask.nii.gz (deformed; what it shows)
          $out/brain_shift_forward.nrrd, $out/brain_shift_backward.nrrd (displacements, for 3D Slicer and ITK)
report:   $out/brain_shift.json
pictures: $out/brain_shift_before.png
          $out/brain_shift_shifted.png
          $out/brain_shift_resected.png
          $out/brain_shift_image.png
programs: $build/bin/mixed_mesh_3, $build/bin/brain_shift

Next, look at the mesh in a browser, and shift it by measurements of your own:

    export PATH="$build/bin:\$PATH"
    brain_shift $out/brain.vtu --control-points $root/data/control_points.csv --control-radius 14 --page shift.html
END
