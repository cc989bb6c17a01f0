#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Lays this repository out as it would lie in CGAL's source tree, and checks what CGAL asks of it.

  scripts/lay_out_as_cgal.py FOLDER      FOLDER is made anew

  FOLDER/Mixed_mesh_3/{include,doc,examples,test,demo,benchmark,package_info}, demo/ from apps/
  FOLDER/Linear_elasticity_3/{include,doc,examples,test,benchmark,package_info}
  FOLDER/Installation/include/CGAL/license/{Mixed_mesh_3,Linear_elasticity_3}.h

Elasticity is a package: whoever meshes for another solver does not want it, and it takes meshes from elsewhere.
Images and PETSc are none: CGAL has images of its own, and uses neither nifti_clib nor PETSc. They lie with the programs.

Checked: the notice of each header, with its license and what CGAL's scripts fill in; that headers of a package, and
no others, include its license; guards that begin with CGAL_ and are different; that names of programs say what
package they are of, as all programs of CGAL share one list of targets; the files of package_info.
"""

import pathlib
import re
import shutil
import sys

ROOT = pathlib.Path(__file__).resolve().parent.parent
# The package, with a word that each of its programs has in its name: tests get it here.
PACKAGES = {"Mixed_mesh_3": "mixed_mesh", "Linear_elasticity_3": "elasticity"}
# Folders of headers that are no packages: they lie with the programs, as they need libraries that CGAL does not use.
WITH_PROGRAMS = ("Mixed_mesh_image_3", "Mixed_mesh_petsc")
# Tests and benchmarks that need them.
NEED_PROGRAMS = ("test_petsc.cpp", "benchmark_elasticity.cpp", "measure_petsc.cpp")
DATA = ("brain.off", "region.off", "tumour.off", "README.md")
# Of tests, where they are not the folder of the data.
ARGUMENTS = {"test_io": "output", "test_io_read": "data output", "test_io_surface": "output"}
OURS = "// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org)."
NOTICE = re.compile(
    r"\A// Copyright \(c\) \d{4} [^\n]+\n(?://\n)?// This file is part of CGAL \(www\.cgal\.org\)\.\n//\n"
    r"// \$URL\$\n// \$Id\$\n// SPDX-License-Identifier: GPL-3\.0-or-later\n"
)
PACKAGE_INFO = ("copyright", "dependencies", "description.txt", "license.txt", "long_description.txt", "maintainer")

CMAKE = """\
# Created by scripts/lay_out_as_cgal.py of Mixed_mesh_3.

cmake_minimum_required(VERSION 3.12...3.31)
project({project})

set(CGAL_DATA_DIR "${{CMAKE_CURRENT_SOURCE_DIR}}/data")
find_package(CGAL REQUIRED)
find_package(Threads REQUIRED)
find_package(Eigen3 3.2.0 QUIET CONFIG)
include(CGAL_Eigen3_support)
find_package(TBB QUIET)
include(CGAL_TBB_support)

link_libraries(Threads::Threads)
if(TARGET CGAL::TBB_support)
  link_libraries(CGAL::TBB_support)
endif()
add_definitions(-DMIXED_MESH_3_DATA_DIR="${{CGAL_DATA_DIR}}")
{programs}
"""
PROGRAM = 'create_single_source_cgal_program("{name}.cpp")\n'
PROGRAM_EIGEN = """\
if(TARGET CGAL::Eigen3_support)
  create_single_source_cgal_program("{name}.cpp")
  target_link_libraries({name} PRIVATE CGAL::Eigen3_support)
endif()
"""

def needs_eigen(source):
    text = source.read_text()
    return re.search(r"fit_mixed_mesh_to_surface|Symmetric_solver_traits|Linear_elasticity_3|Eigen/|/fem/", text)


def write_cmake(folder, package, kind):
    """A CMakeLists.txt for the programs of a folder."""
    programs = ""
    for source in sorted(folder.glob("*.cpp")):
        text = PROGRAM_EIGEN if package != "Mixed_mesh_3" or needs_eigen(source) else PROGRAM
        programs += text.format(name=source.stem)
    (folder / "CMakeLists.txt").write_text(CMAKE.format(project=f"{package}_{kind}", programs=programs))


def package_of(path):
    """The package of a header, by its path below include/CGAL; what is shared by the programs is none."""
    name = path.parts[1] if path.parts[0] == "license" else path.parts[0]
    return next((p for p in ("Linear_elasticity_3", *WITH_PROGRAMS) if name.startswith(p)), "Mixed_mesh_3")


def copy_headers(target):
    for header in sorted((ROOT / "include").rglob("*.h")):
        path = header.relative_to(ROOT / "include" / "CGAL")
        package = package_of(path)
        if path.parts[0] == "license":
            place = target / "Installation"
        elif package in WITH_PROGRAMS:
            place = target / "Mixed_mesh_3" / "demo" / "Mixed_mesh_3"
        else:
            place = target / package
        copy = place / "include" / "CGAL" / path
        copy.parent.mkdir(parents=True, exist_ok=True)
        copy.write_text(header.read_text().replace(OURS, "// This file is part of CGAL (www.cgal.org)."))


def copy_programs(target, package):
    data = [ROOT / "data" / name for name in DATA]
    examples = target / package / "examples" / package
    shutil.copytree(ROOT / "examples" / package, examples)
    tests = target / package / "test" / package
    tests.mkdir(parents=True)
    for source in sorted((ROOT / "test" / package).glob("*.cpp")):
        if source.name.startswith("test_") and source.name not in NEED_PROGRAMS:
            stem = "test_" + PACKAGES[package] + source.stem[len("test"):]
            # Here, a test is a function of the program of its folder; there, a program.
            text = source.read_text()
            if f"namespace {source.stem} {{" in text:
                text += f"\nint main(int argc, char* argv[]) {{ return {source.stem}::run(argc, argv); }}\n"
            (tests / (stem + ".cpp")).write_text(text)
            (tests / (stem + ".cmd")).write_text(ARGUMENTS.get(source.stem, "data") + "\n") # for CGAL's ctest
    for header in [*(ROOT / "test" / "common").glob("*.h"), *(ROOT / "test" / package).glob("*.h")]:
        if header.name != "test_images.h":
            shutil.copy(header, tests)
    for folder, kind in ((examples, "Examples"), (tests, "Tests")):
        (folder / "data").mkdir()
        for file in data if kind == "Examples" else (ROOT / "data").iterdir():
            if file.is_file():
                shutil.copy(file, folder / "data")
        write_cmake(folder, package, kind)


def copy_documentation(target, package):
    folder = target / package / "doc" / package
    shutil.copytree(ROOT / "doc" / package, folder, ignore=shutil.ignore_patterns("standalone", "Doxyfile.in"))
    (folder / "Doxyfile.in").write_text(
        "@INCLUDE = ${CGAL_DOC_PACKAGE_DEFAULTS}\n"
        f'PROJECT_NAME = "CGAL ${{CGAL_DOC_VERSION}} - {title_of(package)}"\n'
        "EXTRACT_ALL = false\nHIDE_UNDOC_CLASSES = true\nWARN_IF_UNDOCUMENTED = false\n"
    )
    for text in folder.glob("*.txt"):
        # CGAL makes the bibliography itself, of the entries of *.bib.
        text.write_text(re.sub(r"\\section \w+_references .*?(?=\n\*/)", "", text.read_text(), flags=re.S))


def title_of(package):
    description = (ROOT / "doc" / package / "PackageDescription.txt").read_text()
    return re.search(r"\\cgalPkgDescriptionBegin\{([^,]+),", description).group(1)


def lay_out(target):
    if target.exists():
        shutil.rmtree(target)
    copy_headers(target)
    for package in PACKAGES:
        copy_programs(target, package)
        copy_documentation(target, package)
        shutil.copytree(ROOT / "package_info" / package, target / package / "package_info" / package)
        benchmarks = shutil.ignore_patterns(*NEED_PROGRAMS, "CMakeLists.txt")
        shutil.copytree(ROOT / "benchmark" / package, target / package / "benchmark" / package, ignore=benchmarks)
    demo = target / "Mixed_mesh_3" / "demo" / "Mixed_mesh_3"
    shutil.copytree(ROOT / "apps", demo, dirs_exist_ok=True)
    shutil.copytree(ROOT / "third_party", demo / "third_party")
    for source in (ROOT / "examples" / "Mixed_mesh_image_3").glob("*.cpp"):
        shutil.copy(source, demo)


def header_defects(target):
    guards = {}
    for header in sorted(target.rglob("include/CGAL/**/*.h")):
        text, name = header.read_text(), header.relative_to(target)
        path = header.relative_to(next(p for p in header.parents if p.name == "CGAL"))
        if not NOTICE.match(text):
            yield f"{name}: the notice is not copyright, part of CGAL, $URL$, $Id$, SPDX, in these lines"
        guard = re.search(r"^#ifndef (\w+)\n#define (\w+)$", text, re.MULTILINE)
        if not guard or guard.group(1) != guard.group(2) or not guard.group(1).startswith("CGAL_"):
            yield f"{name}: no guard that begins with CGAL_"
        elif guards.setdefault(guard.group(1), name) != name:
            yield f"{name}: has the guard of {guards[guard.group(1)]}"
        licenses = re.findall(r"#include <CGAL/license/(\w+)\.h>", text)
        package = package_of(path)
        expected = [] if path.parts[0] == "license" or package in WITH_PROGRAMS else [package]
        if licenses != expected:
            yield f"{name}: includes the licenses of {licenses or 'none'}, expected {expected or 'none'}"


def program_defects(target):
    seen = {}
    for package, word in PACKAGES.items():
        for kind in ("examples", "test"):
            for source in sorted((target / package / kind).rglob("*.cpp")):
                if word not in source.stem:
                    yield f"{source.relative_to(target)}: the name of the program does not say '{word}'"
                if seen.setdefault(source.stem, source) != source:
                    yield f"{source.relative_to(target)}: there is {seen[source.stem].relative_to(target)}, too"
    for file in sorted(target.rglob("*")):
        if file.suffix in (".cpp", ".h") and "internal/" not in str(file) and "demo" not in file.parts:
            if re.search(rf"#include <CGAL/({'|'.join(WITH_PROGRAMS)})/", file.read_text()):
                yield f"{file.relative_to(target)}: needs what is with the programs"


def info_defects(target):
    for package in PACKAGES:
        for name in PACKAGE_INFO:
            file = target / package / "package_info" / package / name
            if not file.is_file() or not file.read_text().strip():
                yield f"{file.relative_to(target)} is missing or empty"


def main():
    if len(sys.argv) != 2 or sys.argv[1].startswith("-"):
        sys.exit(__doc__)
    target = pathlib.Path(sys.argv[1]).resolve()
    lay_out(target)
    defects = [*header_defects(target), *program_defects(target), *info_defects(target)]
    for defect in defects:
        print(defect)
    print(f"{sum(1 for file in target.rglob('*') if file.is_file())} files, {len(defects)} defects")
    return 1 if defects else 0


if __name__ == "__main__":
    sys.exit(main())
