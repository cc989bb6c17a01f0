# SPDX-License-Identifier: GPL-3.0-or-later
#
# The target doc: the manual, in doc/index.html of the build directory. Without doxygen, the target tells how it comes.

find_program(DOXYGEN doxygen)
find_program(DEBIAN_PYTHON python3 PATHS /usr/bin NO_DEFAULT_PATH)
# Formulas are typeset by MathJax: that of this system, which needs no network, or else that of the net.
find_path(MATHJAX MathJax.js PATHS /usr/share/javascript/mathjax /usr/share/mathjax NO_DEFAULT_PATH)
mark_as_advanced(DOXYGEN DEBIAN_PYTHON MATHJAX)
if(NOT DOXYGEN OR NOT DEBIAN_PYTHON)
  add_custom_target(doc
    COMMAND ${CMAKE_COMMAND} -E echo "The manual needs doxygen and Debian's python3, which were not there when cmake ran."
    COMMAND ${CMAKE_COMMAND} -E echo "Install them (apt install doxygen libjs-mathjax python3), then: cmake ${PROJECT_BINARY_DIR}"
    COMMAND ${CMAKE_COMMAND} -E false
    VERBATIM)
  return()
endif()

# Once to read, and once with what has no documentation, for the script that looks for it.
set(doxyfile ${PROJECT_BINARY_DIR}/Doxyfile)
set(names ${PROJECT_BINARY_DIR}/Doxyfile_names)
file(WRITE ${doxyfile} "@INCLUDE = Doxyfile.in\nOUTPUT_DIRECTORY = \"${PROJECT_BINARY_DIR}\"\n")
if(MATHJAX)
  file(APPEND ${doxyfile} "MATHJAX_RELPATH = ${MATHJAX}\n")
endif()
file(WRITE ${names} "@INCLUDE = \"${doxyfile}\"\nGENERATE_HTML = NO\nGENERATE_XML = YES\nXML_OUTPUT = doc_names\n"
                    "XML_PROGRAMLISTING = NO\nEXTRACT_ALL = YES\nHIDE_UNDOC_MEMBERS = NO\n"
                    "HIDE_UNDOC_CLASSES = NO\nWARNINGS = NO\nWARN_AS_ERROR = NO\n")
file(GLOB descriptions CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/doc/*/PackageDescription.txt)
add_custom_target(doc
  COMMAND ${DOXYGEN} ${doxyfile}
  # There is nothing to include for a concept, nor below internal/.
  COMMAND sh -c "sed -i -e '/^<p><code>#include &lt;Concepts/d' -e '/^<p><code>#include &lt;CGAL.*.internal./d' \
                     ${PROJECT_BINARY_DIR}/doc/class*.html ${PROJECT_BINARY_DIR}/doc/struct*.html"
  COMMAND ${CMAKE_COMMAND} -E rm -rf ${PROJECT_BINARY_DIR}/doc_names
  COMMAND ${DOXYGEN} ${names}
  COMMAND ${DEBIAN_PYTHON} ${PROJECT_SOURCE_DIR}/scripts/check_reference.py ${PROJECT_BINARY_DIR}/doc_names
          ${descriptions}
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}/doc/Mixed_mesh_3 VERBATIM)
