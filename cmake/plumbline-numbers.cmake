# SPDX-FileCopyrightText: The plumbline authors
# SPDX-License-Identifier: GPL-3.0-or-later

# MPFR and GMP as targets: neither brings a CMake file. Read by plumbline's own build and by its installed package.
foreach(library mpfr gmp)
  if(NOT TARGET plumbline::${library})
    find_library(PLUMBLINE_${library}_LIBRARY ${library} REQUIRED)
    mark_as_advanced(PLUMBLINE_${library}_LIBRARY)
    add_library(plumbline::${library} UNKNOWN IMPORTED)
    set_target_properties(plumbline::${library} PROPERTIES IMPORTED_LOCATION ${PLUMBLINE_${library}_LIBRARY})
  endif()
endforeach()
