// Copyright (c) 2026 The Mixed_mesh_3 authors.
// This file is part of Mixed_mesh_3, being prepared for submission to CGAL (www.cgal.org).
//
// $URL$
// $Id$
// SPDX-License-Identifier: GPL-3.0-or-later
//
// The license of a package under the GPL, in the way of CGAL: users without a license for commercial use can
// be told, by a warning or an error, that the GPL holds.

#ifndef CGAL_LICENSE_MIXED_MESH_3_H
#define CGAL_LICENSE_MIXED_MESH_3_H

#include <CGAL/config.h>
#include <CGAL/license.h>

#ifdef CGAL_MIXED_MESH_3_COMMERCIAL_LICENSE

#if CGAL_MIXED_MESH_3_COMMERCIAL_LICENSE < CGAL_RELEASE_DATE
#ifdef CGAL_LICENSE_WARNING
CGAL_pragma_warning(
  "The commercial license of Mixed_mesh_3 is older than this release of CGAL: the GPL holds.")
#endif
#ifdef CGAL_LICENSE_ERROR
#error "The commercial license of Mixed_mesh_3 is older than this release of CGAL: the GPL holds."
#endif
#endif

#else

#ifdef CGAL_LICENSE_WARNING
CGAL_pragma_warning("There is no commercial license of Mixed_mesh_3: the GPL holds.")
#endif
#ifdef CGAL_LICENSE_ERROR
#error "There is no commercial license of Mixed_mesh_3: the GPL holds."
#endif

#endif // CGAL_MIXED_MESH_3_COMMERCIAL_LICENSE

#endif // CGAL_LICENSE_MIXED_MESH_3_H
