# Cortex-M0+ without an operating system; start-up code of the micro:bit (a Cortex-M0, the same instructions), which QEMU has.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)
set(CMAKE_C_FLAGS_INIT "-mcpu=cortex-m0plus -mthumb -ffunction-sections -fdata-sections")
set(HCI_BOARD_SOURCES "${CMAKE_CURRENT_LIST_DIR}/microbit.c")
set(HCI_BOARD_LINK -nostartfiles --specs=rdimon.specs -T "${CMAKE_CURRENT_LIST_DIR}/microbit.ld" -Wl,--gc-sections)
