# STM32G431: its own drivers, those that it shares, the links that it has with what each is made of, and the images of a robot of its own.
set(OCTET_CHIP_SOURCES clock.c pins.c flash.c nmi.c)
set(OCTET_SHARED_SOURCES gpio/gpio_f4.c)

# With a boot loader (docs/update.md): where it and the slots lie, bytes, and its RAM.
set(OCTET_BOOT_SIZE 20480)
set(OCTET_SLOT_A 0x08005000)
set(OCTET_SLOT_B 0x08011000)
set(OCTET_SLOT_SIZE 49152)
set(OCTET_BOOT_RAM 0x20001000)

set(OCTET_LINKS fdcan slcan)
set(OCTET_BODIES pins mute body)
set(OCTET_BODY_LINK fdcan)
set(OCTET_LINK_fdcan can_link.c can_queue.c can_timing.c fdcan.c)
set(OCTET_LINK_slcan uart_slcan_link.c uart_g4.c)
