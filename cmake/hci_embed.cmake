# Run as `cmake -DROOT=... -DOUT=... -P`: the sources that an FMU consists of, as arrays of bytes in one C file. All of them
# lie in one folder there, so that any compiler finds them without options: a/b.h becomes a_b.h, and so in #include lines.
cmake_minimum_required(VERSION 3.25)

file(GLOB_RECURSE files LIST_DIRECTORIES FALSE RELATIVE "${ROOT}" "${ROOT}/src/core/*.[ch]" "${ROOT}/src/fmu/*.[ch]"
     "${ROOT}/include/hci/math/*.h" "${ROOT}/include/hci/machine/*.h" "${ROOT}/include/hci/drive/*.h" "${ROOT}/include/hci/effects/*.h")
list(APPEND files include/hci/status.h include/hci/table.h include/hci/loop.h)
list(FILTER files EXCLUDE REGEX "core/math/(lu|lu_accuracy|orthogonal)\\.c$")
list(SORT files)

set(arrays "")
set(entries "")
set(number 0)
foreach(path IN LISTS files)
    file(READ "${ROOT}/${path}" text)
    foreach(depth RANGE 2)
        string(REGEX REPLACE "(#include \"[^\"\n/]*)/" "\\1_" text "${text}")
    endforeach()
    string(REGEX REPLACE "^(src|include)/" "" name "${path}")
    string(REPLACE "/" "_" name "${name}")
    string(HEX "${text}" bytes)
    string(REGEX REPLACE "(..)" "0x\\1," bytes "${bytes}")
    string(APPEND arrays "static const unsigned char FILE_${number}[] = {${bytes}};\n")
    string(APPEND entries "    {\"${name}\", FILE_${number}, sizeof FILE_${number}},\n")
    math(EXPR number "${number} + 1")
endforeach()
file(WRITE "${OUT}" "#include \"host/fmu/sources.h\"\n\n${arrays}\nconst hci_fmu_source hci_fmu_sources[] = {\n${entries}};\n"
     "const size_t hci_fmu_source_count = ${number};\n")
