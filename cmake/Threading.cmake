# SPDX-License-Identifier: GPL-3.0-or-later
#
# Target: CGAL::Mixed_mesh_3_threading, TBB if it is found, for CGAL::Parallel_tag.

find_package(TBB QUIET)
include(CGAL_TBB_support)
add_library(CGAL::Mixed_mesh_3_threading INTERFACE IMPORTED)
if(TARGET CGAL::TBB_support)
  set_property(TARGET CGAL::Mixed_mesh_3_threading APPEND PROPERTY INTERFACE_LINK_LIBRARIES CGAL::TBB_support)
endif()
