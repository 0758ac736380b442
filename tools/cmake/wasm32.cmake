# The compiler for web pages: Debian's clang and lld, with the mathematics of its wasi-libc. Nothing is asked of the browser.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_SYSROOT /usr)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)   # a program would want a start-up

set(CMAKE_C_FLAGS_INIT "-ffp-contract=off")
# GNU ar, which is what CMake takes where there is no llvm-ar, makes no index of such objects: take them without one.
set(CMAKE_C_STANDARD_LIBRARIES_INIT "-Wl,--no-whole-archive -lc")
set(CMAKE_EXE_LINKER_FLAGS_INIT
  "-nostartfiles -nodefaultlibs -Wl,--no-entry -Wl,--strip-all -Wl,--fatal-warnings -Wl,-z,stack-size=65536 -Wl,--whole-archive")
