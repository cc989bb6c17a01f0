# SPDX-License-Identifier: GPL-3.0-or-later
#
# ccache, if it is there, keeps what was compiled: nothing is compiled twice, in another branch, tree or clone
# either. Paths below the source folder become relative to the build directory, so that clones in other folders
# share what they compile. Off by -DMIXED_MESH_3_USE_CCACHE=OFF, by the environment NO_CCACHE=1, or by a
# CMAKE_CXX_COMPILER_LAUNCHER of your own.

option(MIXED_MESH_3_USE_CCACHE "Compile by ccache, if it is found" ON)
find_program(CCACHE ccache)
mark_as_advanced(CCACHE)
if(MIXED_MESH_3_USE_CCACHE AND CCACHE AND NOT "$ENV{NO_CCACHE}" AND NOT DEFINED CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
                                  CCACHE_NOHASHDIR=1 ${CCACHE})
  # Sources that are compiled as one include each other by whole paths, which assertions must not print, then.
  if(CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    add_compile_options(-fmacro-prefix-map=${PROJECT_SOURCE_DIR}/=)
  endif()
endif()
