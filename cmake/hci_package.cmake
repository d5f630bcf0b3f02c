# `cpack` in the build folder makes hci-solve_VERSION_ARCH.deb and hci-solve-VERSION-SYSTEM-ARCH.tar.gz.
set(CPACK_GENERATOR "DEB;TGZ")
set(CPACK_PACKAGE_NAME hci-solve)
set(CPACK_PACKAGE_VENDOR "hci-solve developers")
set(CPACK_PACKAGE_CONTACT "hci-solve developers <hci-solve@example.org>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "harmonic currents for permanent-magnet motors with a wanted torque")
set(CPACK_PACKAGE_DESCRIPTION
"From the back-EMF and cogging torque of a permanent-magnet synchronous motor
and a wanted torque to the harmonic phase currents that produce it, verified,
and to the C tables of its controller; from recordings to the physical effect
that the model of the motor lacks. With the C libraries hci::core, which needs
libm alone, and hci::host, for CMake and pkg-config.")
set(CPACK_RESOURCE_FILE_LICENSE "${PROJECT_SOURCE_DIR}/LICENSE")
set(CPACK_SYSTEM_NAME "${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR}")
set(CPACK_PACKAGE_CHECKSUM SHA256)
set(CPACK_STRIP_FILES ON)
set(CPACK_VERBATIM_VARIABLES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_PRE_BUILD_SCRIPTS "${PROJECT_SOURCE_DIR}/cmake/hci_package_files.cmake")

set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What programs linked with hci::host need.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libsuitesparse-dev, libcjson-dev, libsqlite3-dev")
include(CPack)
