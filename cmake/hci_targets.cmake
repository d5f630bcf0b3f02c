# What every target of this project has in common.

# Clang's -Wdouble-promotion objects to `double x = INFINITY`, too.
set(HCI_WARNINGS
    -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wsign-conversion $<$<C_COMPILER_ID:GNU>:-Wdouble-promotion>
    -Wstrict-prototypes -Wmissing-prototypes -Wcast-qual -Wvla)

# Without contraction a·b + c is rounded twice on every machine, so results do not depend on whether it has an FMA unit.
set(HCI_ARITHMETIC -ffp-contract=off)

function(hci_target_defaults target)
    set_target_properties(${target} PROPERTIES C_STANDARD 99 C_STANDARD_REQUIRED ON C_EXTENSIONS OFF)
    target_compile_options(${target} PRIVATE ${HCI_WARNINGS} ${HCI_ARITHMETIC})
    if(HCI_WERROR)
        target_compile_options(${target} PRIVATE -Werror)
    endif()
endfunction()

# A static library hci::<name> from the *.c of the current folder, with its public headers.
function(hci_add_library name)
    file(GLOB_RECURSE sources CONFIGURE_DEPENDS *.c)
    add_library(hci_${name} STATIC ${sources})
    add_library(hci::${name} ALIAS hci_${name})
    set_target_properties(hci_${name} PROPERTIES EXPORT_NAME ${name} LINKER_LANGUAGE C)
    target_include_directories(hci_${name}
        PUBLIC "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>" "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>"
        PRIVATE "${PROJECT_SOURCE_DIR}/src")
    hci_target_defaults(hci_${name})
endfunction()

# A program <name> of one source, which may use private headers: linked with hci::cli if it includes a header of cli, with
# hci::host if one of host, with hci::core otherwise. HCI_LAYER is set to the layer; no program is made where that layer is
# not built.
function(hci_add_program name source)
    file(STRINGS ${source} host_includes REGEX "^#include \".*host/")
    file(STRINGS ${source} cli_includes REGEX "^#include \"cli/")
    set(layer core)
    if(cli_includes)
        set(layer cli)
    elseif(host_includes OR source MATCHES "/tests/host/") # or by a header of tests/support
        set(layer host)
    endif()
    set(HCI_LAYER ${layer} PARENT_SCOPE)
    if(TARGET hci::${layer})
        add_executable(${name} ${source})
        target_link_libraries(${name} PRIVATE hci::${layer})
        target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}/src")
        hci_target_defaults(${name})
    endif()
endfunction()

# Sets HCI_WITH_HOST: ON demands SuiteSparse, cJSON and SQLite, AUTO takes them where they are.
macro(hci_decide_host)
    set(HCI_WITH_HOST OFF)
    if(HCI_BUILD_HOST STREQUAL "AUTO")
        find_package(SuiteSparse QUIET)
        find_package(cJSON QUIET)
        find_package(SQLite QUIET)
        if(SuiteSparse_FOUND AND cJSON_FOUND AND SQLite_FOUND)
            set(HCI_WITH_HOST ON)
        else()
            message(STATUS "hci: SuiteSparse, cJSON or SQLite not found, building hci::core alone")
        endif()
    elseif(HCI_BUILD_HOST)
        find_package(SuiteSparse REQUIRED)
        find_package(cJSON REQUIRED)
        find_package(SQLite REQUIRED)
        set(HCI_WITH_HOST ON)
    endif()
endmacro()
