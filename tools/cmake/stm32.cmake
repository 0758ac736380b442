# The board that OCTET_BOARD names, and what its chip is made of.
include(${PROJECT_SOURCE_DIR}/hal/stm32/boards/${OCTET_BOARD}.cmake)
string(REGEX REPLACE "^stm32" "" OCTET_CHIP_SHORT ${OCTET_CHIP})

# octet_define_pins(TARGET): what the board's file says, as board.h reads it.
function(octet_define_pins target)
  foreach(name LED CAN_RX CAN_TX UART_RX UART_TX)
    list(JOIN OCTET_${name} "," pin)
    target_compile_definitions(${target} PRIVATE "OCTET_${name}=${pin}")
  endforeach()
  target_compile_definitions(${target} PRIVATE OCTET_LED_HIGH=${OCTET_LED_HIGH} OCTET_CRYSTAL_MHZ=${OCTET_CRYSTAL_MHZ})
endfunction()

# octet_image(LINK LIBRARY...): the robot on this chip, over that link: .elf, .bin, .hex and .map.
function(octet_image link)
  set(image octet-${OCTET_CHIP}-${link})
  add_executable(${image})
  target_link_libraries(${image} PRIVATE octet_main octet_core octet_can_body octet_flash_store octet_stm32 ${ARGN})
  set(script ${CMAKE_CURRENT_SOURCE_DIR}/${OCTET_CHIP_SHORT}/${OCTET_CHIP}.ld)
  target_link_options(${image} PRIVATE
    -T ${script} -L ${CMAKE_CURRENT_SOURCE_DIR} -Wl,-Map=${PROJECT_BINARY_DIR}/${image}.map)
  set_target_properties(${image} PROPERTIES
    SUFFIX .elf
    RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}
    LINK_DEPENDS "${script};${CMAKE_CURRENT_SOURCE_DIR}/sections.ld")
  foreach(format binary:bin ihex:hex)
    string(REGEX MATCH "(.*):(.*)" _ ${format})
    add_custom_command(TARGET ${image} POST_BUILD
      COMMAND ${CMAKE_OBJCOPY} -O ${CMAKE_MATCH_1} $<TARGET_FILE:${image}> ${PROJECT_BINARY_DIR}/${image}.${CMAKE_MATCH_2}
      VERBATIM)
  endforeach()
endfunction()
