# SPDX-License-Identifier: GPL-3.0-or-later
"""The table and the page of a cohort, of the reports and logs in the working directory."""

import csv
import html
import io
import json
import pathlib

from text_files import write_text

COLUMNS = ("id", "status", "brain", "vertices", "elements", "ARC mean", "ARC max", "Hausdorff mm",
           "loads done", "loads", "largest shift mm", "loads with inverted elements", "warnings", "message")
LOAD_COLUMNS = ("id", "load", "status", "displacements", "largest shift mm", "inverted elements",
                "resected ml", "opening", "opening_radius", "depth", "against_gravity", "fluid_level",
                "fixed_below", "resected", "message")
STYLE = """body { font: 15px sans-serif; margin: 2em; color: #222 } table { border-collapse: collapse }
td, th { padding: .25em .7em; text-align: right; border-bottom: 1px solid #ddd; vertical-align: top }
th { background: #f3f3f3 } td:first-child, td:last-child, th:first-child, th:last-child { text-align: left }
td:last-child { max-width: 45em; overflow-wrap: anywhere }
tr.failed { background: #fde8e8 } tr.missing { background: #fdf6dd } details { margin: .4em 0 }
rect { fill: #4a7fb5 } rect.inverted { fill: #d08a2e }"""


def _report(path):
    try:
        return json.loads(pathlib.Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return None


def _message(*logs):
    """The line that tells what failed, of the first step that did; empty: none has."""
    for log in logs:
        try:
            lines = pathlib.Path(log).read_text(encoding="utf-8", errors="replace").splitlines()
        except OSError:
            continue
        lines = [line.strip() for line in lines if line.strip() and not line.startswith("warning")]
        told = [line for line in lines if "error:" in line] or lines
        if told:
            return "".join(c if c.isprintable() else "?" for c in told[-1])[:400]
    return ""


def _load_row(id, load):
    folder, row = f"{id}/{load}", dict.fromkeys(LOAD_COLUMNS, "")
    row.update(id=id, load=load, **(_report(f"{folder}/load.json") or {}).get("drawn", {}))
    report = _report(f"{folder}/shift.json")
    if report and pathlib.Path(f"{folder}/shift.vtu").is_file():
        after = report.get("shift after resection") or report["shift"]
        removed = (report.get("resection") or {}).get("cavity volume", 0)
        row.update({"status": "done", "displacements": f"{folder}/shift.vtu",
                    "largest shift mm": f"{after['largest displacement']:.3f}",
                    "inverted elements": after["inverted elements"], "resected ml": f"{removed / 1000:.2f}"})
        return row, len(report["warnings"])
    row["message"] = _message(f"logs/{id}/{load}_draw.log", f"logs/{id}/{load}.log", f"logs/{id}/grid.log")
    row["status"] = "failed" if row["message"] else "missing"
    return row, 0


def _case_row(case, loads):
    """The row of a case, and those of its loads."""
    id, row = case["id"], dict.fromkeys(COLUMNS, "")
    rows, warnings = zip(*(_load_row(id, load) for load in loads))
    done = [r for r in rows if r["status"] == "done"]
    row.update({"id": id, "brain": pathlib.Path(case["brain"]).name, "loads": len(rows),
                "loads done": len(done)})
    mesh = _report(f"{id}/mesh.json")
    if mesh:
        arc = mesh["quality"]["after"]["all"]
        row.update({"vertices": mesh["mesh"]["vertices"], "elements": mesh["mesh"]["elements"],
                    "ARC mean": f"{arc['ARC mean']:.2f}", "ARC max": f"{arc['ARC max']:.2f}",
                    "Hausdorff mm": f"{mesh['surface']['Hausdorff distance']['distance']:.2f}",
                    "warnings": len(mesh["warnings"]) + sum(warnings)})
    else:
        row["message"] = _message(*(f"logs/{id}/{step}.log" for step in ("tumor", "region", "mesh")))
    if done:
        row["largest shift mm"] = f"{max(float(r['largest shift mm']) for r in done):.2f}"
        row["loads with inverted elements"] = sum(r["inverted elements"] > 0 for r in done)
    failed = [r for r in rows if r["status"] == "failed"]
    if failed and not row["message"]:
        more = f" (and {len(failed) - 1} more)" if len(failed) > 1 else ""
        row["message"] = f"{failed[0]['load']}: {failed[0]['message']}{more}"
    row["status"] = "done" if len(done) == len(rows) else "failed" if row["message"] else "missing"
    return row, rows


def _csv(columns, rows):
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows(rows)
    return text.getvalue()


def _markdown(columns, rows):
    cell = lambda value: str(value).replace("|", "\\|")
    lines = ["| " + " | ".join(columns) + " |", "|" + "---|" * len(columns)]
    return "\n".join(lines + ["| " + " | ".join(cell(row[c]) for c in columns) + " |" for row in rows]) + "\n"


def _bars(rows):
    """The largest shift of each load, as a picture; orange where elements are inverted."""
    done = [r for r in rows if r["status"] == "done"]
    longest = max([float(r["largest shift mm"]) for r in done] + [1e-9])
    top = [30 - 30 * float(r["largest shift mm"]) / longest for r in done]
    bars = [f'<rect x="{9 * i}" width="7" y="{top[i]:.1f}" height="30"'
            f'{" class=inverted" if r["inverted elements"] else ""}><title>{html.escape(r["load"])}: '
            f'{r["largest shift mm"]} mm</title></rect>' for i, r in enumerate(done)]
    return f'<svg width="{9 * len(done)}" height="30" overflow="hidden">{"".join(bars)}</svg>'


def _links(row):
    """The files that cells of a row lead to, relative to the page, by column."""
    if "load" in row:
        return {"load": f"{row['id']}/{row['load']}/shift.json", "displacements": row["displacements"]}
    return {"id": f"{row['id']}/mesh.vtu", "warnings": f"{row['id']}/mesh.json"}


def _cell(row, column):
    text, path = html.escape(str(row[column])), _links(row).get(column)
    if text and path and pathlib.Path(path).is_file():
        return f'<td><a href="{html.escape(path)}">{text}</a></td>'
    return f"<td>{text}</td>"


def _table(columns, rows):
    cells = lambda row: "".join(_cell(row, c) for c in columns)
    return ("<table><tr>" + "".join(f"<th>{html.escape(c)}</th>" for c in columns) + "</tr>\n"
            + "\n".join(f'<tr class="{row["status"]}">{cells(row)}</tr>' for row in rows) + "</table>")


def _page(title, told, rows, loads):
    parts = [f'<!DOCTYPE html>\n<html lang="en"><meta charset="utf-8"><title>{html.escape(title)}</title>',
             f"<style>{STYLE}</style>", f"<h1>{html.escape(title)}</h1>", f"<p>{html.escape(told)}</p>",
             _table(COLUMNS, rows), "<p>An id leads to its mesh, for ParaView, and its warnings to the report.</p>"
             "<h2>Loads</h2><p>Bars: the largest shift of each load; orange: some"
             " elements are inverted by it, as the strain is not small there.</p>"]
    for row in rows:
        mine = loads[row["id"]]
        parts.append(f"<details><summary>{html.escape(row['id'])} {_bars(mine)}</summary>"
                     f"{_table(LOAD_COLUMNS[1:], mine)}</details>")
    return "\n".join(parts) + "\n</html>\n"


def write_cohort(cases, runs, table):
    """Writes cohort.csv, cohort.md, cohort.html and loads.csv, and prints what failed."""
    rows, loads = [], {}
    for case in cases.values():
        row, loads[case["id"]] = _case_row(case, [load for id, load in runs if id == case["id"]])
        rows.append(row)
    count = lambda status: sum(row["status"] == status for row in rows)
    done = sum(row["loads done"] for row in rows)
    told = (f"{count('done')} of {len(rows)} cases done, {count('failed')} failed, {count('missing')} not "
            f"run; {done} of {len(runs)} loads done")
    write_text("cohort.csv", _csv(COLUMNS, rows))
    write_text("loads.csv", _csv(LOAD_COLUMNS, [row for case in loads.values() for row in case]))
    write_text("cohort.md", f"{told}\n\n{_markdown(COLUMNS, rows)}")
    write_text("cohort.html", _page(f"Cohort {pathlib.Path(table).name}", told, rows, loads))
    print(f"cohort: {told}: see cohort.html, cohort.csv, loads.csv")
    for row in rows:
        if row["status"] == "failed":
            print(f"cohort: failed: {row['id']}: {row['message']}")
