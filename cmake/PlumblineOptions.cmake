# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later

# plumbline_fp: the floating-point rules that make results.json the same bytes everywhere.
#   -ffp-contract=off   no fused multiply-add: it exists on some x86-64 levels only, and rounds differently.
#   no -ffast-math, no -march: the reader of a diff must not wonder which bits a machine chose.
#   -fno-math-errno     lets sqrt be one instruction; sqrt is correctly rounded by IEEE 754, so no bit moves.
add_library(plumbline_fp INTERFACE)
target_compile_options(plumbline_fp INTERFACE -ffp-contract=off -fno-math-errno)

# plumbline_warnings: for our own sources only, never exported.
add_library(plumbline_warnings INTERFACE)
target_compile_options(plumbline_warnings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor
                                                    -Wold-style-cast -Werror
                                                    # gcc 12 -O3 sees overlaps and lengths in std::string that cannot
                                                    # be (GCC bugs 105651, 105329); more so from a precompiled header
                                                    $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict -Wno-stringop-overflow
                                                    -Wno-array-bounds>)
if(PLUMBLINE_SANITIZE)
  target_compile_options(plumbline_fp INTERFACE -fsanitize=${PLUMBLINE_SANITIZE} -fno-omit-frame-pointer
                                                -fno-sanitize-recover=all
                                                # CGAL's arrangement casts its records to the handles' classes
                                                # (Arrangement_2_iterators.h): sound, but not to this check.
                                                -fno-sanitize=vptr)
  target_link_options(plumbline_fp INTERFACE -fsanitize=${PLUMBLINE_SANITIZE})
  # Sanitizers' checks split the paths that gcc's flow analysis needs: it then warns of what cannot be.
  target_compile_options(plumbline_warnings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endif()

# A hundred programs to link: gold, of the same binutils, takes a third of the time.
if(PROJECT_IS_TOP_LEVEL)
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold PLUMBLINE_HAS_GOLD)
  if(PLUMBLINE_HAS_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()

# plumbline_precompile(<target> [headers…]): what nearly every source includes is parsed once a target, not once a source;
# a quarter of all building. The tidy preset does without: a source that leans on it is a remark there.
option(PLUMBLINE_PRECOMPILE "Precompile the standard headers that most sources include" ON)
function(plumbline_precompile target)
  if(PLUMBLINE_PRECOMPILE)
    target_precompile_headers(${target} PRIVATE <algorithm> <array> <cmath> <cstddef> <cstdint> <filesystem> <functional>
                                                <map> <memory> <string> <string_view> <utility> <vector> <fmt/format.h>
                                                ${ARGN})
  endif()
endfunction()
if(PLUMBLINE_PRECOMPILE)
  # So that ccache can tell whether a precompiled header changed.
  add_compile_options($<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess>
                      "$<$<CXX_COMPILER_ID:Clang>:SHELL:-Xclang -fno-pch-timestamp>")
endif()

# plumbline_library(<folder> SOURCES … HEADERS … LINKS … PRIVATE_LINKS …): one static library per folder, alias
# plumbline::<folder>. HEADERS are the public ones: they are installed, and script/package holds them to their rules.
# All libraries are installed, and plumbline::plumbline links them; in PRIVATE_LINKS, what is only headers or only
# objects stands inside $<BUILD_INTERFACE:…>, so that users need not have it.
function(plumbline_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;HEADERS;LINKS;PRIVATE_LINKS" ${ARGN})
  add_library(plumbline_${name} STATIC ${ARG_SOURCES})
  add_library(plumbline::${name} ALIAS plumbline_${name})
  target_compile_features(plumbline_${name} PUBLIC cxx_std_20)
  # Sources include each other from the root: "oracle/conformity.h".
  target_include_directories(plumbline_${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
                                                      $<INSTALL_INTERFACE:include/plumbline>)
  target_link_libraries(plumbline_${name} PUBLIC plumbline_fp ${ARG_LINKS} PRIVATE ${ARG_PRIVATE_LINKS}
                                          $<BUILD_INTERFACE:plumbline_warnings>)
  target_sources(plumbline_${name} PUBLIC FILE_SET HEADERS BASE_DIRS ${PROJECT_SOURCE_DIR} FILES ${ARG_HEADERS})
  plumbline_precompile(plumbline_${name})
  set_target_properties(plumbline_${name} PROPERTIES EXPORT_NAME ${name})
  set_property(GLOBAL APPEND PROPERTY PLUMBLINE_LIBRARIES plumbline_${name})
endfunction()
