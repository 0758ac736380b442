# The core of an STM32F405 or an STM32G431. Its floating-point unit stays off: the robot uses integers only.
include(${CMAKE_CURRENT_LIST_DIR}/arm-none-eabi.cmake)
string(APPEND CMAKE_C_FLAGS_INIT " -mcpu=cortex-m4 -mfloat-abi=soft")
