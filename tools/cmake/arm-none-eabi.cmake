# The compiler, for every Cortex-M. A core's file includes this one and adds its own flags.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR arm)
set(CMAKE_C_COMPILER arm-none-eabi-gcc)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)   # linking a program would need start-up code

# Debugging information, and the call graph with each function's stack, which tools/size reads. Link-time optimization
# in one partition takes a fifth less flash and gives one call graph.
set(CMAKE_C_FLAGS_INIT "-mthumb -ffunction-sections -fdata-sections -fno-common -g -fcallgraph-info=su -flto -fno-fat-lto-objects")
set(CMAKE_EXE_LINKER_FLAGS_INIT "-nostartfiles -flto-partition=one --specs=nano.specs -Wl,--gc-sections -Wl,--fatal-warnings")
