# STM32F405: its own drivers, those that it shares, and the links that it has with what each is made of.
set(OCTET_CHIP_SOURCES clock.c pins.c flash.c)
set(OCTET_SHARED_SOURCES gpio/gpio_f4.c)

# With a boot loader (docs/update.md): where it and the slots lie, bytes, and its RAM.
set(OCTET_BOOT_SIZE 16384)
set(OCTET_SLOT_A 0x08020000)
set(OCTET_SLOT_B 0x08040000)
set(OCTET_SLOT_SIZE 131072)
set(OCTET_BOOT_RAM 0x20001000)

set(OCTET_LINKS bxcan slcan)
set(OCTET_LINK_bxcan can_link.c can_queue.c can_timing.c bxcan.c)
set(OCTET_LINK_slcan uart_slcan_link.c uart_f1.c)
