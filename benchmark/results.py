# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmarks save: a table in Markdown and CSV, and all that was measured, with the machine, in JSON.

JSON files of results are read by load_json() and written by save_json().
"""

import csv
import datetime
import json
import os
import pathlib
import platform


def machine():
    with open("/proc/cpuinfo") as info:
        names = [line.split(":")[1].strip() for line in info if line.startswith("model name")]
    return {"date": datetime.date.today().isoformat(), "processor": (names or [platform.processor()])[0],
            "processors": os.cpu_count(), "load": os.getloadavg()[0], "system": platform.platform()}


def markdown(table):
    """A table of dictionaries; the longest has the columns."""
    heads = list(max(table, key=len))
    lines = ["| " + " | ".join(heads) + " |", "|---|" + "--:|" * (len(heads) - 1)]
    lines += ["| " + " | ".join(str(row.get(h, "")) for h in heads) + " |" for row in table]
    return "\n".join(lines) + "\n"


def json_text(content):
    """JSON with a line for each row: few lines, and a row that changed is a line of a diff."""
    def rows_of(value, indent):
        if not (isinstance(value, list) and value and all(isinstance(row, dict) for row in value)):
            return json.dumps(value)
        return "[\n" + ",\n".join(f"{indent} {json.dumps(row)}" for row in value) + f"\n{indent}]"
    if not isinstance(content, dict):
        return rows_of(content, "") + "\n"
    return "{\n" + ",\n".join(f" {json.dumps(key)}: {rows_of(value, ' ')}" for key, value in content.items()) + "\n}\n"


def load_json(file):
    return json.loads(pathlib.Path(file).read_text(encoding="utf-8"))


def save_json(file, content):
    pathlib.Path(file).write_text(json_text(content), encoding="utf-8")


def save(base, table, measured):
    base.with_suffix(".md").write_text(markdown(table))
    save_json(base.with_suffix(".json"), {"machine": machine(), "rows": measured})
    with open(base.with_suffix(".csv"), "w", newline="") as out:
        writer = csv.DictWriter(out, max(table, key=len).keys())
        writer.writeheader()
        writer.writerows(table)
