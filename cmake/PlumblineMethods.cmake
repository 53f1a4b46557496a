# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later

# plumbline_add_method(<name>): compiles algorithms/<name>/*.cpp and enters `describe_<name>()` into the registry,
# in the order of the calls. There is no second list: the registry's source is written from these lines, so no
# static initialiser can be dropped by a linker.
define_property(GLOBAL PROPERTY PLUMBLINE_METHODS BRIEF_DOCS "built-in methods in registry order")

function(plumbline_add_method name)
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/*.cpp)
  if(NOT sources)
    message(FATAL_ERROR "plumbline_add_method(${name}): no sources in ${CMAKE_CURRENT_SOURCE_DIR}/${name}")
  endif()
  if(NOT EXISTS ${CMAKE_CURRENT_SOURCE_DIR}/${name}/README.md)
    message(FATAL_ERROR "plumbline_add_method(${name}): ${name}/README.md is missing (symbols, constants, promises)")
  endif()
  target_sources(plumbline_algorithms PRIVATE ${sources})
  set_property(GLOBAL APPEND PROPERTY PLUMBLINE_METHODS ${name})
endfunction()

function(plumbline_write_built_in_methods)
  get_property(methods GLOBAL PROPERTY PLUMBLINE_METHODS)
  set(declarations "")
  set(entries "")
  foreach(method IN LISTS methods)
    string(APPEND declarations "MethodDescription describe_${method}();\n")
    string(APPEND entries "      describe_${method}(),\n")
  endforeach()
  configure_file(${PROJECT_SOURCE_DIR}/cmake/built_in_methods.cpp.in ${CMAKE_CURRENT_BINARY_DIR}/built_in_methods.cpp @ONLY)
  target_sources(plumbline_algorithms PRIVATE ${CMAKE_CURRENT_BINARY_DIR}/built_in_methods.cpp)
endfunction()
