# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later

# plumbline::plumbline: all libraries at once, in the build as when installed.
get_property(libraries GLOBAL PROPERTY PLUMBLINE_LIBRARIES)
add_library(plumbline_everything INTERFACE)
add_library(plumbline::plumbline ALIAS plumbline_everything)
target_link_libraries(plumbline_everything INTERFACE ${libraries})
set_target_properties(plumbline_everything PROPERTIES EXPORT_NAME plumbline)
set_target_properties(plumbline_fp PROPERTIES EXPORT_NAME fp)

# What `cmake --install` copies, and no test: cmake --build … --target plumbline_installable
add_custom_target(plumbline_installable DEPENDS plumbline ${libraries})

if(NOT PLUMBLINE_INSTALL)
  return()
endif()
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/plumbline)

# The program is exported too, as plumbline::program, for custom commands.
install(TARGETS plumbline plumbline_everything plumbline_fp ${libraries} EXPORT plumbline
        FILE_SET HEADERS DESTINATION include/plumbline)
install(EXPORT plumbline NAMESPACE plumbline:: FILE plumbline-targets.cmake DESTINATION ${package_folder})
configure_package_config_file(cmake/plumbline-config.cmake.in ${PROJECT_BINARY_DIR}/plumbline-config.cmake
                              INSTALL_DESTINATION ${package_folder})
# Below 1.0 a minor version may change the library (docs/library.md says what stays).
write_basic_package_version_file(${PROJECT_BINARY_DIR}/plumbline-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/plumbline-config.cmake ${PROJECT_BINARY_DIR}/plumbline-config-version.cmake
              cmake/plumbline-numbers.cmake
        DESTINATION ${package_folder})

# As in the source tree, side by side: suites name their assets by a path relative to themselves.
install(DIRECTORY scenarios/assets scenarios/suites DESTINATION share/plumbline)
install(FILES LICENSE DESTINATION share/doc/plumbline)
