# C code that the build generates from octet.dbc and robot.toml: packing and unpacking of frames, and the robot's
# numbers and words.
find_program(CANTOOLS cantools HINTS ${PROJECT_SOURCE_DIR}/.venv/bin REQUIRED)
if(DEFINED SKBUILD)
  set(python ${Python_EXECUTABLE})   # the one that builds the wheel
else()
  get_filename_component(python ${CANTOOLS} DIRECTORY)
  set(python ${python}/python3)
endif()

set(OCTET_DBC ${PROJECT_SOURCE_DIR}/hal/protocol/octet.dbc)
set(words ${PROJECT_SOURCE_DIR}/hal/protocol/robot.toml)
set(generate ${PROJECT_SOURCE_DIR}/tools/generate)
file(GLOB generator CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/tools/robot_words/*.py)

set(OCTET_GENERATED ${PROJECT_BINARY_DIR}/generated)
file(MAKE_DIRECTORY ${OCTET_GENERATED})
add_custom_command(
  OUTPUT ${OCTET_GENERATED}/robot_words.h
  COMMAND ${python} ${generate} --c ${OCTET_GENERATED}/robot_words.h
  DEPENDS ${OCTET_DBC} ${words} ${generate} ${generator}
  COMMENT "Generating the robot's numbers and words"
  VERBATIM)

# Linking this library generates robot_words.h first, and adds its include path.
add_custom_target(octet_generate_words DEPENDS ${OCTET_GENERATED}/robot_words.h)
add_library(octet_words INTERFACE)
add_dependencies(octet_words octet_generate_words)
target_include_directories(octet_words INTERFACE ${OCTET_GENERATED})

# The hash of the messages' layout, which both sides compare: four hex digits.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${OCTET_DBC} ${words} ${generate} ${generator})
execute_process(
  COMMAND ${python} ${generate} --hash
  OUTPUT_VARIABLE OCTET_DBC_HASH OUTPUT_STRIP_TRAILING_WHITESPACE COMMAND_ERROR_IS_FATAL ANY)
