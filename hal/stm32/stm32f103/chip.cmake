# STM32F103: its own drivers, and the links that it has with what each is made of.
set(OCTET_CHIP_SOURCES clock.c pins.c flash.c)
set(OCTET_LINKS bxcan slcan)
set(OCTET_LINK_bxcan can_link.c can_queue.c can_timing.c bxcan.c)
set(OCTET_LINK_slcan uart_slcan_link.c uart_f1.c)
