# octet_board_pins(TARGET BOARD): the pins of a board, for board.h.
set(OCTET_PINS_MAKERS ${PROJECT_SOURCE_DIR}/tools/pins ${PROJECT_SOURCE_DIR}/host_sim/emulator/board_pins.py)
function(octet_board_pins target board)
  include(${PROJECT_SOURCE_DIR}/hal/stm32/boards/${board}.cmake)
  set(folder ${PROJECT_BINARY_DIR}/generated/${board})
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${OCTET_PINS_MAKERS}
    ${PROJECT_SOURCE_DIR}/hal/stm32/boards/${board}.cmake ${PROJECT_SOURCE_DIR}/hal/stm32/${OCTET_CHIP}/pins.toml)
  file(MAKE_DIRECTORY ${folder})
  execute_process(COMMAND ${python} ${PROJECT_SOURCE_DIR}/tools/pins ${board} --c ${folder}/board_pins.h
    COMMAND_ERROR_IS_FATAL ANY)
  target_include_directories(${target} PRIVATE ${folder})
endfunction()
