# Run by cpack on the files of a package before it packs them: Debian wants man page and changelog compressed.
if(CPACK_GENERATOR STREQUAL "DEB")
    set(root "${CPACK_TEMPORARY_INSTALL_DIRECTORY}")
    file(GLOB_RECURSE man "${root}/hci-solve.1")
    file(GLOB_RECURSE changelog "${root}/CHANGELOG.md")
    file(GLOB_RECURSE license "${root}/LICENSE") # its text stands in `copyright`
    get_filename_component(folder "${changelog}" DIRECTORY)
    file(RENAME "${changelog}" "${folder}/changelog")
    execute_process(COMMAND gzip -9n "${man}" "${folder}/changelog" COMMAND_ERROR_IS_FATAL ANY)
    file(REMOVE "${license}")
endif()
