// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// SPDX-License-Identifier: GPL-3.0-or-later

/*!
\ingroup PkgMixedMesh3Concepts
\cgalConcept

The concept `OctreeCellTraits_3` embeds an octree in space: it maps lattice points, which are integers, to
points.

The lattice is \f$ [0, 2^{21}]^3 \f$; the root cell is the whole lattice. A cell of level `l` has the lattice
side \f$ 2^{21-l} \f$, and `l` is at most 20, so that centers of cells are also lattice points.

The map must be affine, and preserve orientation, so that cells are parallelepipeds and elements, which are
convex in the lattice, are convex and positive in space. The map must be exact on all lattice points that are
used: cells that have a vertex, an edge or a face in common then have it exactly. For that reason, the models
choose an origin and a unit with few significant bits.

The root cell must contain the domain, with space around the domain: where the surface touches the border of
the root cell, a pinched boundary of the mesh cannot be repaired.

A model need not be copyable. A model must outlive the call.

\cgalHasModelsBegin
\cgalHasModels{CGAL::Mixed_meshes_3::Axis_aligned_octree_cell_traits_3}
\cgalHasModels{CGAL::Mixed_meshes_3::Rotated_octree_cell_traits_3}
\cgalHasModelsEnd

\sa `CGAL::make_mixed_mesh_3()`
*/
class OctreeCellTraits_3
{
public:
  /*!
  The result of `cell()`: a cell as a domain and a region see it. The method passes the cell on, and calls no
  member of it; the models of `MixedMeshDomain_3` and of `MixedMeshRegion_3` use the members. The type need
  not be copyable or movable, nor be a nested type of that name.
  */
  class Cell
  {
  public:
    /// A box that contains the cell.
    CGAL::Bbox_3 bbox() const;

    /// The center of the cell, a lattice point.
    /// \return a `CGAL::Mixed_meshes_3::Predicates_kernel::Point_3`
    unspecified_type center() const;

    /// Whether the closed cell and the triangle have a point in common; the answer must be exact. Used by
    /// polyhedral domains and regions only.
    bool do_intersect(const CGAL::Mixed_meshes_3::Predicates_kernel::Triangle_3& t) const;
  };

  /// The position of a lattice point. The positions of the root's corners also define the scale on which
  /// distances and depths are compared.
  /// \return a `CGAL::Mixed_meshes_3::Predicates_kernel::Point_3`, or a type that converts to it and to
  ///         `MixedMeshDomain_3::Point_3` and has `x()`, `y()` and `z()` of type `double`
  unspecified_type point(const CGAL::Mixed_meshes_3::Lattice_point& p) const;

  /// The cell of lattice side `side` whose vertex with the smallest coordinates is `corner`.
  Cell cell(const CGAL::Mixed_meshes_3::Lattice_point& corner, std::uint32_t side) const;
};
