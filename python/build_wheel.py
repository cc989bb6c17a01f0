# SPDX-License-Identifier: GPL-3.0-or-later
"""The build backend for pip (PEP 517): CMake builds the module, which is packed as a wheel.

    pip install --no-build-isolation ./python        needs pybind11-dev and the packages of scripts/setup.sh build
    python3 python/build_wheel.py FOLDER [BUILD]     only the wheel, from a build of the module if BUILD is given
"""

import base64
import hashlib
import os
import pathlib
import subprocess
import sys
import sysconfig
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parent.parent
NAME, VERSION = "mixed_mesh_3", "0.1.0"
METADATA = f"""Metadata-Version: 2.1
Name: mixed-mesh-3
Version: {VERSION}
Summary: Mixed-element finite-element meshes from octrees, for real-time simulation
License: GPL-3.0-or-later
Requires-Python: >=3.8
Requires-Dist: numpy
"""


def _tag():
    version = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{version}-{version}-{sysconfig.get_platform().replace('-', '_').replace('.', '_')}"


def _build(folder):
    subprocess.run(["cmake", "-S", ROOT, "-B", folder, "-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=OFF",
                    "-DMIXED_MESH_3_BUILD_APPS=OFF", "-DMIXED_MESH_3_BUILD_PYTHON=ON",
                    f"-DPython_EXECUTABLE={sys.executable}"], check=True)
    subprocess.run(["cmake", "--build", folder, "--target", "Mixed_mesh_3_python", "--parallel",
                    str(os.cpu_count() or 1)], check=True)


def _pack(build, folder):
    wheel = pathlib.Path(folder, f"{NAME}-{VERSION}-{_tag()}.whl")
    info = f"{NAME}-{VERSION}.dist-info"
    files = {f"{NAME}/{file.name}": file.read_bytes()
             for file in sorted(pathlib.Path(build, "python", NAME).iterdir()) if file.is_file()}
    files[f"{info}/METADATA"] = METADATA.encode()
    files[f"{info}/LICENSE"] = (ROOT / "LICENSE").read_bytes()
    files[f"{info}/WHEEL"] = (f"Wheel-Version: 1.0\nGenerator: {NAME}\nRoot-Is-Purelib: false\n"
                              f"Tag: {_tag()}\n").encode()
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
    if len(sys.argv) == 3:
        print(_pack(sys.argv[2], sys.argv[1]))
    else:
        print(build_wheel(sys.argv[1]))
