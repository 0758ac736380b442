# STM32F103: its own drivers, the links that it has with what each is made of, and the images of a robot of its own.
set(OCTET_CHIP_SOURCES clock.c gpio.c pins.c flash.c)

# With a boot loader (docs/update.md): where it and the slots lie, bytes, and its RAM.
set(OCTET_BOOT_SIZE 16384)
set(OCTET_SLOT_A 0x08004000)
set(OCTET_SLOT_B 0x08009800)
set(OCTET_SLOT_SIZE 22528)
set(OCTET_BOOT_RAM 0x20001000)

set(OCTET_LINKS bxcan slcan)
set(OCTET_BODIES pins mute body)
set(OCTET_BODY_LINK bxcan)
set(OCTET_LINK_bxcan can_link.c can_queue.c can_timing.c bxcan.c)
set(OCTET_LINK_slcan uart_slcan_link.c uart_f1.c)
