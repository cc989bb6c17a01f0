# SPDX-License-Identifier: GPL-3.0-or-later
#
# Debian packages of what is built, by `cpack -G DEB` in the folder of the build:
#   mixed-mesh-3            the programs mixed_mesh_3 and brain_shift
#   mixed-mesh-3-petsc      brain_shift --solver petsc, if there is PETSc
#   libmixed-mesh-3-dev     headers, libraries, and the files for find_package(Mixed_mesh_3)
#   python3-mixed-mesh-3    the Python package, if it is built

set(packages programs development)
if(TARGET brain_shift_petsc)
  list(APPEND packages petsc)
endif()
if(TARGET Mixed_mesh_3_python)
  list(APPEND packages python)
endif()
set(CPACK_COMPONENTS_ALL ${packages})

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_DIRECTORY ${PROJECT_BINARY_DIR}/packages)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE
                                                WORLD_READ WORLD_EXECUTE)
set(CPACK_PACKAGE_CONTACT "The Mixed_mesh_3 authors <mixed-mesh-3@users.noreply.github.com>")
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON) # by dpkg-shlibdeps: the libraries that programs and module are linked to

# The end of each description.
set(about "The method is an octree of the domain, which is split in a region of
 interest until a number of vertices is reached. Transitions make it
 conforming, and its boundary is brought onto the surface. No element is
 inverted.")
set(fast_blas "libopenblas0-serial | libopenblas0") # several times faster than the reference BLAS, for CHOLMOD

set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME mixed-mesh-3)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "${fast_blas}")
set(CPACK_DEBIAN_PROGRAMS_DESCRIPTION "meshes of hexahedra, prisms, pyramids and tetrahedra
 The program mixed_mesh_3 meshes a closed surface or an image of labels, and
 brain_shift deforms the mesh of a brain, and its image, by measured
 displacements.
 ${about}")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libmixed-mesh-3-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libcgal-dev (>= 5.5), libboost-dev, libgmp-dev, libmpfr-dev, libeigen3-dev, zlib1g-dev")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_RECOMMENDS "libsuitesparse-dev, libopenblas-dev, libnifti2-dev, libtbb-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "meshes of hexahedra, prisms, pyramids and tetrahedra (C++)
 Headers in the style of CGAL, and what has no template parameter compiled.
 ${about}")
set(CPACK_DEBIAN_PETSC_PACKAGE_NAME mixed-mesh-3-petsc)
set(CPACK_DEBIAN_PETSC_PACKAGE_DEPENDS "mixed-mesh-3 (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_PETSC_DESCRIPTION "brain shift by the solvers of PETSc
 The program that brain_shift --solver petsc runs.
 ${about}")
if(TARGET Mixed_mesh_3_python)
  get_target_property(version Mixed_mesh_3_python PYTHON_VERSION)
  string(REPLACE "." ";" numbers ${version})
  list(GET numbers 1 minor)
  math(EXPR minor "${minor} + 1")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "python3 (>= ${version}~), python3 (<< 3.${minor}), python3-numpy")
endif()
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-mixed-mesh-3)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "${fast_blas}")
set(CPACK_DEBIAN_PYTHON_DESCRIPTION "meshes of hexahedra, prisms, pyramids and tetrahedra (Python)
 Meshes of surfaces, images of labels and arrays, linear elasticity, and pages
 that show them.
 ${about}")

# What Debian wants of each package: the license, and what has changed.
find_program(GZIP_PROGRAM gzip)
if(GZIP_PROGRAM)
  foreach(license MIT BSD-3-Clause) # as Debian writes them: indented, without empty lines
    file(READ ${PROJECT_SOURCE_DIR}/LICENSES/${license}.txt text)
    string(REGEX REPLACE "\n+$" "" text "${text}")
    string(REPLACE "\n\n" "\n.\n" text "${text}")
    string(REPLACE "\n" "\n " ${license}_TEXT " ${text}")
  endforeach()
  string(TIMESTAMP DATE "%a, %d %b %Y 00:00:00 +0000" UTC) # of SOURCE_DATE_EPOCH, if that is set
  configure_file(cmake/debian/copyright.in debian/copyright @ONLY)
  foreach(package ${packages})
    string(TOUPPER ${package} variable)
    set(PACKAGE ${CPACK_DEBIAN_${variable}_PACKAGE_NAME})
    set(folder ${PROJECT_BINARY_DIR}/debian/${PACKAGE})
    configure_file(cmake/debian/changelog.in ${folder}/changelog @ONLY)
    execute_process(COMMAND ${GZIP_PROGRAM} --best --no-name --force ${folder}/changelog)
    install(FILES ${PROJECT_BINARY_DIR}/debian/copyright ${folder}/changelog.gz
            DESTINATION ${CMAKE_INSTALL_DATAROOTDIR}/doc/${PACKAGE} COMPONENT ${package} EXCLUDE_FROM_ALL)
  endforeach()
endif()

include(CPack)
