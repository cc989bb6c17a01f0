#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes surfaces with constants of the package multiplied by factors, and prints what that changes, in Markdown.

  vary_constants.py WORK SURFACE... --constants meshing/Misfit.h:tolerated_volume fitting/mend.h:worst ...
                    [--factors 0.5 2] [--vertices 2000]

WORK gets a copy of the package in which these constants of include/CGAL/Mixed_mesh_3/internal are read at run time, and
its program. The bundled brain, with its region (700 vertices and as many as asked for) and with its tumor, is meshed
too. The meshes of a constant are compared with those of the package as it is: how many are the same to the byte; of the
others, the median ratio of largest distances, how many of these are larger or smaller by a tenth, and the mean change of
the share of sharp edges kept; the ratio of CPU seconds; and how many meshes have another status, other vertices off the
surface or a volume that differs by 0.4 %.
"""

import argparse
import hashlib
import json
import os
import pathlib
import re
import resource
import shutil
import statistics
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "benchmark"))
from results import markdown  # noqa: E402

HEADERS = pathlib.Path("include/CGAL/Mixed_mesh_3/internal")
DEFINITION = re.compile(r"^(\s*)((?:static |inline )*)constexpr (double|int|std::size_t) (.*?);(.*)$")
FACTOR = """#pragma once
#include <cstdlib>
#include <string>
inline double varied(const char* name, double value)
{
  static const std::string all = std::getenv("VARIED") != nullptr ? std::getenv("VARIED") : "";
  const std::string::size_type at = all.find(std::string(name) + "=");
  return at == std::string::npos ? value : value * std::atof(all.c_str() + at + std::string(name).size() + 1);
}
"""


def vary(header, name):
    """Lets the constant of a header be multiplied at run time."""
    found = False

    def replace(match):
        nonlocal found
        indent, specifiers, kind, values, comment = match.groups()
        varied = re.sub(rf"\b{name} = ([^,]+)", rf'{name} = {kind}(varied("{header.stem}:{name}", \1))', values)
        if varied == values:
            return match[0]
        found = True
        kept = "static inline " if "static" in specifiers else specifiers
        return f"{indent}{kept}const {kind} {varied};{comment}"

    text = re.sub(DEFINITION.pattern, replace, header.read_text(), flags=re.MULTILINE)
    if not found:
        sys.exit(f"vary_constants.py: error: {header} has no constant {name} on a line of its own")
    include = "#include <CGAL/license/Mixed_mesh_3.h>"
    header.write_text(text.replace(include, include + "\n#include <varied.h>", 1) if "varied.h>" not in text else text)


def build(work, constants):
    source = work / "source"
    shutil.rmtree(source, ignore_errors=True)
    for file in subprocess.run(["git", "-C", ROOT, "ls-files", "-z"], check=True, stdout=subprocess.PIPE,
                               text=True).stdout.split("\0")[:-1]:
        if (ROOT / file).is_file():
            (source / file).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(ROOT / file, source / file)
    (source / "include" / "varied.h").write_text(FACTOR)
    for header, name in constants:
        vary(source / HEADERS / header, name)
    configure = ["cmake", "-S", source, "-B", work / "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release"]
    subprocess.run(configure, check=True, stdout=sys.stderr)
    subprocess.run(["cmake", "--build", work / "build", "--target", "mixed_mesh_3"], check=True,
                   stdout=sys.stderr)
    return work / "build" / "bin" / "mixed_mesh_3"


def mesh(program, work, arguments, varied):
    """What counts of a mesh; its status alone if there is none."""
    report, file = work / "report.json", work / "mesh.vtu"
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    run = subprocess.run([program, *arguments, "--threads", "1", "--quiet", "--report", report, "--output", file],
                         stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, env={**os.environ, "VARIED": varied})
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    result = {"CPU": after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, "state": run.returncode}
    if run.returncode == 0:
        told = json.loads(report.read_text())
        surface = told["surface"]
        result.update(state=(told["status"], surface["boundary vertices not on surface"]),
                      distance=surface["Hausdorff distance"]["distance"], volume=surface["ratio of volumes"],
                      edges=(told["fitting"].get("sharp edges") or {}).get("share kept"),
                      bytes=hashlib.sha256(file.read_bytes()).hexdigest())
    return result


def compared(now, then):
    """A row of what has changed, of meshes of the same inputs."""
    def differ(a, b):
        return a["state"] != b["state"] or abs(a.get("volume", 1) - b.get("volume", 1)) > 0.004
    pairs = [(a, b) for a, b in zip(now, then) if a.get("bytes") != b.get("bytes")]
    ratios = [a["distance"] / b["distance"] for a, b in pairs if a.get("distance", 0) > 0 and b.get("distance", 0) > 0]
    edges = [a["edges"] - b["edges"] for a, b in pairs if a.get("edges") is not None and b.get("edges") is not None]
    seconds = [sum(m["CPU"] for m in meshes) for meshes in (now, then)]
    return {"same": f"{len(now) - len(pairs)} of {len(now)}",
            "distances": f"{statistics.median(ratios):.2f}" if ratios else "",
            "larger": sum(r > 1.1 for r in ratios), "smaller": sum(r < 0.9 for r in ratios),
            "edges kept": f"{sum(edges) / len(edges):+.3f}" if edges else "",
            "CPU": f"{seconds[0] / seconds[1]:.2f}", "differ": sum(differ(a, b) for a, b in zip(now, then))}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("surfaces", nargs="+")
    parser.add_argument("--constants", nargs="+", required=True, metavar="HEADER:NAME")
    parser.add_argument("--factors", nargs="+", default=["0.5", "2"])
    parser.add_argument("--vertices", default="2000")
    options = parser.parse_intermixed_args()
    constants = [c.rsplit(":", 1) for c in options.constants]
    work = options.work.resolve()
    program = build(work, constants)
    brain = [ROOT / "data" / "brain.off"]
    region, tumor = ["--region", ROOT / "data" / "region.off"], ["--subdomain", f"tumor={ROOT / 'data' / 'tumour.off'}"]
    inputs = [[s, "--vertices", options.vertices] for s in options.surfaces]
    inputs += [[*brain, *region, "--vertices", n] for n in ("700", options.vertices)]
    inputs.append([*brain, *tumor, "--vertices", options.vertices])
    then = [mesh(program, work, i, "") for i in inputs]
    rows = []
    for header, name in constants:
        for factor in options.factors:
            now = [mesh(program, work, i, f"{pathlib.Path(header).stem}:{name}={factor}") for i in inputs]
            rows.append({"constant": f"`{name}` of `{header}`", "factor": factor, **compared(now, then)})
            print(rows[-1], file=sys.stderr, flush=True)
    print(markdown(rows), end="")


if __name__ == "__main__":
    main()
