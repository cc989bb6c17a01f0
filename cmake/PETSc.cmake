# SPDX-License-Identifier: GPL-3.0-or-later
#
# What Mixed_mesh_petsc/Petsc_solver_traits.h needs, as the target CGAL::Mixed_mesh_3_petsc, if it is there: PETSc with
# real numbers, and MPI. CMakeLists.txt includes this file, and so does the installed package. Nothing else links
# it, so that programs that do without do not load it.

option(MIXED_MESH_3_USE_PETSC "Use PETSc, if it is found" ON)
if(MIXED_MESH_3_USE_PETSC AND TARGET Eigen3::Eigen)
  find_package(PkgConfig QUIET)
  if(PKG_CONFIG_FOUND)
    pkg_check_modules(MIXED_MESH_3_PETSC QUIET IMPORTED_TARGET PETSc>=3.15)
  endif()
  if(TARGET PkgConfig::MIXED_MESH_3_PETSC)
    set(MPI_CXX_SKIP_MPICXX ON)
    find_package(MPI QUIET COMPONENTS CXX)
  endif()
  if(TARGET PkgConfig::MIXED_MESH_3_PETSC AND TARGET MPI::MPI_CXX)
    add_library(CGAL::Mixed_mesh_3_petsc INTERFACE IMPORTED)
    set_property(TARGET CGAL::Mixed_mesh_3_petsc PROPERTY
      INTERFACE_LINK_LIBRARIES PkgConfig::MIXED_MESH_3_PETSC MPI::MPI_CXX)
  endif()
endif()
