# SPDX-License-Identifier: GPL-3.0-or-later
#
# What Mixed_mesh_image_3 needs, as the target CGAL::Mixed_mesh_3_nifti, if it is there: libnifti2 of nifti_clib,
# and zlib; and what files of meshes and surfaces may be compressed by, as the target
# CGAL::Mixed_mesh_3_compression: zlib, or nothing. CMakeLists.txt includes this file, and so does the installed
# package. Debian 12's package of nifti_clib has a NIFTIConfig.cmake that fails without the programs of another
# package.

find_package(ZLIB QUIET)
add_library(CGAL::Mixed_mesh_3_compression INTERFACE IMPORTED)
if(ZLIB_FOUND)
  set_target_properties(CGAL::Mixed_mesh_3_compression PROPERTIES
    INTERFACE_COMPILE_DEFINITIONS CGAL_USE_ZLIB
    INTERFACE_LINK_LIBRARIES ZLIB::ZLIB)
endif()
find_path(NIFTI2_INCLUDE_DIR nifti2_io.h PATH_SUFFIXES nifti)
find_library(NIFTI2_LIBRARY nifti2)
find_library(ZNZ_LIBRARY znz)
mark_as_advanced(NIFTI2_INCLUDE_DIR NIFTI2_LIBRARY ZNZ_LIBRARY)
if(ZLIB_FOUND AND NIFTI2_INCLUDE_DIR AND NIFTI2_LIBRARY AND ZNZ_LIBRARY)
  add_library(CGAL::Mixed_mesh_3_nifti INTERFACE IMPORTED)
  set_target_properties(CGAL::Mixed_mesh_3_nifti PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES ${NIFTI2_INCLUDE_DIR}
    INTERFACE_LINK_LIBRARIES "${NIFTI2_LIBRARY};${ZNZ_LIBRARY};ZLIB::ZLIB")
endif()
