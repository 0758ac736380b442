# The contents of a wheel besides Python files, in host_sim/tree as in a checkout. If tools/wheels has made them, they
# include the page, the flash images, the interfaces to C, completions and man pages.
set(tree host_sim/tree)
set(targets octet octet_models octet_world_shared octet_fleet_shared octet_loop_shared octet_programmed_shared
  octet_driven_shared)
if(OCTET_HAS_LINKS)
  list(APPEND targets octet-program octet-robot)
endif()
foreach(target ${targets})
  get_target_property(folder ${target} BINARY_DIR)
  file(RELATIVE_PATH folder ${PROJECT_BINARY_DIR} ${folder})
  install(TARGETS ${target} LIBRARY DESTINATION ${tree}/build/host/${folder} RUNTIME DESTINATION ${tree}/build/host/${folder}
    ARCHIVE EXCLUDE_FROM_ALL DESTINATION unused)
endforeach()

set(sources ${PROJECT_SOURCE_DIR}/host_sim)
execute_process(
  COMMAND ${python} ${generate} --python ${sources}/protocol/generated.py
  COMMAND_ERROR_IS_FATAL ANY)
execute_process(
  COMMAND ${python} -c "from host_sim.lab.study.version import code_version; print(code_version(), end='')"
  WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} OUTPUT_FILE ${PROJECT_BINARY_DIR}/code_version COMMAND_ERROR_IS_FATAL ANY)
install(FILES ${sources}/protocol/generated.py DESTINATION host_sim/protocol)
install(FILES ${PROJECT_BINARY_DIR}/code_version DESTINATION ${tree}/build)
install(FILES ${OCTET_GENERATED}/robot_words.h DESTINATION ${tree}/build/host/generated)

file(GLOB pins RELATIVE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/hal/*/boards/*.cmake
  ${PROJECT_SOURCE_DIR}/hal/*/pins.toml ${PROJECT_SOURCE_DIR}/hal/stm32/*/pins.toml)
foreach(file docs/protocol.md docs/tables/atlas-map.csv firmware/io.h firmware/memory/memory.h hal/link/link.h firmware/motion/speed_control.h host_sim/program/own/mine.c
    hal/pins_body/wiring.toml hal/protocol/octet.dbc hal/protocol/robot.toml ${pins})
  get_filename_component(folder ${file} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/${file} DESTINATION ${tree}/${folder})
endforeach()
install(PROGRAMS ${PROJECT_SOURCE_DIR}/tools/with-vcan DESTINATION ${tree}/tools)
install(FILES ${PROJECT_SOURCE_DIR}/pyproject.toml DESTINATION ${tree})   # has the version
install(DIRECTORY ${PROJECT_SOURCE_DIR}/studies DESTINATION ${tree})

set(made ${PROJECT_SOURCE_DIR}/build/wheel)
foreach(part tree share)
  if(NOT EXISTS ${made}/${part})
    message(STATUS "octet: build/wheel/${part} is missing: tools/wheels makes it, with all that every system shares")
  endif()
endforeach()
install(DIRECTORY ${made}/tree/ DESTINATION ${tree} OPTIONAL)
install(DIRECTORY ${made}/share DESTINATION ${SKBUILD_DATA_DIR} OPTIONAL)
