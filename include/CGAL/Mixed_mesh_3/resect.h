// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Resection: the elements that are removed with a tumor, and the mesh that is left.

#ifndef CGAL_MIXED_MESH_3_RESECT_H
#define CGAL_MIXED_MESH_3_RESECT_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3.h>
#include <CGAL/Mixed_mesh_3/boundary_faces.h>
#include <CGAL/Mixed_mesh_3/internal/resection/Resection_repair.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>
#include <CGAL/Mixed_mesh_3/quality.h>
#include <CGAL/Polyhedral_mixed_mesh_domain_3.h>

#include <CGAL/Named_function_parameters.h>
#include <CGAL/assertions.h>
#include <CGAL/enum.h>

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {

/// \ingroup PkgMixedMesh3Resection
/// The outcome of `resect()`.
enum class Resection_status {
  SUCCESS,              ///< elements are removed, and the boundary of the rest is a closed 2-manifold
  NOTHING_REMOVED,      ///< no requested element is still there: no centroid is inside
  EVERYTHING_RESTORED,  ///< all requested elements had to stay: each would leave a pinched vertex
  EVERYTHING_REMOVED,   ///< no element is left
  BOUNDARY_NOT_MANIFOLD ///< pinched vertices remain: the boundary of the mesh was not a manifold before
};

/// \ingroup PkgMixedMesh3Resection
/// A status in words.
inline const char* description(Resection_status status)
{
  switch(status) {
  case Resection_status::SUCCESS: return "success";
  case Resection_status::NOTHING_REMOVED: return "nothing removed: no element is inside";
  case Resection_status::EVERYTHING_RESTORED:
    return "nothing removed: without the elements inside, the boundary would touch itself";
  case Resection_status::EVERYTHING_REMOVED: return "everything removed: no element is left";
  case Resection_status::BOUNDARY_NOT_MANIFOLD: return "the boundary of what is left is not a manifold";
  }
  return "";
}

/// \ingroup PkgMixedMesh3Resection
/// Further input and options of `resect()`.
struct Resection_options
{
  /// The elements removed by earlier resections, true for each; empty: none. Removed elements stay removed.
  std::vector<bool> already_removed;
  /// Whether pieces that come loose stay. Each loose piece moves on its own then.
  bool keep_floating_pieces = false;
};

/// \ingroup PkgMixedMesh3Resection
/// A piece that comes loose: elements connected across faces.
struct Floating_piece_3
{
  std::vector<Element_index> elements; ///< elements in increasing order
  double volume = 0;                   ///< in the cube of the mesh's unit: mm^3
};

/// \ingroup PkgMixedMesh3Resection
/// The removed elements of `resect()`: of the elements not removed before, the requested ones, minus
/// `number_of_restored_elements`, plus `number_of_floating_elements` plus `number_of_pinch_elements`.
struct Resection_3
{
  /// The outcome.
  Resection_status status = Resection_status::NOTHING_REMOVED;
  std::vector<bool> is_removed;                ///< elements to remove, including elements removed before
  std::size_t number_of_asked_elements = 0;    ///< requested elements that were not removed before
  std::size_t number_of_restored_elements = 0; ///< elements that stay: without them a vertex would be pinched
  /// The number of elements removed in addition, as they came loose; 0 if loose pieces are kept.
  std::size_t number_of_floating_elements = 0;
  std::size_t number_of_pinch_elements = 0;   ///< removed in addition: with them a vertex would be pinched
  std::size_t number_of_pinched_vertices = 0; ///< pinched vertices that remain
  /// The pieces that came loose, removed or kept: of each connected part of the mesh all but the largest.
  std::vector<Floating_piece_3> floating;
  double volume = 0; ///< volume of this resection, in the cube of the mesh's unit: mm^3

  /// Whether some element is left to compute with.
  bool has_mesh() const
  {
    return status != Resection_status::EVERYTHING_REMOVED
           && status != Resection_status::BOUNDARY_NOT_MANIFOLD;
  }
};

namespace internal {

// A model of `MixedMeshDomain_3` has parts of a surface; a surface has none.
template <class Tumor, class = void>
struct Is_domain : std::false_type
{
};

template <class Tumor>
struct Is_domain<Tumor, std::void_t<typename Tumor::Surface_part>> : std::true_type
{
};

// The side of a point. The concept demands a part of the surface with the point; our domains are faster
// without.
template <class Domain, class = void>
struct Side_of_domain
{
  const Domain& domain;
  typename Domain::Surface_part part = domain.surface_part();
  Bounded_side operator()(const typename Domain::Point_3& p) const { return domain.bounded_side(p, part); }
};

template <class Domain>
struct Side_of_domain<Domain, std::void_t<decltype(std::declval<const Domain&>().bounded_side(
                                std::declval<const typename Domain::Point_3&>()))>>
{
  const Domain& domain;
  Bounded_side operator()(const typename Domain::Point_3& p) const { return domain.bounded_side(p); }
};

} // namespace internal

/*!
\ingroup PkgMixedMesh3Resection

\brief Removes elements from a mesh, such that what is left can be computed with.

An element that is connected by a vertex or an edge only is a hinge: elasticity is singular there. So the
boundary of the remaining mesh is a closed oriented 2-manifold, if that of the mesh was. To this end a few
requested elements stay, and a few other elements are removed: `internal::Resection_repair` says which. Pieces
that come loose are reported, and removed by default.

The same input gives the same result. The mesh is not changed: `remaining_mesh()` makes the mesh that is left.

\tparam Mesh a `Mixed_mesh_3`
\param mesh the mesh. \pre conforming, of positive elements, its boundary a closed 2-manifold
\param is_asked true for each element to remove. \pre one value for each element
\param options elements removed before, and whether loose pieces stay. \pre `already_removed` is empty, or has
one value for each element
\return the removed elements, and the reasons
\par Complexity
Linear in the number of elements, plus a tenth of a millisecond for each pinched vertex
*/
template <class Mesh>
Resection_3 resect(const Mesh& mesh, const std::vector<bool>& is_asked,
                   const Resection_options& options = Resection_options())
{
  using Repair = internal::Resection_repair;
  using State = Repair::State;
  const std::size_t n = mesh.number_of_elements();
  CGAL_precondition(is_asked.size() == n);
  CGAL_precondition(options.already_removed.empty() || options.already_removed.size() == n);
  Resection_3 result;
  result.is_removed = options.already_removed;
  result.is_removed.resize(n, false);
  std::size_t number_of_elements_left = 0; // number if all requested elements are removed
  std::vector<State> states(n, State::KEPT);
  std::vector<double> volumes(n);
  for(std::size_t e = 0; e < n; ++e) {
    states[e] = result.is_removed[e] ? State::GONE : is_asked[e] ? State::ASKED : State::KEPT;
    result.number_of_asked_elements += states[e] == State::ASKED;
    number_of_elements_left += states[e] == State::KEPT;
    volumes[e] = volume(mesh, e);
  }
  if(result.number_of_asked_elements == 0) {
    if(number_of_elements_left == 0)
      result.status = Resection_status::EVERYTHING_REMOVED;
    return result;
  }

  Repair repair(mesh.elements(), mesh.number_of_vertices(), volumes, std::move(states));
  if(number_of_elements_left != 0) {
    if(!options.keep_floating_pieces)
      repair.find_floating(true);
    repair.remove_pinches();
    repair.find_floating(!options.keep_floating_pieces);
    for(const Repair::Piece& piece : repair.floating())
      result.floating.push_back({piece.elements, piece.volume});
    result.number_of_pinched_vertices = repair.number_of_pinched_vertices();
  }
  std::size_t number_of_removed_elements = 0;
  number_of_elements_left = 0;
  for(Element_index e = 0; e < n; ++e) {
    const State state = repair.states()[e];
    result.is_removed[e] = state != State::KEPT;
    result.number_of_restored_elements += state == State::KEPT && repair.is_asked(e);
    result.number_of_floating_elements += state == State::FLOATING;
    result.number_of_pinch_elements += state == State::PINCH;
    number_of_elements_left += state == State::KEPT;
    if(state != State::KEPT && state != State::GONE) {
      ++number_of_removed_elements;
      result.volume += volumes[e];
    }
  }
  result.status = number_of_elements_left == 0             ? Resection_status::EVERYTHING_REMOVED
                  : result.number_of_pinched_vertices != 0 ? Resection_status::BOUNDARY_NOT_MANIFOLD
                  : number_of_removed_elements == 0        ? Resection_status::EVERYTHING_RESTORED
                                                           : Resection_status::SUCCESS;
  return result;
}

/*!
\ingroup PkgMixedMesh3Resection

\brief Removes the elements in a tumor: elements whose centroid, the mean of their vertices, is inside.

A centroid on the surface is not inside. The answer is exact on the centroid, rounded to double, as far as the
answer of the domain is.

\tparam Mesh a `Mixed_mesh_3`
\tparam Tumor a model of `MixedMeshDomain_3`, of which the inside test is used only, or a model of
        `FaceListGraph` with points of any CGAL kernel
\param mesh mesh as above
\param tumor tumor in the coordinates of the mesh. \pre a surface is closed and triangulated
\param options options as above
\param np an optional sequence of \ref bgl_namedparameters "Named Parameters" among those below

\cgalNamedParamsBegin
  \cgalParamNBegin{vertex_point_map}
    \cgalParamDescription{the points of `tumor`, if that is a `FaceListGraph`}
    \cgalParamType{a model of `ReadablePropertyMap` with the vertices as keys and points as values}
    \cgalParamDefault{`get_const_property_map(CGAL::vertex_point, tumor)`}
  \cgalParamNEnd
\cgalNamedParamsEnd

\return the removed elements, and the reasons
\par Complexity
Complexity as above, plus an inside test for each element
*/
template <class Mesh, class Tumor, class NamedParameters = parameters::Default_named_parameters>
Resection_3 resect(const Mesh& mesh, const Tumor& tumor,
                   const Resection_options& options = Resection_options(),
                   [[maybe_unused]] const NamedParameters& np = parameters::default_values())
{
  if constexpr(!internal::Is_domain<Tumor>::value) {
    return resect(mesh, Polyhedral_mixed_mesh_domain_3(tumor, np), options);
  } else {
    CGAL_precondition(options.already_removed.empty()
                      || options.already_removed.size() == mesh.number_of_elements());
    const internal::Side_of_domain<Tumor> side{tumor};
    std::vector<bool> is_inside(mesh.number_of_elements(), false);
    for(std::size_t e = 0; e < is_inside.size(); ++e) {
      if(!options.already_removed.empty() && options.already_removed[e])
        continue;
      Vec3 centroid{};
      for(Vertex_index v : mesh.element(e))
        centroid = centroid + to_vec3(mesh.point(v));
      centroid = (1. / mesh.element(e).size()) * centroid;
      is_inside[e] = side(typename Tumor::Point_3(centroid[0], centroid[1], centroid[2])) == ON_BOUNDED_SIDE;
    }
    return resect(mesh, is_inside, options);
  }
}

/*!
\ingroup PkgMixedMesh3Resection

\brief The mesh that is left: without the removed elements, and without vertices of removed elements only.

Elements and vertices keep their order, elements their attributes, and both their data.

\param mesh the mesh
\param is_removed true for each element that is removed. \pre one for each element
\param vertex_map if not null, receives for each vertex of the result its index in `mesh`, in increasing order
\param element_map if not null, receives for each element of the result its index in `mesh`, likewise
\par Complexity
Linear in the number of elements
*/
template <class Mesh>
Mesh remaining_mesh(const Mesh& mesh, const std::vector<bool>& is_removed,
                    std::vector<Vertex_index>* vertex_map = nullptr,
                    std::vector<Element_index>* element_map = nullptr)
{
  CGAL_precondition(is_removed.size() == mesh.number_of_elements());
  std::vector<Vertex_index> numbers(mesh.number_of_vertices(), internal::no_vertex);
  for(std::size_t e = 0; e < is_removed.size(); ++e)
    if(!is_removed[e])
      for(Vertex_index v : mesh.element(e))
        numbers[v] = 0;
  Mesh remaining;
  std::vector<Vertex_index> vertices;
  std::vector<Element_index> elements;
  for(Vertex_index v = 0; v < numbers.size(); ++v)
    if(numbers[v] != internal::no_vertex) {
      numbers[v] = remaining.add_vertex(mesh.point(v));
      vertices.push_back(v);
    }
  for(Element_index e = 0; e < is_removed.size(); ++e)
    if(!is_removed[e]) {
      const Element_view element = mesh.element(e);
      std::vector<Vertex_index> v;
      for(Vertex_index u : element)
        v.push_back(numbers[u]);
      remaining.add_element(element.kind(), v, mesh.attributes(e));
      elements.push_back(e);
    }
  remaining.vertex_data() = mesh.vertex_data().selected(vertices);
  remaining.element_data() = mesh.element_data().selected(elements);
  if(vertex_map != nullptr)
    *vertex_map = std::move(vertices);
  if(element_map != nullptr)
    *element_map = std::move(elements);
  return remaining;
}

/*!
\ingroup PkgMixedMesh3Resection

The surface of the cavity: the faces of elements that are left against elements that are removed, in the
numbers of `mesh`, in the order of the elements left.

\param mesh the mesh
\param is_removed true for each element that is removed. \pre one for each element
\par Complexity
Linear in the number of elements
*/
template <class Mesh>
std::vector<Face> cavity_faces(const Mesh& mesh, const std::vector<bool>& is_removed)
{
  CGAL_precondition(is_removed.size() == mesh.number_of_elements());
  std::vector<bool> is_at_cavity(mesh.number_of_vertices(), false);
  for(Element_index e = 0; e < is_removed.size(); ++e)
    if(is_removed[e])
      for(Vertex_index v : mesh.element(e))
        is_at_cavity[v] = true;
  std::vector<Face> faces;
  internal::for_each_face(
    mesh.elements(), mesh.number_of_vertices(), [&](Vertex_index v) { return is_at_cavity[v]; },
    [&](const auto& group) {
      if(group.size() == 2 && is_removed[group.element(0)] != is_removed[group.element(1)])
        faces.push_back(group[is_removed[group.element(0)] ? 1 : 0]);
    });
  std::sort(faces.begin(), faces.end());
  return faces;
}

} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_RESECT_H
