// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_IO_FEB_MODEL_H
#define CGAL_MIXED_MESH_3_IO_FEB_MODEL_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Elastic_material.h>
#include <CGAL/Mixed_mesh_3/Element_attributes.h>
#include <CGAL/Mixed_mesh_3/IO/Data_array.h>
#include <CGAL/Mixed_mesh_3/IO/Facet_set.h>
#include <CGAL/Mixed_mesh_3/IO/Subdomain_names.h>
#include <CGAL/Mixed_mesh_3/IO/internal/Buffered_output.h>
#include <CGAL/Mixed_mesh_3/IO/internal/mesh/FEB_output.h>
#include <CGAL/Mixed_mesh_3/Index.h>
#include <CGAL/Mixed_mesh_3/internal/base/vector_3.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <ostream>
#include <string>
#include <vector>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace IO {

/*!
\ingroup PkgMixedMesh3IO

\brief A displacement that others tell: that of a node along an axis is the sum of displacements times
factors, plus a value in mm. Nodes are vertices and, with elements of order 2, the middles of edges after
these.

Without terms it is prescribed. A displacement that one constraint tells is in the terms of none, and told by
no other: FEBio wants that.
*/
struct FEB_constraint
{
  /// A displacement times a factor.
  struct Term
  {
    Vertex_index vertex; ///< whose displacement
    int axis;            ///< 0, 1 or 2
    double factor;       ///< times the displacement
  };
  Vertex_index vertex;     ///< whose displacement is told
  int axis;                ///< 0, 1 or 2
  std::vector<Term> terms; ///< what tells it
  double value = 0;        ///< mm
};

/*!
\ingroup PkgMixedMesh3IO

\brief What a simulation by FEBio needs besides a mesh. Units: millimeters, kilopascals, kilograms, seconds.
Vertices are nodes, as in `FEB_constraint`.
*/
struct FEB_model
{
  /// Of subdomains; of others, `Elastic_material()`.
  std::map<Subdomain_index, Elastic_material> materials;
  /// Those that do not move.
  std::vector<Vertex_index> fixed_vertices;
  /// Displacements along the axes that supports tell; values are zero.
  std::vector<FEB_constraint> supports;
  /// Displacements that are given, and grow from zero to their values.
  std::vector<FEB_constraint> controls;
  /// The force by mass on subdomains, mm/s^2.
  std::map<Subdomain_index, Vec3> accelerations;
  /// Faces with a name.
  std::vector<Facet_set> facet_sets;
  /// Names of subdomains.
  Subdomain_names subdomain_names;
  /// The order of the elements, 1 or 2: see `Write_options::order`.
  int order = 1;
  /// The file that FEBio will write the displacements of the vertices to, beside its own.
  std::string displacements_file = "displacements.csv";
  /// Lines for a reader of the file, without two hyphens in a row.
  std::vector<std::string> comments;
};

namespace internal {

constexpr std::array<const char*, 3> FEB_axes{"x", "y", "z"};

/// Prescribed displacements along an axis, by vertex.
struct FEB_prescribed
{
  FEB_node_set set;
  std::vector<double> values;

  FEB_prescribed(const std::string& name, int axis, std::vector<FEB_constraint> constraints)
    : set{name + '_' + FEB_axes[std::size_t(axis)], {}}
  {
    std::sort(constraints.begin(), constraints.end(),
              [](const FEB_constraint& a, const FEB_constraint& b) { return a.vertex < b.vertex; });
    for(const FEB_constraint& c : constraints)
      if(c.axis == axis && c.terms.empty()) {
        set.vertices.push_back(c.vertex);
        values.push_back(c.value);
      }
  }
};

inline void write_FEB_control(Buffered_output& out)
{
  out << "  <Control>\n"
      << "    <analysis>STATIC</analysis>\n"
      << "    <time_steps>10</time_steps>\n"
      << "    <step_size>0.1</step_size>\n"
      << "    <time_stepper type=\"default\">\n"
      << "      <max_retries>5</max_retries>\n"
      << "      <opt_iter>10</opt_iter>\n"
      << "      <dtmin>0.001</dtmin>\n"
      << "      <dtmax>0.1</dtmax>\n"
      << "    </time_stepper>\n"
      << "    <solver type=\"solid\">\n"
      << "      <symmetric_stiffness>symmetric</symmetric_stiffness>\n"
      << "    </solver>\n"
      << "  </Control>\n";
}

inline void write_FEB_constraints(Buffered_output& out, const std::vector<FEB_constraint>& constraints)
{
  for(const FEB_constraint& c : constraints)
    if(!c.terms.empty()) {
      out << "    <bc type=\"linear constraint\">\n      <node>" << c.vertex + 1 << "</node>\n      <dof>"
          << FEB_axes[std::size_t(c.axis)] << "</dof>\n";
      if(c.value != 0)
        out << "      <offset lc=\"1\">" << c.value << "</offset>\n";
      for(const FEB_constraint::Term& term : c.terms)
        out << "      <child_dof><node>" << term.vertex + 1 << "</node><dof>"
            << FEB_axes[std::size_t(term.axis)] << "</dof><value>" << term.factor << "</value></child_dof>\n";
      out << "    </bc>\n";
    }
}

inline void write_FEB_zero(Buffered_output& out, const FEB_node_set& set, const std::string& axes)
{
  if(set.vertices.empty())
    return;
  out << "    <bc name=\"" << set.name << "\" type=\"zero displacement\" node_set=\"" << set.name << "\">\n";
  for(const char* axis : FEB_axes)
    out << "      <" << axis << "_dof>" << (axes.find(axis) == axes.npos ? 0 : 1) << "</" << axis
        << "_dof>\n";
  out << "    </bc>\n";
}

inline void write_FEB_given(Buffered_output& out, const FEB_node_set& set, const char* axis)
{
  if(!set.vertices.empty())
    out << "    <bc name=\"" << set.name << "\" type=\"prescribed displacement\" node_set=\"" << set.name
        << "\">\n      <dof>" << axis << "</dof>\n      <value lc=\"1\" type=\"map\">" << set.name
        << "</value>\n      <relative>0</relative>\n    </bc>\n";
}

/// FEBio's force by mass has the sign of what balances it, against the direction in which it acts.
template <class Mesh>
void write_FEB_loads(Buffered_output& out, const FEB_output<Mesh>& output, const FEB_model& model)
{
  const auto acceleration = [&](const Element_block& block) {
    const auto place = model.accelerations.find(output.subdomain(block));
    return place == model.accelerations.end() ? Vec3{} : place->second;
  };
  bool is_open = false;
  for(const Element_block& block : output.blocks()) {
    const Vec3 a = acceleration(block);
    if(a == Vec3{})
      continue;
    out << (is_open ? "" : "  <Loads>\n") << "    <body_load type=\"body force\" elem_set=\""
        << output.name(block) << "\">\n      <force lc=\"1\">";
    write_point(out, Vec3{} - a, ",");
    out << "</force>\n    </body_load>\n";
    is_open = true;
  }
  out << (is_open ? "  </Loads>\n" : "");
}

inline void write_FEB_curve_and_output(Buffered_output& out, const std::string& displacements_file)
{
  out << "  <LoadData>\n"
      << "    <load_controller id=\"1\" type=\"loadcurve\">\n"
      << "      <interpolate>LINEAR</interpolate>\n"
      << "      <points>\n        <pt>0,0</pt>\n        <pt>1,1</pt>\n      </points>\n"
      << "    </load_controller>\n"
      << "  </LoadData>\n"
      << "  <Output>\n"
      << "    <plotfile type=\"febio\">\n"
      << "      <var type=\"displacement\"/>\n      <var type=\"stress\"/>\n"
      << "    </plotfile>\n"
      << "    <logfile>\n"
      << "      <node_data data=\"ux;uy;uz\" delim=\",\" node_set=\"all\" file=\""
      << escaped_for_XML(displacements_file) << "\"/>\n"
      << "    </logfile>\n"
      << "  </Output>\n";
}

} // namespace internal

/*!
\ingroup PkgMixedMesh3IO

\brief Writes a simulation as a model of FEBio (`.feb`), version 4.0, that FEBio 4 runs as it is.

The mesh is that of `write_FEB()`, with the names it has there, but node sets are those below only. Besides:
- materials, `isotropic elastic`: linear in the Green-Lagrange strain, and for small strains and rotations the
  linear law; with the density in kg/mm^3;
- the node set `fixed`, whose displacement is zero; `sliding_x`, `sliding_y` and `sliding_z`, where the
  component is; `controlled_x` and so on, which have prescribed displacements, the mesh data of the same name
  times load curve 1;
- linear constraints for all other supports and controls, their offset times load curve 1;
- a body force for each part that has one;
- a static step of ten increments, more if they do not converge, in which load curve 1 goes from 0 to 1; the
  plot file, and a log of the displacements of all nodes.

\param stream the stream
\param mesh the mesh
\param model materials, supports and loads

\return whether the stream took everything.
*/
template <class Mesh>
bool write_FEB_model(std::ostream& stream, const Mesh& mesh, const FEB_model& model)
{
  using namespace internal;
  const FEB_output<Mesh> output(mesh, model.subdomain_names, model.order);
  std::vector<FEB_prescribed> sliding, controlled;
  for(int axis = 0; axis < 3; ++axis) {
    sliding.emplace_back("sliding", axis, model.supports);
    controlled.emplace_back("controlled", axis, model.controls);
  }
  std::vector<FEB_node_set> sets{{"fixed", model.fixed_vertices}};
  std::vector<FEB_node_data> data;
  for(const FEB_prescribed& s : sliding)
    sets.push_back(s.set);
  for(const FEB_prescribed& c : controlled) {
    sets.push_back(c.set);
    FEB_node_data& of_set = data.emplace_back();
    of_set.data.name = of_set.node_set = c.set.name;
    of_set.data.values = &c.values;
  }

  Buffered_output out(stream);
  output.write_head(out);
  out << "  <!-- Units: mm, kPa, kg, s. So forces are in mN, densities in kg/mm^3. -->\n";
  for(const std::string& line : model.comments)
    out << "  <!-- " << line << " -->\n";
  write_FEB_control(out);
  output.write_materials(out, [&](Subdomain_index s) {
    const auto place = model.materials.find(s);
    const Elastic_material m = place == model.materials.end() ? Elastic_material() : place->second;
    out << "type=\"isotropic elastic\">\n      <density>" << m.density << "</density>\n      <E>"
        << m.young_modulus << "</E>\n      <v>" << m.poisson_ratio << "</v>\n";
  });
  output.write_mesh(out, sets, model.facet_sets);
  output.write_node_data(out, data);
  if(!model.fixed_vertices.empty() || !model.supports.empty() || !model.controls.empty()) {
    out << "  <Boundary>\n";
    write_FEB_zero(out, sets.front(), "xyz");
    for(std::size_t axis = 0; axis < 3; ++axis) {
      write_FEB_zero(out, sliding[axis].set, FEB_axes[axis]);
      write_FEB_given(out, controlled[axis].set, FEB_axes[axis]);
    }
    write_FEB_constraints(out, model.supports);
    write_FEB_constraints(out, model.controls);
    out << "  </Boundary>\n";
  }
  write_FEB_loads(out, output, model);
  write_FEB_curve_and_output(out, model.displacements_file);
  output.write_foot(out);
  return out.finish();
}

} // namespace IO
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_IO_FEB_MODEL_H
