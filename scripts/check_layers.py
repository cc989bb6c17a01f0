#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Checks that the arrows between the folders of include/CGAL run one way (see CONTRIBUTING.md).

A header reaches another if it includes it, or includes one that does: a public header between two stages does
not hide an arrow. Public headers are in groups with arrows of their own. Exits with status 1 and a line for each violation.

  scripts/check_layers.py [ROOT]
"""

import pathlib
import re
import sys

# What each folder may reach, besides itself and the vocabulary. Stages of Mixed_mesh_3, lowest first.
STAGES = "Mixed_mesh_3/internal/"
VOCABULARY, MEASURES, MODELS, SERVICES, ENTRY = "vocabulary", "measures", "models", "services", "entry functions"
MAY_REACH = {
    "base": "",
    "elements": "base measures",
    "oracle": "base",
    "surface": "base elements measures",
    "octree": "base oracle",
    "transitions": "base octree",
    "boundary": "base elements octree transitions",
    "fem": "base elements",
    "moves": "base oracle elements surface measures",
    "fitting": "base oracle elements surface moves fem measures",
    "meshing": "base oracle elements surface octree transitions boundary moves fitting measures models services",
    "resection": "elements",
    "repair": "base",
    "IO": "base elements repair measures",
    "Linear_elasticity_3": "base elements fem measures",
    "Mixed_mesh_image_3": "base elements surface IO measures",
    "Mixed_mesh_petsc": "",
    # The public headers of Mixed_mesh_3. The vocabulary is what all speak of: the mesh, its elements, criteria, results.
    VOCABULARY: "base",
    MEASURES: "base elements",
    MODELS: "base oracle surface",
    SERVICES: "base elements surface octree transitions resection measures models",
    ENTRY: "base elements oracle surface octree moves fitting meshing measures models",
}
# The folders beside Mixed_mesh_3.
OTHERS = ("Linear_elasticity_3", "Mixed_mesh_image_3", "Mixed_mesh_petsc")
# The public headers, but for those of the vocabulary, without their endings.
PUBLIC = {
    MEASURES: """Aspect_ratio_quality_3 Element_locator_3 Recovered_displacement_3 Scaled_jacobian_quality_3 boundary_faces
        boundary_to_face_graph cells_in_complex_3_to_mixed_mesh certificate draw_mixed_mesh_3 interfaces
        linear_cell_complex mesh_defects quality quality_bound sheets split_along_faces split_to_tetrahedra""",
    MODELS: """Implicit_mixed_mesh_domain_3 Labeled_polyhedral_mixed_mesh_domain_3 Mixed_mesh_regions_3 Mixed_mesh_sheet_3
        Polyhedral_mixed_mesh_domain_3 Polyhedral_mixed_mesh_region_3""",
    SERVICES: "certify_mesh extract_subdomains fidelity resect surface_distance validation",
    ENTRY: "fit_mixed_mesh_to_surface make_mixed_mesh_3 optimize_mixed_mesh_3 simplify_mixed_mesh_3",
}
GROUPS = {name: group for group, names in PUBLIC.items() for name in names.split()}

INCLUDE = re.compile(r"^\s*#\s*include\s*[<\"]([^>\"]+)[>\"]", re.MULTILINE)

# (files, what they must not say, files that may, why)
WORDS = [
    ("include/**/*.h", r"(?i)nifti|\bznz", r"include/CGAL/Mixed_mesh_image_3/",
     "images are a package of their own"),
    ("include/**/*.h", r"<zlib\.h>", r"include/CGAL/Mixed_mesh_image_3/|.*/(Compressed_blocks|XML_input)\.h",
     "only files of VTK, GIFTI and images are compressed"),
    ("include/**/*.h", "CGAL_VERSION_NR", r".*/internal/base/compatibility\.h",
     "differences of CGAL's versions stand in one header"),
    ("include/**/*.h", r"std::c(out|err)\b", "$", "the library does not print"),
    ("examples/**/*.cpp", r"\binternal(::|/)", "$", "a tutorial uses what is documented"),
]


def folder_of(header):
    """The folder or the group, as named in MAY_REACH, of a header given relative to include/CGAL."""
    if header.startswith(STAGES):
        return header[len(STAGES):].split("/")[0]
    if header.startswith("Mixed_mesh_3/IO/"):
        return "IO"
    for package in OTHERS:
        if header == package + ".h" or header.startswith(package + "/"):
            return package
    return GROUPS.get(pathlib.PurePath(header).stem, VOCABULARY)


def may_reach(folder):
    """The folders and groups of headers that one may reach. The names of two groups have two words."""
    text = MAY_REACH.get(folder, "")
    return {name for name in MAY_REACH if re.search(rf"\b{name}\b", text)}


def own_includes(path):
    """The headers below include/CGAL that a file includes, relative to it, whether they are there or not."""
    return [name[len("CGAL/"):] for name in INCLUDE.findall(path.read_text()) if name.startswith("CGAL/")]


def find_cycle(includes):
    """A list of headers that include each other in a circle, or None."""
    done = set()

    def visit(header, path):
        if header in path:
            return path[path.index(header):] + [header]
        if header not in done:
            for other in includes[header]:
                cycle = visit(other, path + [header])
                if cycle:
                    return cycle
            done.add(header)
        return None

    for header in includes:
        cycle = visit(header, [])
        if cycle:
            return cycle
    return None


def chains_from(header, includes):
    """For each header that this one reaches, the shortest chain of headers to it."""
    chains = {header: [header]}
    queue = [header]
    for one in queue:
        for other in includes.get(one, ()):
            if other not in chains:
                chains[other] = chains[one] + [other]
                queue.append(other)
    return chains


def read_includes(root):
    """For each header below include/CGAL, those of them that it includes."""
    top = root / "include" / "CGAL"
    includes = {}
    for header in sorted(str(path.relative_to(top)) for path in top.rglob("*.h")):
        includes[header] = [name for name in own_includes(top / header) if (top / name).exists()]
    # A header and that of its definitions, which may be compiled apart, include each other.
    for header, others in includes.items():
        if header.endswith("_impl.h"):
            includes[header] = [name for name in others if header not in includes[name]]
    return includes


def find_violations(root):
    includes = read_includes(root)
    violations = [f"include/CGAL/{header}: folder {folder_of(header)} is not in scripts/check_layers.py"
                  for header in includes if folder_of(header) not in MAY_REACH]

    cycle = find_cycle(includes)
    if cycle:
        return violations + ["headers include each other: " + " -> ".join(cycle)]

    for header in includes:
        folder = folder_of(header)
        allowed = {folder, VOCABULARY, *may_reach(folder)}
        for other, chain in chains_from(header, includes).items():
            # Of a chain, its last arrow is the one to mend if all that goes before is public.
            between = {folder_of(name) for name in chain[1:-1]}
            if folder_of(other) not in allowed and between <= {VOCABULARY, *PUBLIC}:
                violations.append(f"{folder} must not reach {folder_of(other)}: " + " -> ".join(chain))

    for files, word, exempt, why in WORDS:
        for path in sorted(root.glob(files)):
            name = path.relative_to(root).as_posix()
            if re.match(exempt, name):
                continue
            for number, line in enumerate(path.read_text().splitlines(), 1):
                if re.search(word, line):
                    violations.append(f"{name}:{number}: {why}: {line.strip()}")
    return violations


def report(find_violations_in):
    """Prints the violations in ROOT, the argument of the script, or in the project. Returns the exit status."""
    root = pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else pathlib.Path(__file__).parent.parent)
    violations = find_violations_in(root)
    print(*violations, sep="\n", end="\n" if violations else "")
    return 1 if violations else 0


if __name__ == "__main__":
    sys.exit(report(find_violations))
