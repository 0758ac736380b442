# The board that OCTET_BOARD names, its chip, and functions that build its images.
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

# octet_program(IMAGE LIBRARY...): for this board, IMAGE.elf, .bin and .hex.
function(octet_program image)
  set(script ${OCTET_STM32}/${OCTET_CHIP}/${OCTET_CHIP}.ld)
  set(sections ${PROJECT_SOURCE_DIR}/hal/port/cortex_m)
  add_executable(${image})
  target_link_libraries(${image} PRIVATE octet_flash_store octet_cortex_m octet_stm32 ${ARGN})
  target_link_options(${image} PRIVATE -T ${script} -L${OCTET_STM32} -L${sections})
  set_target_properties(${image} PROPERTIES
    SUFFIX .elf
    RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}
    LINK_DEPENDS "${script};${OCTET_STM32}/stm32.ld;${sections}/sections.ld")
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
    octet_main octet_core octet_can_body octet_alone octet_link_${link})
endfunction()

# octet_place(IMAGE ADDRESS SIZE): sets an image's address and maximum size in flash.
function(octet_place image address size)
  target_link_options(${image} PRIVATE LINKER:--defsym=IMAGE_AT=${address} LINKER:--defsym=IMAGE_SIZE=${size})
endfunction()

# octet_boot(LINK): the boot loader, and the robot in each of its slots, where a header precedes the program and a
# signature follows it.
function(octet_boot link)
  set(boot octet-${OCTET_BOARD}-${link}-boot)
  octet_program(${boot} octet_boot_main octet_boot octet_link_${link})
  octet_place(${boot} 0x08000000 ${OCTET_BOOT_SIZE})
  target_link_options(${boot} PRIVATE LINKER:--defsym=RAM_AT=${OCTET_BOOT_RAM})
  math(EXPR room "${OCTET_SLOT_SIZE} - 256 - 64")
  foreach(slot A B)
    string(TOLOWER ${slot} name)
    set(image octet-${OCTET_BOARD}-${link}-${name})
    octet_program(${image} octet_main octet_core octet_can_body octet_resident octet_boot octet_link_${link})
    math(EXPR start "${OCTET_SLOT_${slot}} + 256" OUTPUT_FORMAT HEXADECIMAL)
    octet_place(${image} ${start} ${room})
  endforeach()
endfunction()
