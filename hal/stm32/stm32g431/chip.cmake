# STM32G431: its own drivers, those that it shares, the links that it has with what each is made of, and the images of a stand-alone robot.
set(OCTET_CHIP_SOURCES clock.c pins.c flash.c nmi.c)
set(OCTET_SHARED_SOURCES gpio/gpio_f4.c)

set(OCTET_LINKS fdcan slcan)
set(OCTET_BODIES pins mute body)
set(OCTET_BODY_LINK fdcan)
set(OCTET_LINK_fdcan can_link.c ../port/cortex_m/can_queue.c fdcan.c)
set(OCTET_LINK_slcan ../port/cortex_m/uart_slcan_link.c uart_g4.c)
set(OCTET_INTERRUPTS 102)   # RM0440 14.3
