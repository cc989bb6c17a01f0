# SPDX-License-Identifier: GPL-3.0-or-later
"""The page of a mesh, as written by the option --page of the programs: an HTML file that loads nothing else."""

import base64
import html
import json
import math
import os
import pathlib
import re

import numpy as np

from . import _core

_FOLDER = pathlib.Path(__file__).parent
_PLACEHOLDER = re.compile(r"\{\{(.*?)\}\}")


def _packed(values, dtype):
    """Consecutive numbers, little-endian, as base64."""
    return base64.b64encode(np.ascontiguousarray(values, dtype=dtype).tobytes()).decode("ascii")


def _plain(value):
    """A report for JSON, which has neither arrays nor infinity."""
    if isinstance(value, dict):
        return {str(key): _plain(x) for key, x in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(x) for x in value]
    if isinstance(value, (np.ndarray, np.generic)):
        return _plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value if value is None or isinstance(value, (bool, int, float, str)) else str(value)


def _data(mesh, displacements, removed, report, title, version):
    points = mesh.points
    low, high = (points.min(axis=0), points.max(axis=0)) if len(points) else (np.zeros(3), np.zeros(3))
    center = (low + high) / 2
    kinds = _core.element_kinds()
    counts = {kind["plural"]: int((mesh.kinds == number).sum()) for number, kind in enumerate(kinds)}
    report = {key: value for key, value in (report or {}).items() if key != "seconds"}  # the same mesh, the same bytes
    told = {"program": {"name": "mixed_mesh_3", "version": version, "CGAL": _core.CGAL_version},
            "inputs": {"surface": {"file": title}}, "status": str(report.get("status", "")),
            "warnings": [str(text) for text in report.get("warnings", ())],
            "mesh": {"vertices": len(points), "elements": len(mesh.kinds), **counts,
                     "volume": float(_core.quality(mesh, "volume").sum())},
            "measures": _plain({key: value for key, value in report.items() if key not in ("status", "warnings")})}
    steps = []
    if displacements is not None:
        u = np.asarray(displacements, dtype=float)
        if u.shape != points.shape or not np.isfinite(u).all():
            raise ValueError(f"displacements: expected finite numbers of shape {points.shape}, not {u.shape}")
        is_removed = np.zeros(len(mesh.kinds), bool) if removed is None else np.asarray(removed, dtype=bool)
        if is_removed.shape != mesh.kinds.shape:
            raise ValueError(f"removed: expected shape {mesh.kinds.shape}, not {is_removed.shape}")
        steps = [{"name": "shifted", "displacements": _packed(u, "<f4"), "removed": _packed(is_removed, "u1")}]
    elif removed is not None:
        raise ValueError("removed: needs displacements")
    return {"command": "mesh.show()", "is in patient space": False, "report": told, "kinds": kinds, "subdomain names": sorted(mesh.names.items()),
            "center": center.tolist(), "points": _packed(points - center, "<f4"),
            "element kinds": _packed(mesh.kinds, "u1"), "element vertices": _packed(mesh.connectivity, "<u4"),
            "labels": _packed(mesh.labels, "<u4"), "in region": _packed(mesh.in_region, "u1"),
            "ARC": _packed(_core.quality(mesh, "ARC"), "<f4"), "steps": steps}


class Page:
    """A page with a mesh to turn and to cut open. In a notebook it shows itself as the result of a cell; elsewhere,
    save() writes it, and nothing is opened. `html` is its text."""

    def __init__(self, text, height):
        self.html, self.height = text, height

    def save(self, path):
        """Writes the page to a file, .html, for any browser; it needs no network."""
        pathlib.Path(os.fspath(path)).write_text(self.html, encoding="utf-8")

    def _repr_html_(self):
        return (f'<iframe srcdoc="{html.escape(self.html)}" width="100%" height="{self.height}" style="border: 0" '
                'title="Mesh in 3D"></iframe>')

    def __repr__(self):
        return f"<mixed_mesh_3.Page: {len(self.html) / 1e6:.1f} MB; a notebook shows it, save(path) writes it>"


def make_page(mesh, displacements, removed, report, title, height, version):
    data = json.dumps(_data(mesh, displacements, removed, report, title, version), ensure_ascii=False, allow_nan=False)
    data = data.replace("<", "\\u003c")  # in JSON it is in strings only: nothing ends the script element

    def part(match):
        name = match.group(1)
        return data if name == "data" else (_FOLDER / name).read_text(encoding="utf-8")
    return Page(_PLACEHOLDER.sub(part, (_FOLDER / "page.html").read_text(encoding="utf-8")), height)
