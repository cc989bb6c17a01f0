# SPDX-License-Identifier: GPL-3.0-or-later
#
# The sparse solvers of this system, as the target CGAL::Mixed_mesh_3_solvers: Eigen, which Algorithm 1 and
# elasticity need, and CHOLMOD of SuiteSparse. Without them, all else works. CMakeLists.txt includes this file,
# and so does the installed package: each uses what it finds where it runs.

add_library(CGAL::Mixed_mesh_3_solvers INTERFACE IMPORTED)
find_package(Eigen3 QUIET CONFIG)
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY)
if(TARGET Eigen3::Eigen)
  set_property(TARGET CGAL::Mixed_mesh_3_solvers APPEND PROPERTY INTERFACE_LINK_LIBRARIES Eigen3::Eigen)
  if(CHOLMOD_INCLUDE_DIR AND CHOLMOD_LIBRARY)
    set_property(TARGET CGAL::Mixed_mesh_3_solvers APPEND PROPERTY INTERFACE_LINK_LIBRARIES ${CHOLMOD_LIBRARY})
    set_target_properties(CGAL::Mixed_mesh_3_solvers PROPERTIES
      INTERFACE_INCLUDE_DIRECTORIES ${CHOLMOD_INCLUDE_DIR}
      INTERFACE_COMPILE_DEFINITIONS CGAL_MIXED_MESH_3_USE_CHOLMOD)
  endif()
endif()
