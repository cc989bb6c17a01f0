// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// Scopes of stages: the object that begins a stage ends the stage.

#ifndef CGAL_MIXED_MESH_3_INTERNAL_MESHING_STAGE_SCOPES_H
#define CGAL_MIXED_MESH_3_INTERNAL_MESHING_STAGE_SCOPES_H

#include <CGAL/license/Mixed_mesh_3.h>

#include <CGAL/Mixed_mesh_3/Default_visitor.h>
#include <CGAL/Mixed_mesh_3/internal/oracle/Any_visitor.h>

namespace CGAL {
namespace Mixed_meshes_3 {
namespace internal {

/// A stage that lasts as long as the object lives.
class Stage_scope
{
  Any_visitor& m_visitor;
  const Stage m_stage;

public:
  Stage_scope(Any_visitor& visitor, Stage stage) : m_visitor(visitor), m_stage(stage)
  {
    visitor.begin_stage(stage);
  }
  ~Stage_scope() { m_visitor.end_stage(m_stage); }
  Stage_scope(const Stage_scope&) = delete;
  Stage_scope& operator=(const Stage_scope&) = delete;
};

/// A pause of a stage for other stages in between: stages are not nested.
class Stage_pause
{
  Any_visitor& m_visitor;
  const Stage m_stage;

public:
  Stage_pause(Any_visitor& visitor, Stage stage) : m_visitor(visitor), m_stage(stage)
  {
    visitor.end_stage(stage);
  }
  ~Stage_pause() { m_visitor.begin_stage(m_stage); }
  Stage_pause(const Stage_pause&) = delete;
  Stage_pause& operator=(const Stage_pause&) = delete;
};

} // namespace internal
} // namespace Mixed_meshes_3
} // namespace CGAL

#endif // CGAL_MIXED_MESH_3_INTERNAL_MESHING_STAGE_SCOPES_H
