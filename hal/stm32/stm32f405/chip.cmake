# STM32F405: its own drivers, those that it shares, and the links that it has with what each is made of.
set(OCTET_CHIP_SOURCES clock.c pins.c flash.c)
set(OCTET_SHARED_SOURCES gpio/gpio_f4.c)

set(OCTET_LINKS bxcan slcan)
set(OCTET_LINK_bxcan can_link.c ../port/cortex_m/can_queue.c bxcan.c)
set(OCTET_LINK_slcan ../port/cortex_m/uart_slcan_link.c uart_f1.c)
set(OCTET_INTERRUPTS 82)   # RM0090 12.2
