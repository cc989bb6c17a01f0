# SPDX-License-Identifier: GPL-3.0-or-later
"""What the benchmarks save: a table in Markdown and CSV, and all that was measured, with the machine, in JSON."""

import csv
import datetime
import json
import os
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


def save(base, table, measured):
    base.with_suffix(".md").write_text(markdown(table))
    base.with_suffix(".json").write_text(json.dumps({"machine": machine(), "rows": measured}, indent=2) + "\n")
    with open(base.with_suffix(".csv"), "w", newline="") as out:
        writer = csv.DictWriter(out, max(table, key=len).keys())
        writer.writeheader()
        writer.writerows(table)
