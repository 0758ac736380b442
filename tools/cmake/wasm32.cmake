# The compiler for web pages: Debian's clang and lld, with wasi-libc's math functions. The module has no imports.
set(CMAKE_SYSTEM_NAME Generic)
set(CMAKE_SYSTEM_PROCESSOR wasm32)
set(CMAKE_C_COMPILER clang)
set(CMAKE_C_COMPILER_TARGET wasm32-wasi)
set(CMAKE_SYSROOT /usr)
set(CMAKE_TRY_COMPILE_TARGET_TYPE STATIC_LIBRARY)   # linking a program would need start-up code

set(CMAKE_C_FLAGS_INIT "-ffp-contract=off")
# Without llvm-ar, CMake takes GNU ar, which makes no index of wasm objects: --whole-archive needs none.
set(CMAKE_C_STANDARD_LIBRARIES_INIT "-Wl,--no-whole-archive -lc")
set(CMAKE_EXE_LINKER_FLAGS_INIT
  "-nostartfiles -nodefaultlibs -Wl,--no-entry -Wl,--strip-all -Wl,--fatal-warnings -Wl,-z,stack-size=65536 -Wl,--whole-archive")
