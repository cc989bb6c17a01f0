# SPDX-License-Identifier: GPL-3.0-or-later
#
# Where doxygen is not there, the target doc says how it comes, and fails.
#   cmake -D SOURCE=... -D WORK=... -P test_manual.cmake

file(REMOVE_RECURSE ${WORK})
file(WRITE ${WORK}/CMakeLists.txt "cmake_minimum_required(VERSION 3.18)\nproject(manual LANGUAGES NONE)\n"
                                  "include(${SOURCE}/cmake/Manual.cmake)\n")
# An empty name is not searched for, whatever is installed.
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK} -B ${WORK}/build -DDOXYGEN= RESULT_VARIABLE status OUTPUT_QUIET)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "the project without doxygen cannot be configured")
endif()
execute_process(COMMAND ${CMAKE_COMMAND} --build ${WORK}/build --target doc RESULT_VARIABLE status
                OUTPUT_VARIABLE told ERROR_VARIABLE told)
if(status EQUAL 0 OR NOT told MATCHES "apt install doxygen.*cmake ${WORK}/build")
  message(FATAL_ERROR "the target doc, without doxygen, ended with ${status} and:\n${told}")
endif()
