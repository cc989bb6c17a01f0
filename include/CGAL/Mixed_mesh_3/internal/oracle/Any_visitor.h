// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later

#ifndef CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_VISITOR_H
#define CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_VISITOR_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/base/Core_mesh.h>

#include <cstddef>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A visitor whose type is not known: the driver is compiled once for all.
class Any_visitor
{
public:
  virtual ~Any_visitor() = default;
  virtual void begin_stage(Stage stage) = 0;
  virtual void end_stage(Stage stage) = 0;
  virtual void progress(std::size_t number_of_vertices, std::size_t budget) = 0;
  virtual bool go_on() = 0;
  virtual void before_fitting(const Core_mesh& mesh) = 0;
};

template <class Visitor>
class Visitor_reference final : public Any_visitor
{
  Visitor& m_visitor;

public:
  explicit Visitor_reference(Visitor& visitor) : m_visitor(visitor) {}
  void begin_stage(Stage stage) override { m_visitor.begin_stage(stage); }
  void end_stage(Stage stage) override { m_visitor.end_stage(stage); }
  void progress(std::size_t number_of_vertices, std::size_t budget) override
  {
    m_visitor.progress(number_of_vertices, budget);
  }
  bool go_on() override { return m_visitor.go_on(); }
  void before_fitting(const Core_mesh& mesh) override { m_visitor.before_fitting(mesh); }
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_ORACLE_ANY_VISITOR_H
