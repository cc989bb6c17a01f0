#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""The error of brain shift in the regions of openings.json, beside meshes of Mesh_3: tables and a plot.

  compare_accuracy.py DIRECTORY WORK [--regions front back] [--vertices 660 2000 10000] [--tune-mesh-3]
                      [--adapt] [--options OPTIONS] [--plot FILE.png] [--summary FILE.md] [--orders 1 2 region]
                      [--poisson-ratio 0.49]

DIRECTORY holds the programs mixed_mesh_3, benchmark_mesh_3, make_region and measure_accuracy. WORK gets

- regions/NAME.off,
- ref/NAME_{bump,smooth,springs}.txt, the references: quadratic elements on one mesh for all regions, fine in each.
  Their own error is some 0.1 to 0.25 % of the displacement for the bump, less than 0.1 % for the smooth one,
  of what finer meshes give, Mesh_3's among them; they take a quarter of an hour,
- mesh_3/NAME_VERTICES_GROWTH_SCALE.vtu, meshes of Mesh_3, and .json, their errors,
- mixed/NAME_VERTICES.vtu, our meshes.

What is there is used again, but for our meshes. Mesh_3's are made with a growth of sizes of 0.4; --tune-mesh-3
tries others, and regions of another scale. Each column has the best of the settings in WORK. Each mesh is
solved with standard elements, which lock, and with the elements of Linear_elasticity_3, whose displacement is also
recovered between vertices. --adapt adapts the meshes of both to the bump first, by adapt_mixed_mesh_3(). OPTIONS are some
of mixed_mesh_3, as --options=--no-simplification. --orders compares orders of our displacements instead, on our meshes and on
Mesh_3's, each column with the best of the settings again. WORK is for one Poisson's ratio. The summary has the mean and the worst error of all regions, before and after
adaptation, and whether they fall with N. The plot needs matplotlib (Debian: python3-matplotlib).
"""

import argparse
import itertools
import json
import pathlib
import shutil
import statistics
import subprocess

HERE = pathlib.Path(__file__).resolve().parent
DATA = HERE.parents[1] / "data"
BRAIN = DATA / "brain.off"
OPENINGS = HERE / "openings.json"
REFERENCE = ("--vertices", 50000, "--base-level", 5, "--tetrahedra")  # 382,000 quadratic nodes
DEFAULT = (0.4, 1)  # growth of Mesh_3's sizes with the distance, scale of the region
TUNING = tuple(itertools.product((0.15, 0.25, 0.4, 0.7, 1.0), (1, 1.4)))
LOADS = {"bump": "bump of 10 mm, lower 30 % fixed, rest free", "smooth": "smooth, prescribed everywhere",
         "springs": "springs at the opening and the lower 30 %, rest free"}
LARGEST_ADAPTED = 6000  # in the summary: with more vertices, all meshes would take hours
ELEMENTS = {"standard": "error of standard elements", "own": "error", "recovered": "error of recovered displacements"}
COLUMNS = tuple(itertools.product(LOADS, ELEMENTS))


def run(*command):
    return subprocess.run([*map(str, command)], check=True, stdout=subprocess.PIPE, text=True).stdout


def error(row, load, elements, where=""):
    return row[load][ELEMENTS[elements] + where]


class Comparison:
    def __init__(self, programs, work, openings, adapts=False, mesher_options=(), poisson_ratio=0.45):
        self.programs, self.work, self.mesher_options = programs, work, mesher_options
        self.poisson_ratio = poisson_ratio
        self.adapts = adapts
        self.names = [o["name"] for o in openings]
        for folder in ("regions", "ref", "mesh_3", "mixed"):
            (work / folder).mkdir(parents=True, exist_ok=True)
        for opening in openings:
            if self.region(opening["name"]).exists():
                continue
            if "region" in opening:
                shutil.copy(DATA / opening["region"], self.region(opening["name"]))
            else:
                self.make_region(self.region(opening["name"]), opening["name"])

    def region(self, name):
        return self.work / "regions" / f"{name}.off"

    def reference(self, name, load):
        return self.work / "ref" / f"{name}_{load}.txt"

    def make_region(self, file, *names):
        run(self.programs / "make_region", OPENINGS, file, *names)

    def measure(self, *arguments):
        return run(self.programs / "measure_accuracy", BRAIN, OPENINGS, self.work, "--poisson-ratio", self.poisson_ratio,
                   *arguments)

    def make_references(self):
        missing = [n for n in self.names
                   if not all(self.reference(n, load).exists() for load in LOADS)]
        if missing:
            mesh, regions = self.work / "reference.vtu", self.work / "regions" / "all.off"
            self.make_region(regions, *(o["name"] for o in json.loads(OPENINGS.read_text())))
            run(self.programs / "mixed_mesh_3", BRAIN, "--region", regions, *REFERENCE, "--quiet", "--output", mesh)
            self.measure("--reference-mesh", mesh, "--regions", *missing)

    def errors(self, name, meshes, adapts, orders=()):
        lines = self.measure(*meshes, "--regions", name, *(["--adapt"] if adapts else []),
                             *(["--orders", *orders] if orders else [])).splitlines()
        return [json.loads(line) for line in lines]

    def make_ours(self, name, vertices):
        mesh = self.work / "mixed" / f"{name}_{vertices}.vtu"
        run(self.programs / "mixed_mesh_3", BRAIN, "--region", self.region(name), "--vertices", vertices,
            *self.mesher_options, "--quiet", "--output", mesh)
        return mesh

    def ours(self, name, vertices):
        return self.errors(name, [self.make_ours(name, vertices)], self.adapts)[0]

    def meshes_3(self, name, vertices, settings):
        """The meshes of Mesh_3 of each setting in WORK, those of `settings` among them."""
        folder = self.work / "mesh_3"
        for growth, scale in settings:
            mesh = folder / f"{name}_{vertices}_{growth}_{scale}.vtu"
            if not mesh.exists():
                run(self.programs / "benchmark_mesh_3", BRAIN, self.region(name), vertices, "--growth", growth,
                    "--region-scale", scale, "--output", mesh)
        return sorted(folder.glob(f"{name}_{vertices}_*.vtu"))

    def mesh_3(self, name, vertices, settings):
        meshes = self.meshes_3(name, vertices, settings)
        ending = ".adapted.json" if self.adapts else ".json"
        made = max(self.programs.joinpath("measure_accuracy").stat().st_mtime,
                   *(self.reference(name, load).stat().st_mtime for load in LOADS))
        outdated = [m for m in meshes if not m.with_suffix(ending).exists()
                    or m.with_suffix(ending).stat().st_mtime < made]
        if outdated:
            for mesh, errors in zip(outdated, self.errors(name, outdated, self.adapts)):
                mesh.with_suffix(ending).write_text(json.dumps(errors) + "\n")
        rows = []
        for mesh in meshes:
            rows.append(json.loads(mesh.with_suffix(ending).read_text()))
            rows[-1]["setting"] = ", ".join(mesh.stem.split("_")[2:])
        return rows


def best(rows, load, elements):
    return min(rows, key=lambda row: error(row, load, elements))


def print_errors(results, vertices, names):
    """Cells: our error, Mesh_3's, their ratio, and Mesh_3's growth and scale."""
    print(f"\n{vertices:,} vertices: error in the region, %: ours : Mesh_3 = ratio (Mesh_3's growth, scale)\n")
    print("| region |" + "".join(f" {load}, {elements} elements |" for load, elements in COLUMNS))
    print("|---|" + "--:|" * len(COLUMNS))
    pairs = {column: [] for column in COLUMNS}

    def cell(a, b):
        return f" {100 * a:.2f} : {100 * b:.2f} = {a / b:.2f}"

    for name in names:
        ours, theirs = results[name, vertices]
        line = f"| {name} |"
        for column in COLUMNS:
            row = best(theirs, *column)
            pairs[column].append((error(ours, *column), error(row, *column)))
            line += f"{cell(*pairs[column][-1])} ({row['setting']}) |"
        print(line)
    for title, summary in (("mean", statistics.mean), ("worst", max)):
        print(f"| **{title}** |" + "".join(f"{cell(*map(summary, zip(*pairs[c])))} |" for c in COLUMNS))
    ratios = {c: [a / b for a, b in pairs[c]] for c in COLUMNS}
    print("| ratio: mean, worst |"
          + "".join(f" {statistics.mean(r):.2f}, {max(r):.2f} |" for r in ratios.values()))


def print_meshes(results, vertices, names):
    """Of Mesh_3's meshes the one that is best for the bump with standard elements."""
    print(f"\n{vertices:,} vertices: the meshes, and errors in the tumor, %\n")
    print("| region | mesher | vertices | elements | in region | in loaded patch |"
          + "".join(f" {load}, {elements} |" for load, elements in COLUMNS))
    print("|---|---|" + "--:|" * (4 + len(COLUMNS)))
    for name in names:
        ours, theirs = results[name, vertices]
        for mesher, r in (("ours", ours), ("Mesh_3", best(theirs, "bump", "standard"))):
            print(f"| {name} | {mesher} | {r['vertices']:,} | {r['elements']:,} "
                  f"| {r['share of vertices in region']:.0%} | {r['boundary vertices in patch']} |"
                  + "".join(f" {100 * error(r, *c, ' in tumor'):.2f} |" for c in COLUMNS))


def summary(comparison, counts, settings):
    """Lines of Markdown: errors of all regions, before and after adaptation, and how much they rise with N at most."""
    lines = ["| N | | mesher |" + "".join(f" {load}, {elements} |" for load, elements in COLUMNS),
             "|--:|---|---|" + "--:|" * len(COLUMNS)]
    means = {}
    for n in counts:
        for adapts in (False, True)[:1 + (n <= LARGEST_ADAPTED)]:
            comparison.adapts = adapts
            rows = {"ours": [comparison.ours(name, n) for name in comparison.names],
                    "Mesh_3": [comparison.mesh_3(name, n, settings) for name in comparison.names]}
            for mesher, of_mesher in rows.items():
                cells = ""
                for column in COLUMNS:
                    errors = [error(best(row, *column) if isinstance(row, list) else row, *column) for row in of_mesher]
                    means.setdefault((mesher, adapts, column), []).append(statistics.mean(errors))
                    cells += f" {100 * statistics.mean(errors):.2f} ({100 * max(errors):.2f}) |"
                lines.append(f"| {n:,} | {'adapted' if adapts else ''} | {mesher} |{cells}")
    lines += ["", "Largest rise of the mean error from one N to the next:", ""]
    for mesher in ("ours", "Mesh_3"):
        for adapts in (False, True):
            rises = [f"{load}, {elements} {max(b / a - 1 for a, b in zip(e, e[1:])):+.0%}"
                     for (load, elements), e in ((c, means[mesher, adapts, c]) for c in COLUMNS) if len(e) > 1]
            lines.append(f"- {mesher}{', adapted' if adapts else ''}: {'; '.join(rises)}")
    return lines


def print_orders(comparison, counts, orders, settings):
    """Means over the regions and, in brackets, the worst. Times are those for the bump."""
    columns = "".join(f" {load}, % |" for load in LOADS)
    print(f"| N | mesher | order | nodes |{columns} factor, CPU s | a solution, CPU ms |")
    print("|--:|---|--:|--:|" + "--:|" * (len(LOADS) + 2))

    def cell(values, form):
        return f" {format(statistics.mean(values), form)} ({format(max(values), form)}) |"

    for n in counts:
        meshers = {"ours": [comparison.errors(name, [comparison.make_ours(name, n)], comparison.adapts, orders)
                            for name in comparison.names],
                   "Mesh_3": [comparison.errors(name, comparison.meshes_3(name, n, settings), comparison.adapts, orders)
                              for name in comparison.names]}
        for order, mesher in itertools.product(orders, meshers):
            best_rows = {load: [min((row[load]["orders"][order] for row in rows), key=lambda r: r["error"])
                                for rows in meshers[mesher]] for load in LOADS}
            times = best_rows["bump"]
            print(f"| {n:,} | {mesher} | {order} |" + cell([r["nodes"] for r in times], ",.0f")
                  + "".join(cell([100 * r["error"] for r in best_rows[load]], ".2f") for load in LOADS)
                  + cell([r["factor, CPU seconds"] for r in times], ".2f")
                  + cell([1000 * r["solution, CPU seconds"] for r in times], ".1f"), flush=True)


def plot(results, counts, names, file, is_tuned):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt

    figure, axes = plt.subplots(1, len(LOADS), figsize=(5.5 * len(LOADS), 4.6), sharey=True)
    for ax, (load, title) in zip(axes, LOADS.items()):
        for elements, line in (("own", "-"), ("standard", ":")):
            column = (load, elements)
            ours = [[error(results[name, n][0], *column) for name in names] for n in counts]
            theirs = [[error(best(results[name, n][1], *column), *column) for name in names] for n in counts]
            for mesher, errors, marker, color in (("Mixed_mesh_3", ours, "o", "#1f6fb4"),
                                                  ("Mesh_3, tuned" if is_tuned else "Mesh_3", theirs, "s", "#c8442c")):
                ax.loglog(counts, [100 * statistics.mean(e) for e in errors], marker + line, color=color,
                          label=f"{mesher}, {elements} elements")
        ax.set_title(title)
        ax.set_xlabel("vertices")
        ax.grid(True, which="both", alpha=0.3)
    axes[0].set_ylabel(f"RMS error, % of RMS displacement: mean of {len(names)} regions")
    axes[0].legend()
    figure.tight_layout()
    figure.savefig(file, dpi=130)


def main():
    openings = json.loads(OPENINGS.read_text())
    names = [o["name"] for o in openings]
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("directory", type=pathlib.Path)
    parser.add_argument("work", type=pathlib.Path)
    parser.add_argument("--regions", nargs="+", choices=names, default=names)
    parser.add_argument("--vertices", type=int, nargs="+", default=[660, 2000, 10000])
    parser.add_argument("--tune-mesh-3", action="store_true")
    parser.add_argument("--adapt", action="store_true")
    parser.add_argument("--options", type=str.split, default=[])
    parser.add_argument("--poisson-ratio", type=float, default=0.45)
    parser.add_argument("--orders", nargs="+", choices=["1", "2", "region"])
    parser.add_argument("--plot", type=pathlib.Path)
    parser.add_argument("--summary", type=pathlib.Path)
    arguments = parser.parse_args()
    comparison = Comparison(arguments.directory, arguments.work,
                            [o for o in openings if o["name"] in arguments.regions], arguments.adapt, arguments.options,
                            arguments.poisson_ratio)
    comparison.make_references()
    settings = TUNING if arguments.tune_mesh_3 else (DEFAULT,)
    if arguments.orders:
        print_orders(comparison, arguments.vertices, arguments.orders, settings)
        return
    if arguments.summary:
        arguments.summary.write_text("\n".join(summary(comparison, arguments.vertices, settings)) + "\n")
        return
    results = {}
    for n in arguments.vertices:
        for name in comparison.names:
            results[name, n] = comparison.ours(name, n), comparison.mesh_3(name, n, settings)
        print_errors(results, n, comparison.names)
        print_meshes(results, n, comparison.names)
    if arguments.plot:
        plot(results, arguments.vertices, comparison.names, arguments.plot, arguments.tune_mesh_3)


if __name__ == "__main__":
    main()
