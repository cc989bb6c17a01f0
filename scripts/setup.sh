#!/usr/bin/env bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Installs the Debian packages that are missing for the purposes named:
#
#   scripts/setup.sh [build] [pictures] [tests] [image] [benchmark] [checks] [cohort] [page] [python] [petsc] [package]
#
# When nothing is missing, apt is not called. The other scripts source this
# file for its functions, install_packages, build_jobs and minutes_since.
# SKIP_SETUP=1 installs nothing, for a system that got its packages elsewhere.

set -euo pipefail

fail() {
  echo "${0##*/}: error: $*" >&2
  exit 1
}

# Prints the packages of one purpose.
packages_for() {
  case $1 in
    build) echo g++ cmake ninja-build ccache libcgal-dev libcli11-dev nlohmann-json3-dev \
                libboost-dev libgmp-dev libmpfr-dev libeigen3-dev libsuitesparse-dev libnifti2-dev \
                zlib1g-dev libtbb-dev \
                libopenblas0-serial ;; # several times faster than the reference BLAS, for CHOLMOD
    # VTK opens an X display even to render off-screen: Xvfb and Mesa's software renderer provide it.
    pictures) echo python3-vtk9 xvfb libgl1-mesa-dri ;;
    # Peers that read back the files that we write; plastimatch deforms images by fields. dpkg-dev and file make
    # packages, man-db shows their pages.
    tests) echo dpkg-dev file man-db mypy plastimatch calculix-ccx freefem++ python3-getfem python3-gmsh python3-meshio python3-nibabel \
                python3-vtk9 ;;
    # An MRI image of a brain, of which data/brain.off is the surface.
    image) echo mricron-data ;;
    # What workflow/Snakefile runs with, and its scripts.
    cohort) echo snakemake python3-nibabel python3-numpy python3-scipy ;;
    # The browser that pages are tested with.
    page) echo chromium chromium-driver ;;
    # What the Python package is built with, and what its test installs it into.
    python) echo pybind11-dev python3-dev python3-numpy python3-pip python3-venv ;;
    # What scripts/package.sh makes packages with, and tries them in.
    package) echo debootstrap dpkg-dev file help2man lintian patchelf ;;
    # The solver of brain_shift --solver petsc, and mpirun.
    petsc) echo libpetsc-real-dev openmpi-bin pkg-config ;;
    # The peers of scripts/benchmark.sh, its plots, and what kernels are measured with.
    benchmark) echo libbenchmark-dev tetgen python3-gmsh python3-netgen python3-matplotlib ;;
    # What scripts/check.sh runs besides the compiler.
    checks) echo clang clang-format-14 doxygen libjs-mathjax pyflakes3 shellcheck valgrind ;;
    *) fail "unknown purpose '$1': expected build, pictures, tests, image, benchmark, checks, cohort, page, python, petsc or package" ;;
  esac
}

# Installs what is missing of the packages for the purposes given.
install_packages() {
  [[ ${SKIP_SETUP:-} != 1 ]] || return 0
  local purpose packages package
  local -a missing=() as_root=()
  if ! command -v dpkg-query > /dev/null || ! command -v apt-get > /dev/null; then
    fail "this system has no apt: install the packages listed in scripts/setup.sh, then set SKIP_SETUP=1"
  fi

  for purpose in "$@"; do
    packages=$(packages_for "$purpose")
    for package in $packages; do
      if [[ " ${missing[*]-} " != *" $package "* &&
            $(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2> /dev/null) != installed ]]; then
        missing+=("$package")
      fi
    done
  done
  [[ ${#missing[@]} -gt 0 ]] || return 0

  if [[ $(id -u) -ne 0 ]]; then
    command -v sudo > /dev/null || fail "needs root or sudo to install: ${missing[*]}"
    as_root=(sudo)
  fi
  echo "Installing ${missing[*]}"
  as_root+=(env DEBIAN_FRONTEND=noninteractive apt-get -qq -o DPkg::Lock::Timeout=600 -o Acquire::Retries=3)
  "${as_root[@]}" update
  "${as_root[@]}" -o Dpkg::Use-Pty=0 install --yes --no-install-recommends "${missing[@]}" > /dev/null ||
    fail "could not install: ${missing[*]}"
}

# Prints how many compilers may run at once: one a core, each with the memory given in MB.
build_jobs() {
  local megabytes=$1 cores memory limit jobs
  cores=$(nproc)
  memory=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo)
  limit=$(cat /sys/fs/cgroup/memory.max 2> /dev/null || echo max)
  if [[ $limit != max && $((limit / 1024)) -lt $memory ]]; then
    memory=$((limit / 1024))
  fi
  jobs=$((memory / (megabytes * 1000)))
  jobs=$((jobs < cores ? jobs : cores))
  echo $((jobs > 1 ? jobs : 1))
}

# Prints the time since that of $SECONDS given.
minutes_since() {
  echo "$(((SECONDS - $1) / 60)) min $(((SECONDS - $1) % 60)) s"
}

if [[ ${BASH_SOURCE[0]} == "$0" ]]; then
  [[ $# -gt 0 ]] || set -- build pictures tests image checks
  install_packages "$@"
fi
