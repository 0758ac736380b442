# The core of an STM32F103.
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
string(APPEND CMAKE_C_FLAGS_INIT " -mcpu=cortex-m3")
