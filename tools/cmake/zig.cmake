# Zig as a compiler for other systems, for tools/wheels, which names OCTET_ZIG, the program, OCTET_TARGET as Zig calls it,
# and OCTET_SYSTEM as CMake does.
list(APPEND CMAKE_TRY_COMPILE_PLATFORM_VARIABLES OCTET_ZIG OCTET_TARGET OCTET_SYSTEM)
set(CMAKE_SYSTEM_NAME ${OCTET_SYSTEM})
set(CMAKE_C_COMPILER ${OCTET_ZIG} cc -target ${OCTET_TARGET})
# The host's ar makes no index of another system's objects.
set(CMAKE_C_ARCHIVE_CREATE "${OCTET_ZIG} ar qc <TARGET> <OBJECTS>")
set(CMAKE_C_ARCHIVE_FINISH "${OCTET_ZIG} ranlib <TARGET>")
foreach(kind EXE SHARED)
  set(CMAKE_${kind}_LINKER_FLAGS_INIT -s)   # no symbols but those that others look up
endforeach()
