# SQLite::SQLite; the header is <sqlite3.h>. By pkg-config's hints, then a search: CMake's own FindSQLite3 names its target differently from
# version to version.
include(FindPackageHandleStandardArgs)

find_package(PkgConfig QUIET)
if(PkgConfig_FOUND)
    pkg_check_modules(PC_SQLite QUIET sqlite3)
endif()
find_path(SQLite_INCLUDE_DIR sqlite3.h HINTS ${PC_SQLite_INCLUDE_DIRS})
find_library(SQLite_LIBRARY sqlite3 HINTS ${PC_SQLite_LIBRARY_DIRS})
mark_as_advanced(SQLite_INCLUDE_DIR SQLite_LIBRARY)
find_package_handle_standard_args(SQLite REQUIRED_VARS SQLite_LIBRARY SQLite_INCLUDE_DIR)
if(SQLite_FOUND AND NOT TARGET SQLite::SQLite)
    add_library(SQLite::SQLite UNKNOWN IMPORTED)
    set_target_properties(SQLite::SQLite PROPERTIES
        IMPORTED_LOCATION "${SQLite_LIBRARY}" INTERFACE_INCLUDE_DIRECTORIES "${SQLite_INCLUDE_DIR}")
endif()
