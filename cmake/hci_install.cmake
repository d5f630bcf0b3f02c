# Libraries, headers, program, CMake package (components core and host) and pkg-config files; all relocatable.
include(CMakePackageConfigHelpers)

set(package_dir "${CMAKE_INSTALL_LIBDIR}/cmake/hci")
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

if(HCI_WITH_HOST)
    install(DIRECTORY include/hci/host DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/hci" COMPONENT host
            FILES_MATCHING PATTERN "*.h")
    install(TARGETS hci_host EXPORT hciHostTargets ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}" COMPONENT host)
    install(EXPORT hciHostTargets NAMESPACE hci:: DESTINATION "${package_dir}" COMPONENT host)
    install(FILES cmake/FindSuiteSparse.cmake cmake/FindcJSON.cmake DESTINATION "${package_dir}" COMPONENT host)
    install(TARGETS hci-solve RUNTIME DESTINATION "${CMAKE_INSTALL_BINDIR}" COMPONENT program)
    hci_install_pc(hci-host host)
endif()
