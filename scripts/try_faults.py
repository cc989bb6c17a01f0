#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Puts faults into a copy of the committed tree, one at a time, and checks that continuous integration finds each.

  scripts/try_faults.py [--build DIR] [--jobs N] [NAME...]     all faults, or those named
  scripts/try_faults.py --list                                 their names, and what each changes

A fault replaces a piece of text in one file, which must be there exactly once: --list fails, too, if a file has
changed so that it is not. Then the smallest command of .ci/run that should find the fault runs: a part of
scripts/check.sh, or one test, in a Release build or in that of the part `checked`. It must fail, and say what is
expected, so that a fault that does not compile does not count as found by a test. Without a fault it must pass,
which is checked once a command. There is a line a fault: name, part, caught or NOT CAUGHT, seconds; the status
is 1 if one is not caught, 2 if the list does not fit the tree.

The copy has what is committed, and its own build directories: the checkout stays as it is. It lies in a temporary
folder that is removed in the end, or in DIR, which is kept: a second run builds what changed only. N is the number
of compilers at once, 1 by default; scripts/check.sh chooses its own. Nothing is installed. All faults take about
15 minutes on one core, and the first build as long as that, or less with what ccache has.
"""

import argparse
import os
import pathlib
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import time
from typing import NamedTuple

ROOT = pathlib.Path(__file__).resolve().parent.parent
TIME_LIMIT = 1800  # seconds a command; a test has a limit of its own
SANITIZERS = {"UBSAN_OPTIONS": "print_stacktrace=1", "ASAN_OPTIONS": "detect_stack_use_after_return=1"}  # check.sh


class Check(NamedTuple):
    """What continuous integration runs, and the part of it that this is."""
    part: str
    program: str = ""  # that has the test
    test: str = ""


FORMAT, SHELL, PYTHON, LAYERS, DOC, HEADERS = (
    Check("check.sh " + part) for part in ("format", "shell", "python", "layers", "doc", "headers"))


def release(program, test):
    return Check("release: " + test, program, test)


def checked(program, test):
    return Check("check.sh checked: " + test, program, test)


class Fault(NamedTuple):
    """A piece of text of a file, what stands there instead, what finds it, and what that says then."""
    name: str
    what: str
    file: str
    old: str
    new: str
    check: Check
    reason: str


CGAL = "include/CGAL/"
MESH = CGAL + "Mixed_mesh_3/"
INTERNAL = MESH + "internal/"

# Neighbors share what they build: those of one program stand together.
FAULTS = [
    Fault("overlong_line", "a comment of more than 110 columns",
          MESH + "Face.h", "/// Compares faces in the order of the elements.",
          "/// Compares faces in the order of the elements, and in an element in that of its local indices, those of "
          "Reference_element.",
          FORMAT, r"Face\.h:\d+:.*\n(.*\n)*.*lines of more than 110 columns"),
    Fault("unquoted_variable", "a path without quotes in a shell script",
          "scripts/mesh_brain.sh", 'mkdir -p "$out"', "mkdir -p $out",
          SHELL, r"mesh_brain\.sh line \d+(.*\n)*.*SC2086"),
    Fault("undefined_name", "a variable of Python renamed in one of two places",
          "scripts/show_build_times.py", "built, tested = {}, {}", "builds, tested = {}, {}",
          PYTHON, r"show_build_times\.py:.*undefined name 'built'"),
    Fault("include_upwards", "the octree includes the fitting stage",
          INTERNAL + "octree/balance.h", "#include <CGAL/Mixed_mesh_3/options.h>",
          "#include <CGAL/Mixed_mesh_3/internal/fitting/Optimization_effort.h>\n#include <CGAL/Mixed_mesh_3/options.h>",
          LAYERS, r"octree must not reach fitting: .*balance\.h"),
    Fault("undocumented_name", "a public member without documentation",
          MESH + "Face.h", "  /// The element that the face belongs to.\n", "",
          DOC, r"::Face::element: not documented"),
    Fault("missing_include", "a header that compiles only after others",
          MESH + "Scaled_jacobian_quality_3.h", "#include <CGAL/Mixed_mesh_3/Element_list.h>\n", "",
          HEADERS, r"Scaled_jacobian_quality_3\.h:\d+:\d+: error: .*'Element_kind'"),
    Fault("balance_comparison", "neighbors across edges are left out of the balance across edges",
          INTERNAL + "octree/balance.h", "directions_up_to(1), directions_up_to(2)", "directions_up_to(1), directions_up_to(1)",
          release("test_octree", "test_octree"), r"is_balanced\(cells, adjacency\)' failed"),
    Fault("template_row", "two vertices exchanged in a hexahedron of a transition template",
          INTERNAL + "transitions/transition_tables.h", "3,1,2,8,7,19,20,26,25,\n  // 0x011",
          "3,1,2,8,7,19,20,25,26,\n  // 0x011",
          release("test_transitions", "test_transitions_tables"),
          r"test_transitions_tables\.cpp\(\d+\): test .* failed"),
    Fault("boundary_order", "elements at the boundary split by the reverse order of vertices",
          INTERNAL + "boundary/split_by_order.h", "rank(a) < rank(b)", "rank(a) > rank(b)",
          release("test_boundary", "test_boundary"), r"test_boundary\.cpp\(\d+\): test .* failed"),
    Fault("certificate_filter", "the bound of rounding errors of the certificate, 1000 times too small",
          MESH + "certificate.h", "std::ldexp(96., -53)", "std::ldexp(96., -63)",
          release("test_elements", "test_elements_certificate"),
          r"test_elements_certificate\.cpp\(\d+\): test 'jacobian_sign.* failed"),
    Fault("missing_case", "a switch over the kinds of elements without prisms",
          INTERNAL + "elements/with_kind.h",
          "  case PRISM: return f(std::integral_constant<Element_kind, PRISM>());\n", "",
          release("test_elements", "test_elements_locator"), r"enumeration value .PRISM. not handled.*-Werror=switch"),
    Fault("wedge_order", "wedges of VTK written in our order of vertices",
          MESH + "IO/internal/mesh/element_names.h", "{13, {0, 2, 1, 3, 5, 4}", "{13, {0, 1, 2, 3, 4, 5}",
          release("test_io", "test_io_readers"), r"prism is inside out for VTK"),
    Fault("truncated_file", "a file of Gmsh that ends before its elements is an empty mesh",
          MESH + "IO/internal/mesh/read_MSH.h", "if(!m_has_nodes || !m_has_elements)", "if(!m_has_nodes && !m_has_elements)",
          release("test_io", "test_io_read"), r"test_io_read\.cpp\(\d+\): test .* failed"),
    Fault("mean_dilatation", "the bulk modulus of an element not divided by its volume",
          INTERNAL + "fem/element_stiffness.h", "material.bulk_modulus() / volume", "material.bulk_modulus()",
          release("test_fem", "test_fem"), r"test_fem\.cpp\(\d+\): test .* failed"),
    Fault("largest_piece", "of the pieces after a resection, all but the smallest count as loose",
          INTERNAL + "resection/Resection_repair.h", "volume > pieces[best].volume", "volume < pieces[best].volume",
          release("test_resection", "test_resection"), r"test_resection\.cpp\(\d+\): test .* failed"),
    Fault("image_orientation", "the qform of an image read where it has a sform",
          CGAL + "Mixed_mesh_image_3/IO/internal/read_NIFTI.h", "has_sform ? header.sto_xyz : header.qto_xyz",
          "header.qform_code > 0 ? header.qto_xyz : header.sto_xyz",
          release("test_images", "test_image_io"), r"test_image_io\.cpp\(\d+\): test .* failed"),
    Fault("leak", "the header of an image is not freed",
          CGAL + "Mixed_mesh_image_3/IO/internal/read_NIFTI.h", "(nifti_image* header) const { nifti_image_free(header); }",
          "(nifti_image*) const {}",
          checked("test_images", "test_image_io"), r"LeakSanitizer: detected memory leaks"),
    Fault("out_of_bounds", "the table of cells of the locator is one too short",
          MESH + "Element_locator_3.h", "m_ends.assign(m_size[0] * m_size[1] * m_size[2] + 2, 0)",
          "m_ends.assign(m_size[0] * m_size[1] * m_size[2] + 1, 0)",
          checked("test_elements", "test_elements_locator"), r"AddressSanitizer: heap-buffer-overflow"),
    Fault("quality_gradient", "a factor lost in the gradient of a quality",
          MESH + "Scaled_jacobian_quality_3.h", "scaled > 1 ? scaled * q * q : -q", "scaled > 1 ? q * q : -q",
          release("test_fitting", "test_fitting_parts"), r"test_fitting_parts\.cpp\(\d+\): test .*gradient.* failed"),
    Fault("python_default", "another default in Python than in C++",
          "python/src/mixed_mesh_3/__init__.py", "grading=0.35, simplification",
          "grading=0.5, simplification",
          release("Mixed_mesh_3_python mixed_mesh_3 brain_shift", "test_python"), r"FAIL: test_same_bytes_as_program"),
]


def git(*arguments, folder=ROOT):
    return subprocess.run(["git", "-C", str(folder), *arguments], check=True, capture_output=True, text=True).stdout


def misfits(folder, faults):
    """A line for each fault whose text is not there exactly once."""
    for fault in faults:
        path = folder / fault.file
        count = path.read_text(encoding="utf-8").count(fault.old) if path.exists() else 0
        if count != 1:
            yield f"{fault.name}: {fault.file} has {count} times, not once: {fault.old!r}"


def report(lines):
    """Prints what is wrong; returns whether something is."""
    lines = list(lines)
    print("".join(line + "\n" for line in lines), end="", file=sys.stderr)
    return bool(lines)


def read(log):
    return log.read_text(encoding="utf-8", errors="replace")


class Copy:
    """A clone of the checkout, with build directories."""

    def __init__(self, folder, jobs):
        self.tree, self.logs, self.jobs = folder / "copy", folder / "logs", jobs
        self.configured, self.passed = set(), set()
        self.logs.mkdir(parents=True, exist_ok=True)
        if not self.tree.exists():
            git("clone", "--quiet", "--shared", "--no-checkout", str(ROOT), str(self.tree))
        commit = git("rev-parse", "HEAD").strip()
        git("fetch", "--quiet", str(ROOT), "HEAD", folder=self.tree)
        git("checkout", "--quiet", "--force", "--detach", commit, folder=self.tree)
        # Headers that changed since BASE are those of the fault: HEAD itself would mean all.
        git("-c", "user.name=faults", "-c", "user.email=faults@localhost", "commit", "--quiet", "--allow-empty",
            "--message", "Faults go here", folder=self.tree)

    def run(self, command, log, **environment):
        """Runs a command of the copy; returns whether it passed. What it says is added to a file."""
        with open(log, "a", encoding="utf-8") as out:
            out.write("$ " + " ".join(command) + "\n")
            out.flush()
            try:
                return subprocess.run(command, cwd=self.tree, stdin=subprocess.DEVNULL, stdout=out,
                                      stderr=subprocess.STDOUT, timeout=TIME_LIMIT,
                                      env={**os.environ, "SKIP_SETUP": "1", **environment}).returncode == 0
            except subprocess.TimeoutExpired:
                out.write(f"took more than {TIME_LIMIT} s\n")
                return False

    def configure(self, build, log):
        """As scripts/check.sh and scripts/test.sh do, once a run."""
        if build in self.configured:
            return True
        options = (["--preset", "checked"] if build == "build/checked" else
                   ["-DCMAKE_BUILD_TYPE=Release", "-DBUILD_TESTING=ON", "-DMIXED_MESH_3_BUILD_PYTHON=ON",
                    "-DPython_EXECUTABLE=/usr/bin/python3"])
        if self.run(["cmake", "-S", ".", "-B", build, "-G", "Ninja", *options], log):
            self.configured.add(build)
        return build in self.configured

    def passes(self, check, log):
        """Whether the tree passes a check."""
        log.unlink(missing_ok=True)
        if not check.test:
            return self.run(["scripts/check.sh", check.part.split()[1]], log, BUILD_DIR=str(self.tree / "build"),
                            BASE="HEAD~", CHECK_ALL="")
        sanitized = "checked" in check.part
        build = "build/checked" if sanitized else "build/release"
        return (self.configure(build, log)
                and self.run(["cmake", "--build", build, "--parallel", str(self.jobs), "--target",
                              *check.program.split()], log)
                and self.run(["ctest", "--test-dir", build, "--output-on-failure", "--no-tests=error",
                              "-R", f"^{check.test}$"], log, **(SANITIZERS if sanitized else {})))

    def passes_without_fault(self, fault):
        """Whether the check passes; the part headers is shown a change that does no harm."""
        key = (fault.check, fault.file) if fault.check == HEADERS else fault.check
        if key not in self.passed:
            path = self.tree / fault.file
            text = path.read_bytes()
            if fault.check == HEADERS:
                path.write_bytes(text + b"// as it is\n")
            try:
                log = self.logs / (re.sub(r"\W+", "_", fault.check.part) + ".log")
                if self.passes(fault.check, log) and not re.search(r"Not Run|\*Skipped", read(log)):
                    self.passed.add(key)
            finally:
                path.write_bytes(text)
        return key in self.passed

    def verdict(self, fault):
        """Why a fault is not caught, empty if it is, and the seconds that the check took."""
        if not self.passes_without_fault(fault):
            return "the check fails without the fault, or does not run", 0
        path, log = self.tree / fault.file, self.logs / (fault.name + ".log")
        text = path.read_text(encoding="utf-8")
        started = time.monotonic()
        path.write_text(text.replace(fault.old, fault.new), encoding="utf-8")
        try:
            passed = self.passes(fault.check, log)
        finally:
            path.write_text(text, encoding="utf-8")  # as new, so that what was built with the fault is built again
        seconds = time.monotonic() - started
        if passed:
            return "the check passes", seconds
        if not re.search(fault.reason, read(log)):
            return f"the check fails for another reason: {(read(log).splitlines() or [''])[-1].strip()}", seconds
        return "", seconds


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("names", metavar="NAME", nargs="*", help="a fault")
    parser.add_argument("--list", action="store_true", help="tell the faults, and whether they fit the tree")
    parser.add_argument("--build", metavar="DIR", type=pathlib.Path, help="where the copy lies, and is kept")
    parser.add_argument("--jobs", metavar="N", type=int, default=1, help="compilers at once")
    arguments = parser.parse_args()
    unknown = set(arguments.names) - {fault.name for fault in FAULTS}
    if unknown:
        parser.error("no such fault: " + ", ".join(sorted(unknown)))
    faults = [fault for fault in FAULTS if not arguments.names or fault.name in arguments.names]

    if arguments.list:
        for fault in faults:
            print(f"{fault.name:20} {fault.check.part:42} {fault.what}\n{'':20} {fault.file}")
        sys.exit(2 if report(misfits(ROOT, faults)) else 0)

    signal.signal(signal.SIGTERM, lambda *_: sys.exit("terminated"))  # and what is to be undone is
    folder = (arguments.build or pathlib.Path(tempfile.mkdtemp(prefix="faults_"))).resolve()
    try:
        copy = Copy(folder, arguments.jobs)
        if report(misfits(copy.tree, faults)):
            sys.exit(2)
        missed = 0
        for fault in faults:
            why_not, seconds = copy.verdict(fault)
            missed += bool(why_not)
            print(f"{fault.name:20} {fault.check.part:42} {'NOT CAUGHT' if why_not else 'caught':10} {seconds:6.0f} s"
                  + (f"  {why_not}" if why_not else ""), flush=True)
        print(f"{len(faults) - missed} of {len(faults)} faults caught")
        sys.exit(1 if missed else 0)
    finally:
        if arguments.build is None:
            shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    main()
