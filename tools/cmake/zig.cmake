# Zig as a cross-compiler for tools/wheels, which sets OCTET_ZIG, the program; OCTET_TARGET, Zig's name of the target;
# and OCTET_SYSTEM, CMake's name of the system.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES OCTET_ZIG OCTET_TARGET OCTET_SYSTEM)
set(CMAKE_SYSTEM_NAME ${OCTET_SYSTEM})
set(CMAKE_C_COMPILER ${OCTET_ZIG} cc -target ${OCTET_TARGET})
# The host's ar makes no index of another system's objects.
set(CMAKE_C_ARCHIVE_CREATE "${OCTET_ZIG} ar qc <TARGET> <OBJECTS>")
set(CMAKE_C_ARCHIVE_FINISH "${OCTET_ZIG} ranlib <TARGET>")
foreach(kind EXE SHARED)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT -s)   # strip all symbols that are not exported
endforeach()
