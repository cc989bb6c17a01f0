# SPDX-License-Identifier: GPL-3.0-or-later
"""The build backend for pip (PEP 517): CMake builds the module, which is packed as a wheel.

    pip install --no-build-isolation ./python        needs pybind11-dev and the packages of scripts/setup.sh build
    python3 python/build_wheel.py FOLDER [BUILD]     only the wheel, from a build of the module if BUILD is given
    python3 python/build_wheel.py --self-contained FOLDER BUILD     with the libraries that the module is linked to,
                                                     for systems that have none of them; needs patchelf and strip
"""

import base64
import hashlib
import os
import pathlib
import platform
import shutil
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
NAME, VERSION = "mixed_mesh_3", "0.1.0"
# Libraries that each Linux system has, as PEP 600 counts on.
OF_SYSTEM = ("linux-vdso", "ld-linux", "libc.", "libm.", "libpthread.", "libdl.", "librt.", "libgcc_s.", "libstdc++.")
METADATA = f"""Metadata-Version: 2.1
Name: mixed-mesh-3
Version: {VERSION}
Summary: Mixed-element finite-element meshes from octrees, for real-time simulation
License: GPL-3.0-or-later
Requires-Python: >=3.8
Requires-Dist: numpy
"""


def _tag(is_self_contained):
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    system = sysconfig.get_platform().replace("-", "_").replace(".", "_")
    if is_self_contained:  # on any Linux whose C library is not older
        system = f"manylinux_{platform.libc_ver()[1].replace('.', '_')}_{platform.machine()}"
    return f"{version}-{version}-{system}"


def _build(folder):
    subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF",
                    "-DMIXED_MESH_3_BUILD_APPS=OFF", "-DMIXED_MESH_3_BUILD_PYTHON=ON",
                    f"-DPython_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "Mixed_mesh_3_python", "--parallel",
                    str(os.cpu_count() or 1)], check=True)


def _libraries(module):
    """The libraries that a module needs, and those that these need: names and paths."""
    lines = subprocess.run(["ldd", module], check=True, stdout=subprocess.PIPE, text=True).stdout.splitlines()
    pairs = [line.split()[:3:2] for line in lines if "=>" in line]
    return {name: pathlib.Path(path) for name, path in sorted(pairs) if not name.startswith(OF_SYSTEM)}


def _collect(package, folder):
    """Copies a package and its libraries, which find each other there."""
    shutil.copytree(package, folder / NAME)
    (module,) = (folder / NAME).glob("_core*.so")
    libraries = folder / f"{NAME}.libs"
    libraries.mkdir()
    for name, path in _libraries(module).items():
        shutil.copy(path, libraries / name)
        subprocess.run(["patchelf", "--set-rpath", "$ORIGIN", libraries / name], check=True)
    subprocess.run(["strip", module], check=True)
    subprocess.run(["patchelf", "--set-rpath", f"$ORIGIN/../{NAME}.libs", module], check=True)


def _pack(build, folder, is_self_contained=False):
    package = pathlib.Path(build, "python", NAME)
    if not is_self_contained:
        return _write(package.parent, [NAME], folder, _tag(False))
    with tempfile.TemporaryDirectory() as collected:
        _collect(package, pathlib.Path(collected))
        return _write(pathlib.Path(collected), [NAME, f"{NAME}.libs"], folder, _tag(True))


def _write(root, parts, folder, tag):
    wheel = pathlib.Path(folder, f"{NAME}-{VERSION}-{tag}.whl")
    info = f"{NAME}-{VERSION}.dist-info"
    files = {f"{part}/{file.name}": file.read_bytes()
             for part in parts for file in sorted((root / part).iterdir()) if file.is_file()}
    files[f"{info}/METADATA"] = METADATA.encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\n"
                              f"Tag: {tag}\n").encode()
    record = ""
    for name, content in files.items():
        digest = base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()
        record += f"{name},sha256={digest},{len(content)}\n"
    files[f"{info}/RECORD"] = f"{record}{info}/RECORD,,\n".encode()
    with zipfile.ZipFile(wheel, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, content in files.items():  # the same bytes in each build
            entry = zipfile.ZipInfo(name)
            entry.external_attr = 0o644 << 16
            entry.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(entry, content)
    return wheel.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    with tempfile.TemporaryDirectory() as build:
        _build(build)
        return _pack(build, wheel_directory)


if __name__ == "__main__":
    if sys.argv[1] == "--self-contained":
        print(_pack(sys.argv[3], sys.argv[2], True))
    elif len(sys.argv) == 3:
        print(_pack(sys.argv[2], sys.argv[1]))
    else:
        print(build_wheel(sys.argv[1]))
