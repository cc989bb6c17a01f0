#!/usr/bin/python3
# Copyright (c) 2026 The Mixed_mesh_3 authors.
#
# This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
#
# SPDX-License-Identifier: GPL-3.0-or-later

"""Generates include/CGAL/Mixed_mesh_3/internal/transitions/transition_tables.h.

Usage:  generate_transition_tables.py [--solver cbc|glpsol] [--jobs N] [--output FILE]

Needs the standard library of python3 and one solver of 0/1 programs as an executable: cbc (Debian
package coinor-cbc; the committed table comes from it) or glpsol (glpk-utils).

The problem.  A cell of a 2:1-balanced octree is the lattice {0,1,2}^3.  Its 8 corners are vertices;
each of its 12 edge midpoints may be one (4096 patterns); a face with four split edges also has its
center as a vertex.  The split of a face is fixed and depends on its four bits only, see
face_pieces().  A template fills the cell with tetrahedra, pyramids, prisms and hexahedra that meet
face to face and show exactly those pieces on the cell's boundary.

The method, for one representative of each of the 144 classes of patterns modulo the 48 symmetries:

1. Candidates.  All strictly convex elements with planar faces on the available points, in integer
   arithmetic.  They are enumerated once for all 27 points and filtered for each pattern: what an
   element shows on the boundary must be a piece, and its edges there must be edges of pieces.
   Strictly convex: a face's plane has all other vertices strictly on one side, so that no two
   faces are coplanar, and coning from any vertex gives positive tetrahedra.
2. Program.  One 0/1 variable for each candidate.  Each piece of the boundary is a face of exactly
   one element; each interior face has equally many elements on both sides.  (An interior
   quadrilateral thus only meets the same quadrilateral.)
   Such a solution is a tiling: the sum of the indicator functions of its elements has a gradient
   supported on their faces, where it cancels but for the cube's boundary; so the sum is 1 almost
   everywhere in the cube.  verify() nevertheless checks the outcome exactly.
3. Goals, in this order: the smallest bound >= 2.0 on the aspect-ratio coefficient (ARC); fewest
   elements; smallest sum of ARC (rounded to 0.001, and only to choose among equals).
4. If there is no solution, the cell center becomes available as a vertex, and the same program is
   solved again.

Determinism: candidates are sorted, the solver runs with one thread, and of the images of the
solution under the symmetries of its pattern the smallest one is kept.  Another solver, or version,
may return another solution of the same worst ARC, count and sum of ARC.
"""

import argparse
import concurrent.futures
import itertools
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
OUTPUT = os.path.join(ROOT, "include/CGAL/Mixed_mesh_3/internal/transitions/transition_tables.h")

ARC_GOAL = 2.0     # a bound below this is not worth more elements
CENTER = 13        # lattice index of the cell center

KIND_NAMES = ("tetrahedron", "pyramid", "prism", "hexahedron")
KIND_PLURALS = ("tetrahedra", "pyramids", "prisms", "hexahedra")
KIND_OF_SIZE = {4: 0, 5: 1, 6: 2, 8: 3}

# Faces of the kinds, vertices counter-clockwise seen from outside (Gmsh/FE vertex order).
FACES = (
    ((0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)),
    ((0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)),
    ((0, 2, 1), (3, 4, 5), (0, 1, 4, 3), (1, 2, 5, 4), (2, 0, 3, 5)),
    ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)),
)
EDGES = tuple(tuple(sorted({tuple(sorted((f[i], f[i - 1]))) for f in faces for i in range(len(f))}))
              for faces in FACES)


# ------------------------------------------------------------------------------------------------
# The lattice.  Point i = x + 3 y + 9 z.

POINTS = tuple((i % 3, i // 3 % 3, i // 9) for i in range(27))


def index(p):
    return p[0] + 3 * p[1] + 9 * p[2]


def sub(p, q):
    return (p[0] - q[0], p[1] - q[1], p[2] - q[2])


def dot(p, q):
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


def cross(p, q):
    return (p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2], p[0] * q[1] - p[1] * q[0])


def orientation(a, b, c, d):
    """det(b-a, c-a, d-a) for four lattice indices: six times the tetrahedron's signed volume."""
    p = POINTS[a]
    return dot(cross(sub(POINTS[b], p), sub(POINTS[c], p)), sub(POINTS[d], p))


def bitset(vertices):
    result = 0
    for v in vertices:
        result |= 1 << v
    return result


def six_volume(element):
    """Six times the volume of an element with planar faces, from its oriented faces."""
    total = 0
    for face in element_faces(element):
        for i in range(1, len(face) - 1):
            a, b, c = (POINTS[v] for v in (face[0], face[i], face[i + 1]))
            total += dot(cross(a, b), c)
    return total


def element_faces(element):
    return [tuple(element[i] for i in face) for face in FACES[KIND_OF_SIZE[len(element)]]]


# ------------------------------------------------------------------------------------------------
# Patterns, faces and their splits.

def edge_midpoint(bit):
    """Lattice index of the midpoint of edge `bit`: 0..3 parallel to x, 4..7 to y, 8..11 to z."""
    axis, low, high = bit // 4, 2 * (bit & 1), 2 * (bit >> 1 & 1)
    p = [low, high]
    p.insert(axis, 1)
    return index(p)


MIDPOINTS = tuple(edge_midpoint(bit) for bit in range(12))
BIT_OF_MIDPOINT = {m: bit for bit, m in enumerate(MIDPOINTS)}
CORNERS = tuple(i for i, p in enumerate(POINTS) if all(x != 1 for x in p))


def face_cycle(face):
    """The 8 boundary points of face 0..5 (x-, x+, y-, ...), counter-clockwise from outside,
    beginning at a corner, and its center."""
    axis, side = face // 2, face % 2
    u, v = ((axis + 1) % 3, (axis + 2) % 3) if side else ((axis + 2) % 3, (axis + 1) % 3)
    cycle = []
    for a, b in ((0, 0), (1, 0), (2, 0), (2, 1), (2, 2), (1, 2), (0, 2), (0, 1), (1, 1)):
        p = [0, 0, 0]
        p[axis], p[u], p[v] = 2 * side, a, b
        cycle.append(index(p))
    return tuple(cycle[:8]), cycle[8]


FACE_CYCLES = tuple(face_cycle(face) for face in range(6))

# Pieces of a face for its split sides, up to rotation.  Side i joins corners 2i and 2i+2; its
# midpoint is 2i+1; 8 is the center.
FACE_SPLITS = {
    (0, 0, 0, 0): ((0, 2, 4, 6),),
    (1, 0, 0, 0): ((0, 1, 6), (1, 2, 4), (1, 4, 6)),
    (1, 0, 1, 0): ((0, 1, 5, 6), (1, 2, 4, 5)),
    (1, 0, 0, 1): ((0, 1, 7), (1, 4, 7), (1, 2, 4), (4, 6, 7)),
    (1, 1, 0, 1): ((7, 3, 4, 6), (0, 1, 7), (1, 2, 3), (1, 3, 7)),
    (1, 1, 1, 1): ((0, 1, 8, 7), (1, 2, 3, 8), (8, 3, 4, 5), (7, 8, 5, 6)),
}


def face_pieces(mask, face):
    """The pieces of a face in pattern `mask`, counter-clockwise seen from outside."""
    cycle, center = FACE_CYCLES[face]
    split = [mask >> BIT_OF_MIDPOINT[cycle[2 * i + 1]] & 1 for i in range(4)]
    for r in range(4):
        pieces = FACE_SPLITS.get(tuple(split[r:] + split[:r]))
        if pieces is not None:
            return [tuple(center if i == 8 else cycle[(i + 2 * r) % 8] for i in piece)
                    for piece in pieces]
    raise AssertionError("every pattern of a face is a rotation of one of the six")


def boundary_pieces(mask):
    return [piece for face in range(6) for piece in face_pieces(mask, face)]


def boundary_vertices(mask):
    return {v for piece in boundary_pieces(mask) for v in piece}


def on_one_cube_face(vertices):
    return any(all(POINTS[v][axis] == side for v in vertices)
               for axis in range(3) for side in (0, 2))


# The 48 symmetries as permutations of the 27 points, the identity first.
SYMMETRIES = tuple(
    tuple(index(tuple(2 - p[a] if f else p[a] for a, f in zip(axes, flips))) for p in POINTS)
    for axes in itertools.permutations(range(3))
    for flips in itertools.product((0, 1), repeat=3))


def image_of_mask(mask, symmetry):
    return bitset(BIT_OF_MIDPOINT[symmetry[m]] for b, m in enumerate(MIDPOINTS) if mask >> b & 1)


def representatives():
    return [mask for mask in range(4096)
            if all(image_of_mask(mask, s) >= mask for s in SYMMETRIES)]


# ------------------------------------------------------------------------------------------------
# Vertex order.  Each kind's rotations are generated once, by search, from its faces.

def rotations(kind):
    """All vertex permutations that keep the oriented faces of a kind."""
    def cyclic(face):
        i = face.index(min(face))
        return face[i:] + face[:i]
    faces = {cyclic(face) for face in FACES[kind]}
    n = max(map(max, FACES[kind])) + 1
    return [p for p in itertools.permutations(range(n))
            if {cyclic(tuple(p[i] for i in face)) for face in faces} == faces]


ROTATIONS = tuple(rotations(kind) for kind in range(4))
REFLECTIONS = ((0, 2, 1, 3), (0, 3, 2, 1, 4), (0, 2, 1, 3, 5, 4), (0, 3, 2, 1, 4, 7, 6, 5))


def canonical(element):
    """The smallest positively oriented vertex order of an element."""
    kind = KIND_OF_SIZE[len(element)]
    if six_volume(element) < 0:
        element = tuple(element[i] for i in REFLECTIONS[kind])
    return min(tuple(element[i] for i in r) for r in ROTATIONS[kind])


# ------------------------------------------------------------------------------------------------
# Aspect-ratio coefficient, DESIGN.md section 1.

def mean(*vertices):
    return tuple(sum(POINTS[v][k] for v in vertices) / len(vertices) for k in range(3))


def length(p):
    return dot(p, p) ** 0.5


def aspect_ratio(element):
    e = element
    if len(e) == 4:
        squares = sum(dot(d, d) for d in (sub(POINTS[a], POINTS[b])
                                          for a, b in itertools.combinations(e, 2)))
        value = (squares / 6) ** 1.5 / (8.47867 * (six_volume(e) / 6))
    elif len(e) == 5:
        normal = cross(sub(POINTS[e[1]], POINTS[e[0]]), sub(POINTS[e[3]], POINTS[e[0]]))
        lengths = (length(sub(mean(e[0], e[1]), mean(e[2], e[3]))),
                   length(sub(mean(e[1], e[2]), mean(e[3], e[0]))),
                   abs(dot(normal, sub(POINTS[e[4]], POINTS[e[0]]))) / length(normal))
        value = max(lengths) / min(lengths)
    elif len(e) == 6:
        value = 0
        for i in range(3):
            a, b, c = i, (i + 1) % 3, (i + 2) % 3
            pa, pb, pc = (mean(e[k], e[k + 3]) for k in (a, b, c))
            width = length(sub(pb, pa))
            lengths = (width,
                       length(sub(mean(e[a], e[b]), mean(e[a + 3], e[b + 3]))),
                       length(cross(sub(pb, pa), sub(pc, pa))) / width)
            value = max(value, max(lengths) / min(lengths))
    else:
        lengths = (length(sub(mean(e[0], e[1], e[2], e[3]), mean(e[4], e[5], e[6], e[7]))),
                   length(sub(mean(e[0], e[1], e[5], e[4]), mean(e[3], e[2], e[6], e[7]))),
                   length(sub(mean(e[0], e[3], e[7], e[4]), mean(e[1], e[2], e[6], e[5]))))
        value = max(lengths) / min(lengths)
    return round(value, 9)   # symmetric images must compare equal


# ------------------------------------------------------------------------------------------------
# Candidates.

def convex_quadrilaterals():
    """All strictly convex planar quadrilaterals on the lattice, in cyclic order, once each."""
    result = []
    for a, b, c, d in itertools.combinations(range(27), 4):
        if orientation(a, b, c, d) != 0:
            continue
        for q in ((a, b, c, d), (a, b, d, c), (a, c, b, d)):
            sides = [sub(POINTS[q[i]], POINTS[q[i - 1]]) for i in range(4)]
            turns = [cross(sides[i - 1], sides[i]) for i in range(4)]
            if all(dot(turns[0], t) > 0 for t in turns):
                result.append(q)
    return result


def is_strictly_convex(element):
    """All faces planar, all other vertices strictly on the inner side of each (positive order)."""
    for face in element_faces(element):
        for v in element:
            o = orientation(face[0], face[1], face[2], v)
            if o != 0 if v in face else o >= 0:
                return False
    return True


def all_candidates():
    """All candidate elements on the 27 points, in canonical order and sorted."""
    possible = {frozenset(p) for mask in range(4096) for p in boundary_pieces(mask)}

    def is_possible_face(vertices):
        return frozenset(vertices) in possible or not on_one_cube_face(vertices)

    quads = [q for q in convex_quadrilaterals() if is_possible_face(q)]
    found = set()

    def add(element):
        element = canonical(element)
        if element not in found and is_strictly_convex(element) \
                and all(is_possible_face(f) for f in element_faces(element)):
            found.add(element)

    for t in itertools.combinations(range(27), 4):
        if orientation(*t) != 0:
            add(t)
    for q in quads:
        for apex in range(27):
            if orientation(q[0], q[1], q[2], apex) != 0:
                add(q + (apex,))

    # fourth[a, b, c]: the vertices d such that a b c d is a quadrilateral in this cyclic order.
    # on_edge[a, b]: the pairs (c, d) with the quadrilateral a b c d.
    fourth, on_edge = {}, {}
    for q in quads:
        for cycle in (q, q[::-1]):
            for i in range(4):
                a, b, c, d = cycle[i:] + cycle[:i]
                fourth.setdefault((a, b, c), []).append(d)
                on_edge.setdefault((a, b), []).append((c, d))
    for (a, b), pairs in sorted(on_edge.items()):
        for (c, d), (e, f) in itertools.combinations(pairs, 2):
            # Quadrilaterals a b c d and a b e f.  As sides of a prism: a b is one of its three
            # vertical edges, the third side is d c e f.
            if a < b and e in fourth.get((f, d, c), ()) and orientation(a, b, c, e) != 0:
                add((a, d, f, b, c, e))
            # As bottom and front of a hexahedron 0 1 2 3 4 5 6 7 = a b c d f e g h, whose smallest
            # vertex is a.
            if a == min(a, b, c, d, e, f) and orientation(a, b, c, e) != 0:
                for h in fourth.get((d, a, f), ()):
                    for g in fourth.get((c, b, e), ()):
                        if h > a and g > a and len({a, b, c, d, e, f, g, h}) == 8 \
                                and g in fourth.get((h, d, c), ()) \
                                and g in fourth.get((h, f, e), ()):
                            add((a, b, c, d, f, e, g, h))
    return sorted(found, key=lambda e: (len(e), e))


class Candidates:
    """All candidates with what the programs need of them."""

    def __init__(self):
        self.elements = all_candidates()
        self.vertices = [bitset(e) for e in self.elements]
        self.arcs = [aspect_ratio(e) for e in self.elements]
        self.sides = []             # of each element: (face as bitset, side of the face: +1 or -1)
        self.boundary_faces = []    # of each element: its faces on the cube's boundary
        self.boundary_edges = []    # of each element: its edges on the cube's boundary
        for e in self.elements:
            sides, boundary = [], []
            for face in element_faces(e):
                a, b, c = sorted(face)[:3]
                apex = next(v for v in e if v not in face)
                sides.append((bitset(face), 1 if orientation(a, b, c, apex) > 0 else -1))
                if on_one_cube_face(face):
                    boundary.append(bitset(face))
            self.sides.append(sides)
            self.boundary_faces.append(boundary)
            edges = [(e[i], e[j]) for i, j in EDGES[KIND_OF_SIZE[len(e)]]]
            self.boundary_edges.append([bitset(edge) for edge in edges if on_one_cube_face(edge)])

    def of_pattern(self, mask, with_center, arc_limit):
        """Indices of the candidates that a solution for this pattern can contain."""
        available = bitset(boundary_vertices(mask)) | (1 << CENTER if with_center else 0)
        pieces = boundary_pieces(mask)
        faces = {bitset(p) for p in pieces}
        edges = {bitset((p[i], p[i - 1])) for p in pieces for i in range(len(p))}
        chosen = [i for i, v in enumerate(self.vertices)
                  if v & ~available == 0 and self.arcs[i] <= arc_limit
                  and all(f in faces for f in self.boundary_faces[i])
                  and all(e in edges for e in self.boundary_edges[i])]
        # Drop elements that have nobody to meet on an interior face, until there is none.
        while True:
            present = {side for i in chosen for side in self.sides[i]}
            kept = [i for i in chosen
                    if all(f in faces or (f, -s) in present for f, s in self.sides[i])]
            if len(kept) == len(chosen):
                return chosen, faces
            chosen = kept


# ------------------------------------------------------------------------------------------------
# The 0/1 program, written as a free MPS file.

def write_mps(path, columns, right_hand_sides):
    """columns: list of (cost, {row: coefficient}); all rows are equations, all columns 0/1."""
    with open(path, "w") as out:
        out.write("NAME transition FREE\nROWS\n N cost\n")
        for r in range(len(right_hand_sides)):
            out.write(f" E r{r}\n")
        out.write("COLUMNS\n M1 'MARKER' 'INTORG'\n")
        for c, (cost, rows) in enumerate(columns):
            out.write(f" x{c} cost {cost}\n")
            for r, value in sorted(rows.items()):
                out.write(f" x{c} r{r} {value}\n")
        out.write(" M2 'MARKER' 'INTEND'\nRHS\n")
        for r, value in enumerate(right_hand_sides):
            if value:
                out.write(f" rhs r{r} {value}\n")
        out.write("BOUNDS\n")
        for c in range(len(columns)):
            out.write(f" BV bnd x{c}\n")
        out.write("ENDATA\n")


def run_solver(solver, columns, right_hand_sides):
    """The columns chosen by an optimal solution, or None if the program is infeasible."""
    with tempfile.TemporaryDirectory() as folder:
        mps, solution = os.path.join(folder, "p.mps"), os.path.join(folder, "p.sol")
        write_mps(mps, columns, right_hand_sides)
        if solver == "cbc":
            command = [solver, mps, "threads", "0", "ratioGap", "0", "allowableGap", "0",
                       "solve", "solution", solution]
        else:
            command = [solver, "--freemps", mps, "--cuts", "-w", solution]
        log = subprocess.run(command, capture_output=True, text=True, check=True).stdout
        lines = []
        if os.path.exists(solution):
            with open(solution) as file:
                lines = [line.split() for line in file]
    if solver == "cbc":
        status = lines[0][0] if lines else "none"
        if status in ("Infeasible", "Integer"):         # "Integer infeasible"
            return None
        if status == "Optimal":
            return [int(l[1][1:]) for l in lines[1:] if l[0] != "**" and float(l[2]) > 0.5]
    else:
        status = next((l[4] for l in lines if l[:2] == ["s", "mip"]), "none")
        if status == "n" or (status == "u" and "NO PRIMAL FEASIBLE" in log) \
                or "NO INTEGER FEASIBLE" in log or "NO PRIMAL FEASIBLE" in log:
            return None
        if status == "o":
            return [int(l[1]) - 1 for l in lines if l[0] == "j" and float(l[2]) > 0.5]
    raise RuntimeError(f"{solver}: no verdict\n{log}")


def solve_program(candidates, solver, mask, with_center, arc_limit):
    """The best template with all ARC <= arc_limit, as a list of candidates, or None."""
    chosen, boundary = candidates.of_pattern(mask, with_center, arc_limit)
    rows, right_hand_sides, columns = {}, [], []
    for face in sorted(boundary):
        rows[face] = len(rows)
        right_hand_sides.append(1)
    for i in chosen:
        # 100000 an element: 1000 times the sum of (ARC - 1) stays below this, so that fewest
        # elements come first.
        column = {}
        for face, side in candidates.sides[i]:
            if face in boundary:
                side = 1
            elif face not in rows:
                rows[face] = len(rows)
                right_hand_sides.append(0)
            column[rows[face]] = side
        columns.append((100000 + round(1000 * (candidates.arcs[i] - 1)), column))
    if {r for _, column in columns for r in column} != set(range(len(rows))):
        return None                                      # a piece that no candidate has
    result = run_solver(solver, columns, right_hand_sides)
    if result is None:
        return None
    result = [chosen[c] for c in result]
    if sum(round(1000 * (candidates.arcs[i] - 1)) for i in result) >= 100000:
        raise RuntimeError("the weights do not separate the goals")
    return result


def solve_pattern(candidates, solver, mask, with_center):
    """The template of smallest ARC bound (but not below ARC_GOAL), then fewest elements."""
    best = solve_program(candidates, solver, mask, with_center, ARC_GOAL)
    if best is not None:
        return best
    best = solve_program(candidates, solver, mask, with_center, float("inf"))
    if best is None:
        return None
    limits = sorted({arc for arc in candidates.arcs if arc > ARC_GOAL})
    worst = max(candidates.arcs[i] for i in best)
    low, high = 0, limits.index(worst)                   # limits[high] is feasible
    while low < high:
        middle = (low + high) // 2
        trial = solve_program(candidates, solver, mask, with_center, limits[middle])
        if trial is None:
            low = middle + 1
        else:
            best, high = trial, limits.index(max(candidates.arcs[i] for i in trial))
    # The last trial may have had a wider limit: fewest elements for exactly this one.
    return solve_program(candidates, solver, mask, with_center, limits[high])


def sorted_template(elements):
    return sorted((canonical(e) for e in elements), key=lambda e: (-len(e), e))


def verify(mask, template, with_center):
    """Exact check: a tiling of the cube, face to face, with the prescribed boundary."""
    def cyclic(face):
        i = face.index(min(face))
        return face[i:] + face[:i]
    assert sum(six_volume(e) for e in template) == 48
    faces = [cyclic(f) for e in template for f in element_faces(e)]
    pieces = {cyclic(p) for p in boundary_pieces(mask)}
    assert len(set(faces)) == len(faces)
    for face in faces:
        opposite = cyclic(face[::-1])
        assert (face in pieces) != (opposite in faces)
    assert pieces <= set(faces)
    assert all(six_volume(e) > 0 and is_strictly_convex(e) for e in template)
    available = boundary_vertices(mask) | ({CENTER} if with_center else set())
    assert {v for e in template for v in e} <= available


CANDIDATES = None      # built before the workers fork


def solve_class(arguments):
    """(mask, template, has_center) of one representative."""
    mask, solver = arguments
    for with_center in (False, True):
        solution = solve_pattern(CANDIDATES, solver, mask, with_center)
        if solution is not None:
            elements = [CANDIDATES.elements[i] for i in solution]
            template = min(sorted_template([tuple(s[v] for v in e) for e in elements])
                           for s in SYMMETRIES if image_of_mask(mask, s) == mask)
            verify(mask, template, with_center)
            return mask, template, with_center
    raise RuntimeError(f"pattern {mask:#05x}: no template even with the center")


# ------------------------------------------------------------------------------------------------
# Output.

HEADER = """\
// Copyright (c) 2026 The Mixed_mesh_3 authors.
//
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// GENERATED by scripts/generate_transition_tables.py: do not edit.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_TRANSITION_TABLES_H
#define CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_TRANSITION_TABLES_H

#include <CGAL/license/Mixed_mesh_3.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

// The templates of the %(classes)d classes of edge patterns modulo the symmetries of the cube; the
// numberings are drawn in transition_templates.h, which expands them to all 4096 patterns.
//
// A class is: mask, number of elements, elements.  An element is: kind (0 tetrahedron, 1 pyramid,
// 2 prism, 3 hexahedron), then its 4, 5, 6 or 8 lattice indices.
// Comments: mask, elements of each kind, worst ARC, "center" if the cell center (13) is a vertex.
// %(free)d classes do without the center (worst ARC %(arc_free).3f),
// %(centered)d have it (worst ARC %(arc_centered).3f).

// Orbits of the 2^12 patterns under the 48 symmetries of the cube.
inline constexpr int number_of_transition_classes = %(classes)d;

inline constexpr unsigned short transition_table[] = {
"""

FOOTER = """\
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_TRANSITIONS_TRANSITION_TABLES_H
"""


def worst_arc(template):
    return max(aspect_ratio(e) for e in template)


def uses_center(template):
    return any(CENTER in e for e in template)


def counts_text(template):
    counts = [sum(KIND_OF_SIZE[len(e)] == kind for e in template) for kind in range(4)]
    return ", ".join(f"{n} {(KIND_PLURALS if n > 1 else KIND_NAMES)[kind]}"
                     for kind, n in reversed(list(enumerate(counts))) if n)


def write_header(path, templates):
    free = [t for _, t in templates if not uses_center(t)]
    centered = [t for _, t in templates if uses_center(t)]
    with open(path, "w") as out:
        out.write(HEADER % dict(classes=len(templates), free=len(free), centered=len(centered),
                                arc_free=max(map(worst_arc, free)),
                                arc_centered=max(map(worst_arc, centered))))
        for mask, template in templates:
            out.write(f"  // {mask:#05x}: {counts_text(template)}; {worst_arc(template):.2f}"
                      f"{'; center' if uses_center(template) else ''}\n")
            line = f"  {mask:#05x},{len(template)},"
            for e in template:
                word = f" {KIND_OF_SIZE[len(e)]}," + ",".join(map(str, e)) + ","
                if len(line) + len(word) > 100:
                    out.write(line + "\n")
                    line = "   "
                line += word
            out.write(line + "\n")
        out.write(FOOTER)


def main():
    global CANDIDATES
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--solver", choices=("cbc", "glpsol"), default="cbc")
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--output", default=OUTPUT)
    arguments = parser.parse_args()

    CANDIDATES = Candidates()
    counts = [sum(KIND_OF_SIZE[len(e)] == k for e in CANDIDATES.elements) for k in range(4)]
    print("candidates:", ", ".join(f"{n} {name}" for n, name in zip(counts, KIND_PLURALS)))
    masks = representatives()
    with concurrent.futures.ProcessPoolExecutor(arguments.jobs) as pool:
        templates = []
        for mask, template, _ in pool.map(solve_class, [(m, arguments.solver) for m in masks]):
            templates.append((mask, template))
            print(f"{mask:#05x}: {counts_text(template)}; {worst_arc(template):.3f}"
                  f"{'; center' if uses_center(template) else ''}", flush=True)
    write_header(arguments.output, templates)
    free = sum(not uses_center(t) for _, t in templates)
    print(f"{len(templates)} classes, {free} without the center, "
          f"{sum(len(t) for _, t in templates)} elements")


if __name__ == "__main__":
    sys.exit(main())
