# SPDX-License-Identifier: GPL-3.0-or-later
#
# The target doc: the manual, in doc/index.html of the build directory.

find_program(DOXYGEN doxygen)
find_program(DEBIAN_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
mark_as_advanced(DOXYGEN DEBIAN_PYTHON)
if(NOT DOXYGEN OR NOT DEBIAN_PYTHON)
  return()
endif()

set(doxyfile ${PROJECT_BINARY_DIR}/Doxyfile)
set(tagfile ${PROJECT_BINARY_DIR}/doc_tags.xml)
file(WRITE ${doxyfile} "@INCLUDE = Doxyfile.in\nOUTPUT_DIRECTORY = \"${PROJECT_BINARY_DIR}\"\n"
                       "GENERATE_TAGFILE = \"${tagfile}\"\n")
file(GLOB descriptions CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/doc/*/PackageDescription.txt)
add_custom_target(doc
  COMMAND ${DOXYGEN} ${doxyfile}
  COMMAND ${DEBIAN_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/check_reference.py ${tagfile} ${descriptions}
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/doc/Mixed_mesh_3 VERBATIM)
