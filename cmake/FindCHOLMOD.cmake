# Finds CHOLMOD, the sparse Cholesky factorisation of SuiteSparse, and defines
#   pyrod::cholmod   headers and libraries; #include <cholmod.h>
#   CHOLMOD_FOUND, CHOLMOD_VERSION
# Elsewhere than in the usual places: set CHOLMOD_ROOT or CMAKE_PREFIX_PATH.
#
# SuiteSparse 7 brings a CMake package of its own, which finds OpenMP and so works only in projects
# with LANGUAGES C. SuiteSparse 5 (Debian 12) brings none. Without it, headers and shared library are
# searched for. The target is ours in any case: the names of SuiteSparse's targets differ between
# systems, and an exported pyrod::pyrod must not depend on those of the machine it was built on.

include(FindPackageHandleStandardArgs)

block(PROPAGATE CHOLMOD_VERSION) # lest the inner call takes over REQUIRED and the version
  unset(CHOLMOD_FIND_MODULE)
  unset(CHOLMOD_FIND_REQUIRED)
  find_package(CHOLMOD CONFIG QUIET)
endblock()
foreach(name IN ITEMS SuiteSparse::CHOLMOD SuiteSparse::CHOLMOD_static)
  if(TARGET ${name})
    set(CHOLMOD_TARGET ${name})
    break()
  endif()
endforeach()

if(CHOLMOD_TARGET)
  # The memory hooks live in SuiteSparseConfig, which a shared CHOLMOD does not pass on.
  set(CHOLMOD_LINK ${CHOLMOD_TARGET})
  foreach(name IN ITEMS SuiteSparse::SuiteSparseConfig SuiteSparse::SuiteSparseConfig_static)
    if(TARGET ${name})
      list(APPEND CHOLMOD_LINK ${name})
      break()
    endif()
  endforeach()
  find_package_handle_standard_args(CHOLMOD
    REQUIRED_VARS CHOLMOD_TARGET
    VERSION_VAR CHOLMOD_VERSION)
else()
  unset(CHOLMOD_VERSION)
  find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
  find_library(CHOLMOD_LIBRARY cholmod)
  find_library(SUITESPARSECONFIG_LIBRARY suitesparseconfig)
  mark_as_advanced(CHOLMOD_INCLUDE_DIR CHOLMOD_LIBRARY SUITESPARSECONFIG_LIBRARY)
  set(CHOLMOD_LINK ${CHOLMOD_LIBRARY} ${SUITESPARSECONFIG_LIBRARY})
  if(CHOLMOD_LIBRARY MATCHES "\\.a$") # which does not tell what it needs itself
    set(CHOLMOD_LINK ${CHOLMOD_LIBRARY})
    foreach(name IN ITEMS amd colamd camd ccolamd suitesparseconfig)
      find_library(CHOLMOD_${name}_LIBRARY ${name})
      list(APPEND CHOLMOD_LINK ${CHOLMOD_${name}_LIBRARY})
      mark_as_advanced(CHOLMOD_${name}_LIBRARY)
    endforeach()
    block(PROPAGATE CHOLMOD_LINK) # not of SuiteSparse, and shared: those have needs of their own
      set(CMAKE_FIND_LIBRARY_SUFFIXES .so .a)
      foreach(name IN ITEMS metis lapack blas gomp) # some CHOLMODs do without
        find_library(CHOLMOD_${name}_LIBRARY NAMES ${name} lib${name}.so.5 lib${name}.so.1)
        mark_as_advanced(CHOLMOD_${name}_LIBRARY)
        if(CHOLMOD_${name}_LIBRARY)
          list(APPEND CHOLMOD_LINK ${CHOLMOD_${name}_LIBRARY})
        endif()
      endforeach()
    endblock()
    list(APPEND CHOLMOD_LINK m)
  endif()

  foreach(header IN ITEMS cholmod_core.h cholmod.h) # CHOLMOD 3 and 4, then 5
    if(EXISTS "${CHOLMOD_INCLUDE_DIR}/${header}" AND NOT CHOLMOD_VERSION)
      file(STRINGS "${CHOLMOD_INCLUDE_DIR}/${header}" lines
        REGEX "^#define CHOLMOD_(MAIN|SUB|SUBSUB)_VERSION[ \t]+[0-9]+")
      list(TRANSFORM lines REPLACE ".*_VERSION[ \t]+([0-9]+).*" "\\1")
      list(JOIN lines "." CHOLMOD_VERSION)
    endif()
  endforeach()
  find_package_handle_standard_args(CHOLMOD
    REQUIRED_VARS CHOLMOD_LIBRARY SUITESPARSECONFIG_LIBRARY CHOLMOD_INCLUDE_DIR
    VERSION_VAR CHOLMOD_VERSION
    REASON_FAILURE_MESSAGE "On Debian and Ubuntu: apt-get install libsuitesparse-dev")
endif()

if(CHOLMOD_FOUND AND NOT TARGET pyrod::cholmod)
  add_library(pyrod::cholmod INTERFACE IMPORTED)
  target_link_libraries(pyrod::cholmod INTERFACE ${CHOLMOD_LINK})
  if(NOT CHOLMOD_TARGET)
    target_include_directories(pyrod::cholmod SYSTEM INTERFACE "${CHOLMOD_INCLUDE_DIR}")
  endif()
endif()
