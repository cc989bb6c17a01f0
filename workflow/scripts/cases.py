# SPDX-License-Identifier: GPL-3.0-or-later
"""The table of cases: what its columns are, and what is wrong with it, in one line."""

import csv
import math
import pathlib
import re

# Columns that name files; those of the brain and of what is resected may be images.
FILES = ("brain", "region", "control_points", "image")
# Options of mixed_mesh_3 and brain_shift with one number, or with any text.
MESH_NUMBERS = ("threshold", "smoothing", "vertices", "tolerance")
MESH_TEXTS = ("labels", "region_labels")
SHIFT_NUMBERS = ("fixed_below", "slide_beyond", "control_radius", "young_modulus", "poisson_ratio",
                 "fluid_level")
SHIFT_TEXTS = ("tumor_label", "up", "gravity", "material")
COLUMNS = ("id", *FILES, "tumor", "opening", *MESH_NUMBERS, *MESH_TEXTS, *SHIFT_NUMBERS, *SHIFT_TEXTS)


class Bad_table(Exception):
    """One line, with the place."""


def ball(text):
    """The numbers of `x y z radius`, or None."""
    try:
        numbers = [float(word) for word in text.split()]
    except ValueError:
        return None
    if len(numbers) != 4 or not all(map(math.isfinite, numbers)) or numbers[3] <= 0:
        return None
    return numbers


def _check(case, folder):
    """Makes the files of a row absolute; what is wrong with it, if anything."""
    if not re.fullmatch(r"[A-Za-z0-9][A-Za-z0-9_-]*", case["id"]):
        return f'id "{case["id"]}": expected letters, digits, _ and -'
    if not case["brain"]:
        return "brain: a surface or an image is missing"
    for name in (*FILES, "tumor"):
        if not case[name] or name == "tumor" and ball(case[name]):
            continue
        path = folder / case[name]
        if not path.is_file():
            return f"{name}: there is no file {path}"
        case[name] = str(path)
    if case["opening"] and not ball(case["opening"]):
        return f'opening: expected x y z radius, not "{case["opening"]}"'
    if case["tumor"] and case["tumor_label"]:
        return "tumor and tumor_label: expected one of them"
    if case["opening"] and not case["region"] and case["tumor"] and not ball(case["tumor"]):
        if not case["tumor"].endswith(".off"):
            return "tumor: expected x y z radius, or a file .off, to make a region of it and the opening"
    for name in (*MESH_NUMBERS, *SHIFT_NUMBERS):
        try:
            if case[name] and not math.isfinite(float(case[name])):
                raise ValueError
        except ValueError:
            return f'{name}: "{case[name]}" is not a number'
    return None


def read_cases(path, loads):
    """The cases by id, in the order of the table: .csv, or .tsv with tabulators. Raises Bad_table."""
    path = pathlib.Path(path).resolve()
    try:
        with open(path, newline="", encoding="utf-8-sig") as file:
            lines = [(i, line) for i, line in enumerate(file, 1) if line.strip() and not line.startswith("#")]
        rows = list(csv.reader((line for _, line in lines), delimiter="\t" if path.suffix == ".tsv" else ","))
    except (OSError, UnicodeDecodeError, csv.Error) as error:
        raise Bad_table(f"{path}: {getattr(error, 'strerror', None) or error}") from None
    if len(rows) < 2:
        raise Bad_table(f"{path}: there are no cases")
    if len(rows) != len(lines):
        raise Bad_table(f"{path}: a cell has more than one line")
    names = [name.strip() for name in rows[0]]
    for name in names:
        if name not in COLUMNS:
            raise Bad_table(f'{path}: line {lines[0][0]}: unknown column "{name}": expected some of '
                            + ", ".join(COLUMNS))
        if names.count(name) > 1:
            raise Bad_table(f'{path}: line {lines[0][0]}: column "{name}" is there twice')
    cases = {}
    for (line, _), row in zip(lines[1:], rows[1:]):
        if len(row) != len(names):
            raise Bad_table(f"{path}: line {line}: expected {len(names)} cells, not {len(row)}")
        case = {**dict.fromkeys(COLUMNS, ""), **dict(zip(names, map(str.strip, row)))}
        wrong = _check(case, path.parent)
        if not wrong and case["id"] in cases:
            wrong = f'id "{case["id"]}" is there twice'
        if not wrong and not case["control_points"] and loads == 0:
            wrong = "control_points: missing, and no loads are drawn (--config loads=N)"
        if wrong:
            raise Bad_table(f"{path}: line {line}: {wrong}")
        cases[case["id"]] = case
    return cases


def options(case, names):
    """The options of a program that a case has; several values are separated by semicolons."""
    pairs = [("--" + name.replace("_", "-"), value.strip()) for name in names
             for value in case[name].split(";") if value.strip()]
    return [f"{name}={value}" for name, value in pairs]
