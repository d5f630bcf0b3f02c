# SuiteSparse::UMFPACK, SuiteSparse::SPQR, SuiteSparse::CHOLMOD and SuiteSparse::SuiteSparseConfig.
# Newer SuiteSparse exports these targets itself; for 5.x, which has no CMake config, they are made here.
include(FindPackageHandleStandardArgs)

find_package(UMFPACK CONFIG QUIET)
find_package(SPQR CONFIG QUIET)
find_package(CHOLMOD CONFIG QUIET)
find_package(SuiteSparse_config CONFIG QUIET)
if(TARGET SuiteSparse::UMFPACK AND TARGET SuiteSparse::SPQR AND TARGET SuiteSparse::CHOLMOD
   AND TARGET SuiteSparse::SuiteSparseConfig)
    find_package_handle_standard_args(SuiteSparse REQUIRED_VARS UMFPACK_DIR SPQR_DIR CHOLMOD_DIR)
    return()
endif()

find_path(SuiteSparse_INCLUDE_DIR umfpack.h PATH_SUFFIXES suitesparse)
find_library(SuiteSparse_UMFPACK_LIBRARY umfpack)
find_library(SuiteSparse_SPQR_LIBRARY spqr)
find_library(SuiteSparse_CHOLMOD_LIBRARY cholmod)
find_library(SuiteSparse_SuiteSparseConfig_LIBRARY suitesparseconfig)
mark_as_advanced(SuiteSparse_INCLUDE_DIR SuiteSparse_UMFPACK_LIBRARY SuiteSparse_SPQR_LIBRARY SuiteSparse_CHOLMOD_LIBRARY
                 SuiteSparse_SuiteSparseConfig_LIBRARY)
find_package_handle_standard_args(SuiteSparse REQUIRED_VARS SuiteSparse_UMFPACK_LIBRARY SuiteSparse_SPQR_LIBRARY
                                  SuiteSparse_CHOLMOD_LIBRARY SuiteSparse_SuiteSparseConfig_LIBRARY
                                  SuiteSparse_INCLUDE_DIR)

if(SuiteSparse_FOUND)
    foreach(name IN ITEMS UMFPACK SPQR CHOLMOD SuiteSparseConfig)
        if(NOT TARGET SuiteSparse::${name})
            add_library(SuiteSparse::${name} UNKNOWN IMPORTED)
            set_target_properties(SuiteSparse::${name} PROPERTIES
                IMPORTED_LOCATION "${SuiteSparse_${name}_LIBRARY}"
                INTERFACE_INCLUDE_DIRECTORIES "${SuiteSparse_INCLUDE_DIR}")
        endif()
    endforeach()
endif()
