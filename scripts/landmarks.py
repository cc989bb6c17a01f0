#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Target registration errors on public data: checksums of what was fetched, and brain_shift on each case.

  scripts/landmarks.py record FOLDER              writes FOLDER/SHA256SUMS of its files of landmarks
  scripts/landmarks.py verify FOLDER              tells which files are others than those recorded
  scripts/landmarks.py measure CASES BRAIN_SHIFT [OPTION...]

Landmarks of brain shift are public in RESECT (doi 10.11582/2017.00004) and BITE (Mercier et al., Medical Physics 2012).
Fetch them yourself, under the terms that stand there. No checksums are known here that their authors publish. So `record`
writes down those of the files that you have, in the format of sha256sum, and `verify` tells later, or elsewhere, whether
they are the same. Whether the first ones were right, neither tells.

CASES is a table with the header mesh,landmarks or mesh,landmarks,landmarks_after; paths are relative to its folder. Meshes
are those of the brain in the space of the landmarks before. OPTIONs are for brain_shift, --fixed-below 0 for example. What
is printed is the mean over all landmarks of all cases, in mm.
"""

import csv
import hashlib
import json
import pathlib
import subprocess
import sys
import tempfile

ENDINGS = (".tag", ".fcsv", ".mrk.json", ".csv")
WAYS = ("leave one out", "by the outermost")


def checksums(folder):
    paths = sorted(p for p in folder.rglob("*") if p.is_file() and p.name.endswith(ENDINGS))
    return {p.relative_to(folder).as_posix(): hashlib.sha256(p.read_bytes()).hexdigest() for p in paths}


def record(folder):
    sums = checksums(folder)
    if not sums:
        sys.exit(f"{folder}: has no files of landmarks: {', '.join(ENDINGS)}")
    (folder / "SHA256SUMS").write_text("".join(f"{digest}  {name}\n" for name, digest in sums.items()))
    print(f"{folder / 'SHA256SUMS'}: {len(sums)} files")


def verify(folder):
    lines = (folder / "SHA256SUMS").read_text().splitlines()
    recorded = {name: digest for digest, name in (line.split("  ", 1) for line in lines)}
    found = checksums(folder)
    wrong = [f"{name}: {'is missing' if name not in found else 'is another one'}"
             for name, digest in recorded.items() if found.get(name) != digest]
    wrong += [f"{name}: is not recorded" for name in found if name not in recorded]
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{len(recorded)} files are those recorded")


def errors_of(case, folder, program, options):
    """Pairs of a way and a method, each with the errors of all its targets."""
    files = {key: str(folder / case[key]) for key in ("mesh", "landmarks", "landmarks_after") if case.get(key)}
    after = ["--landmarks-after", files["landmarks_after"]] if "landmarks_after" in files else []
    with tempfile.TemporaryDirectory() as work:
        report = pathlib.Path(work) / "report.json"
        subprocess.run([program, files["mesh"], "--landmarks", files["landmarks"], *after, "--quiet", "--report",
                        str(report), *options], check=True)
        points = json.loads(report.read_text())["landmarks"]["points"]
    keys = dict(zip(WAYS, ("errors if left out", "errors by the outermost")))
    return [(way, method, length) for way in WAYS for p in points for method, length in p.get(keys[way], {}).items()]


def measure(cases, program, options):
    with open(cases, newline="", encoding="utf-8") as file:
        table = list(csv.DictReader(file))
    if not table or not {"mesh", "landmarks"} <= set(table[0]):
        sys.exit(f"{cases}: expected a header mesh,landmarks or mesh,landmarks,landmarks_after, and a case in each line")
    errors = [e for case in table for e in errors_of(case, cases.parent, program, options)]
    print(f"{len(table)} cases; mean error in mm, and the number of landmarks predicted")
    for method in dict.fromkeys(method for _, method, _ in errors):
        cells = []
        for way in WAYS:
            lengths = [length for w, m, length in errors if (w, m) == (way, method)]
            cells.append(f"{way} {sum(lengths) / len(lengths):.2f} ({len(lengths)})" if lengths else f"{way} -")
        print(f"  {method + ':':20}{', '.join(cells)}")


def main():
    arguments = sys.argv[1:]
    try:
        if len(arguments) == 2 and arguments[0] in ("record", "verify"):
            {"record": record, "verify": verify}[arguments[0]](pathlib.Path(arguments[1]))
        elif len(arguments) > 2 and arguments[0] == "measure":
            measure(pathlib.Path(arguments[1]), arguments[2], arguments[3:])
        else:
            sys.exit(__doc__)
    except OSError as error:
        sys.exit(f"{error.filename}: {error.strerror}")
    except subprocess.CalledProcessError as error:
        sys.exit(f"{' '.join(error.cmd[:4])}: ended with {error.returncode}")


if __name__ == "__main__":
    main()
