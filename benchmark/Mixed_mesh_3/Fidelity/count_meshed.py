#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Meshes surfaces that may be dirty, and counts what became of them.

  count_meshed.py MESHER SURFACE... [--vertices N] [--json FILE] [--timeout S] [-- OPTION...]

A surface counts as right if a mesh was made, and the volume that was read is what surfaces.json beside it says
(see make_dirty_surfaces.py). Prints a line for each that is not, and the numbers.
"""

import argparse
import collections
import json
import pathlib
import subprocess
import sys
import tempfile

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2]))
from results import save_json  # noqa: E402


def run(mesher, surface, vertices, timeout, options):
    with tempfile.TemporaryDirectory() as folder:
        report = pathlib.Path(folder) / "report.json"
        command = [mesher.resolve(), surface, "--vertices", str(vertices), "--quiet", "--report", report, *options]
        try:
            done = subprocess.run([str(c) for c in command], capture_output=True, text=True, timeout=timeout,
                                  check=False)
        except subprocess.TimeoutExpired:
            return {"outcome": "no end", "message": f"after {timeout} s"}
        lines = [line for line in done.stderr.splitlines() if "error: " in line]
        if done.returncode != 0 or not report.exists():
            named = done.returncode == 1 and len(lines) == 1
            return {"outcome": "refused" if named else f"exit {done.returncode}",
                    "message": lines[-1].split("error: ", 1)[1] if lines else done.stderr.strip()[-200:]}
        told = json.loads(report.read_text())
        return {"outcome": "meshed", "status": told["status"], "volume": told["inputs"]["surface"]["volume"],
                "share": told["surface"]["ratio of volumes"], "seconds": told["seconds"],
                "repairs": told["inputs"]["surface"].get("repairs", [])}


def main():
    own, options = sys.argv[1:], []
    if "--" in own:
        own, options = own[:own.index("--")], own[own.index("--") + 1:]
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("mesher", type=pathlib.Path)
    parser.add_argument("surfaces", nargs="+", type=pathlib.Path)
    parser.add_argument("--vertices", type=int, default=2000)
    parser.add_argument("--timeout", type=float, default=120)
    parser.add_argument("--json", type=pathlib.Path)
    args = parser.parse_args(own)
    counts, results = collections.Counter(), {}
    for surface in args.surfaces:
        facts = surface.parent / "surfaces.json"
        expected = json.loads(facts.read_text()).get(surface.stem, {}) if facts.exists() else {}
        result = results[surface.stem] = run(args.mesher, surface, args.vertices, args.timeout, options)
        outcome = result["outcome"]
        if outcome == "meshed" and expected.get("volume") is not None:
            off = abs(result["volume"] / expected["volume"] - 1)
            if off > expected["tolerance"]:
                outcome = "meshed, but another volume"
                result["message"] = f"read {result['volume']}, not {expected['volume']}"
        counts[outcome] += 1
        if outcome != "meshed":
            print(f"{surface.stem}: {outcome}: {result['message']}", flush=True)
    if args.json:
        save_json(args.json, results)
    print(f"{len(args.surfaces)} surfaces: " + ", ".join(f"{n} {what}" for what, n in counts.most_common()))


if __name__ == "__main__":
    main()
