# Libraries, headers, program, CMake package (components core and host), pkg-config files, documents and example data; all relocatable.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/hci")
set(doc_dir "${CMAKE_INSTALL_DATAROOTDIR}/doc/hci-solve")
set(generated "${PROJECT_BINARY_DIR}/package")

install(DIRECTORY include/hci DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}" COMPONENT core
        FILES_MATCHING PATTERN "*.h" PATTERN "host" EXCLUDE)
install(TARGETS hci_core EXPORT hciCoreTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT core)
install(EXPORT hciCoreTargets NAMESPACE hci:: DESTINATION "${package_dir}" COMPONENT core)

configure_package_config_file(cmake/hciConfig.cmake.in "${generated}/hciConfig.cmake" INSTALL_DESTINATION "${package_dir}" NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file("${generated}/hciConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${generated}/hciConfig.cmake" "${generated}/hciConfigVersion.cmake"
        DESTINATION "${package_dir}" COMPONENT core)

# The way from the .pc file up to the prefix, so that a moved tree still works.
file(RELATIVE_PATH HCI_PC_TO_PREFIX "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
function(hci_install_pc name component)
    configure_file("cmake/${name}.pc.in" "${generated}/${name}.pc" @ONLY)
    install(FILES "${generated}/${name}.pc" DESTINATION "${CMAKE_INSTALL_LIBDIR}/pkgconfig" COMPONENT ${component})
endfunction()
hci_install_pc(hci-core core)

install(FILES LICENSE cmake/copyright DESTINATION "${doc_dir}" COMPONENT core)

if(HCI_WITH_HOST)
    install(DIRECTORY include/hci/host DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/hci" COMPONENT host
            FILES_MATCHING PATTERN "*.h")
    install(TARGETS hci_host EXPORT hciHostTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT host)
    install(EXPORT hciHostTargets NAMESPACE hci:: DESTINATION "${package_dir}" COMPONENT host)
    install(FILES cmake/FindSuiteSparse.cmake cmake/FindcJSON.cmake cmake/FindSQLite.cmake DESTINATION "${package_dir}" COMPONENT host)
    hci_install_pc(hci-host host)

    # Documents, data and examples lie as in the sources, so that links and commands in them hold there, too.
    install(TARGETS hci-solve RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
    install(FILES README.md DESIGN.md CONTRIBUTING.md SECURITY.md CHANGELOG.md CITATION.cff DESTINATION "${doc_dir}" COMPONENT program)
    install(DIRECTORY docs data examples DESTINATION "${doc_dir}" COMPONENT program PATTERN "__pycache__" EXCLUDE)
    install(FILES cmake/cortex-m4.cmake DESTINATION "${doc_dir}/cmake" COMPONENT program)
endif()

# What the program says of itself, asked of the program that was just built.
function(hci_install_reference kind folder name)
    add_custom_command(OUTPUT "${generated}/${name}"
                       COMMAND "${CMAKE_COMMAND}" -E env --unset=COLUMNS ASAN_OPTIONS=detect_leaks=0 $<TARGET_FILE:hci-solve> reference ${kind} > "${generated}/${name}"
                       DEPENDS hci-solve VERBATIM)
    add_custom_target(hci_reference_${kind} ALL DEPENDS "${generated}/${name}")
    install(FILES "${generated}/${name}" DESTINATION "${folder}" COMPONENT program)
endfunction()
if(HCI_WITH_HOST AND PROJECT_IS_TOP_LEVEL AND NOT CMAKE_CROSSCOMPILING)
    hci_install_reference(man "${CMAKE_INSTALL_MANDIR}/man1" hci-solve.1)
    hci_install_reference(bash "${CMAKE_INSTALL_DATAROOTDIR}/bash-completion/completions" hci-solve)
    hci_install_reference(zsh "${CMAKE_INSTALL_DATAROOTDIR}/zsh/site-functions" _hci-solve)
endif()
