# The board that OCTET_BOARD names, and what its chip is made of.
set(OCTET_STM32 ${PROJECT_SOURCE_DIR}/hal/stm32)
if(NOT EXISTS ${OCTET_STM32}/boards/${OCTET_BOARD}.cmake)
  file(GLOB boards RELATIVE ${OCTET_STM32}/boards ${OCTET_STM32}/boards/*.cmake)
  string(REPLACE ".cmake" "" boards "${boards}")
  list(JOIN boards ", " boards)
  message(FATAL_ERROR "no board '${OCTET_BOARD}'; choose from: ${boards}")
endif()
include(${OCTET_STM32}/boards/${OCTET_BOARD}.cmake)
include(${OCTET_STM32}/${OCTET_CHIP}/chip.cmake)

include(boards)

# octet_image(LINK LIBRARY...): the robot on this board, over that link: .elf, .bin and .hex.
function(octet_image link)
  set(image octet-${OCTET_BOARD}-${link})
  set(script ${OCTET_STM32}/${OCTET_CHIP}/${OCTET_CHIP}.ld)
  set(sections ${PROJECT_SOURCE_DIR}/hal/port/cortex_m)
  add_executable(${image})
  target_link_libraries(${image} PRIVATE
    octet_main octet_core octet_can_body octet_flash_store octet_cortex_m ${ARGN})
  target_link_options(${image} PRIVATE -T ${script} -L ${sections})
  set_target_properties(${image} PROPERTIES
    SUFFIX .elf
    RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}
    LINK_DEPENDS "${script};${sections}/sections.ld")
  foreach(format binary:bin ihex:hex)
    string(REGEX MATCH "(.*):(.*)" _ ${format})
    add_custom_command(TARGET ${image} POST_BUILD
      COMMAND ${CMAKE_OBJCOPY} -O ${CMAKE_MATCH_1} $<TARGET_FILE:${image}> ${PROJECT_BINARY_DIR}/${image}.${CMAKE_MATCH_2}
      VERBATIM)
  endforeach()
endfunction()
