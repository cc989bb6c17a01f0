#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Builds the Debian packages, and a wheel for Python that needs no other library:
#
#   scripts/package.sh          builds them: see out/packages
#   scripts/package.sh --try    installs them in a bare Debian 12, too, and uses them there: needs root
#
# The wheel is for the version of Python, and of the C library, that it is built with, or newer ones.

set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
# shellcheck source=scripts/setup.sh
source "$root/scripts/setup.sh"

[[ $# -eq 0 || ($# -eq 1 && $1 == --try) ]] || fail "unknown option: $*"
cd "$root"
packages=$root/out/packages
install_packages build python package

cmake -S . -B build/package -G Ninja -DCMAKE_BUILD_TYPE=Release -DBUILD_TESTING=OFF -DMIXED_MESH_3_BUILD_PYTHON=ON \
  -DPython_EXECUTABLE=/usr/bin/python3 > /dev/null
ninja -C build/package -j "$(build_jobs 1500)"
rm -rf "$packages"
mkdir -p "$packages"
(cd build/package && cpack -G DEB -B "$packages" > /dev/null)
rm -rf "$packages/_CPack_Packages"
/usr/bin/python3 python/build_wheel.py --self-contained "$packages" build/package
lintian --fail-on error "$packages"/*.deb
ls -sh "$packages"
[[ ${1:-} == --try ]] || exit 0

[[ $(id -u) -eq 0 ]] || fail "--try needs root, to change the root folder"
bare=$(mktemp -d)
trap 'umount "$bare/proc" 2> /dev/null; rm -rf "$bare"' EXIT
debootstrap --variant=minbase bookworm "$bare" > /dev/null
mount -t proc proc "$bare/proc"
cp "$packages"/* data/brain.off data/region.off "$bare/tmp"
cp -r test/install/consumer "$bare/tmp"

in_bare() {
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive \
    chroot "$bare" bash -ec "cd /tmp; $1"
}
install_in_bare() {
  in_bare "apt-get -qq -o Dpkg::Use-Pty=0 install --yes --no-install-recommends $* > /dev/null 2> apt.log ||
    { cat apt.log; exit 1; }"
}

module='import mixed_mesh_3 as mm3
data = mm3.example_data()
mesh, report = mm3.mesh(*data["brain"], region=data["region"], vertices=660)
assert report["status"] == "success" and mm3.certify(mesh).all()
print(mm3.__file__, mesh)'
begin=$SECONDS
install_in_bare ./mixed-mesh-3_*.deb
in_bare "mixed_mesh_3 brain.off --region region.off --vertices 660 --output brain.vtu --page brain.html"
echo "from the package to the first mesh: $(minutes_since "$begin")"
in_bare "brain_shift --version"
in_bare "apt-get -qq remove --yes --auto-remove mixed-mesh-3 > /dev/null" # with its libraries
install_in_bare python3-venv python3-numpy
in_bare "python3 -m venv --system-site-packages env; env/bin/pip -q install --no-index ./*.whl"
in_bare "env/bin/python -c '$module'"
install_in_bare ./python3-mixed-mesh-3_*.deb
in_bare "python3 -c '$module'"
install_in_bare ./libmixed-mesh-3-dev_*.deb g++ cmake make
in_bare "cmake -S consumer -B build -D CMAKE_BUILD_TYPE=Release -D WAY=find_package -D CONSUMERS=mesh > /dev/null
  cmake --build build > /dev/null; build/mesh"
echo "The packages work in a bare Debian 12"
