# C code for packing and unpacking the wire's frames, made from the DBC when building.
find_program(CANTOOLS cantools HINTS ${PROJECT_SOURCE_DIR}/.venv/bin REQUIRED)

set(OCTET_DBC ${PROJECT_SOURCE_DIR}/hal/protocol/octet.dbc)
set(OCTET_GENERATED ${PROJECT_BINARY_DIR}/generated)
file(MAKE_DIRECTORY ${OCTET_GENERATED})
add_custom_command(
  OUTPUT ${OCTET_GENERATED}/octet.c ${OCTET_GENERATED}/octet.h
  COMMAND ${CANTOOLS} generate_c_source --no-floating-point-numbers --database-name octet ${OCTET_DBC}
  WORKING_DIRECTORY ${OCTET_GENERATED}
  DEPENDS ${OCTET_DBC}
  COMMENT "Generating the wire's C code from octet.dbc"
  VERBATIM)

# The hash that both sides compare: the first two bytes of the file's SHA-256.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${OCTET_DBC})
file(SHA256 ${OCTET_DBC} OCTET_DBC_SHA256)
string(SUBSTRING ${OCTET_DBC_SHA256} 0 4 OCTET_DBC_HASH)
