# The board that OCTET_BOARD names, its chip, and functions that build its images.
set(OCTET_STM32 ${PROJECT_SOURCE_DIR}/hal/stm32)
include(boards)
if(NOT EXISTS ${OCTET_BOARD_DIR}/${OCTET_BOARD}.cmake)
  file(GLOB boards RELATIVE ${OCTET_BOARD_DIR} ${OCTET_BOARD_DIR}/*.cmake)
  string(REPLACE ".cmake" "" boards "${boards}")
  list(JOIN boards ", " boards)
  message(FATAL_ERROR "no board '${OCTET_BOARD}'; choose from: ${boards}")
endif()
include(${OCTET_BOARD_DIR}/${OCTET_BOARD}.cmake)
include(${OCTET_STM32}/${OCTET_CHIP}/chip.cmake)

# octet_program(IMAGE LIBRARY...): for this board, IMAGE.elf, .bin and .hex.
function(octet_program image)
  octet_cortex_m_program(${image} ${OCTET_STM32}/${OCTET_CHIP}/${OCTET_CHIP}.ld octet_stm32 ${ARGN})
  target_link_options(${image} PRIVATE -L${OCTET_STM32})
  set_property(TARGET ${image} APPEND PROPERTY LINK_DEPENDS ${OCTET_STM32}/stm32.ld)
  foreach(format binary:bin ihex:hex)
    string(REGEX MATCH "(.*):(.*)" _ ${format})
    add_custom_command(TARGET ${image} POST_BUILD
      COMMAND ${CMAKE_OBJCOPY} -O ${CMAKE_MATCH_1} $<TARGET_FILE:${image}> ${PROJECT_BINARY_DIR}/${image}.${CMAKE_MATCH_2}
      VERBATIM)
  endforeach()
endfunction()

# octet_image(LINK): the robot on this board, over that link.
function(octet_image link)
  octet_program(octet-${OCTET_BOARD}-${link}
    octet_main octet_core octet_can_body octet_link_${link})
endfunction()
