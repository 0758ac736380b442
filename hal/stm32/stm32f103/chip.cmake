# STM32F103: its own drivers, the links that it has with what each is made of, and the images of a stand-alone robot.
set(OCTET_CHIP_SOURCES clock.c gpio.c pins.c flash.c)

set(OCTET_LINKS bxcan slcan)
set(OCTET_BODIES pins mute body)
set(OCTET_BODY_LINK bxcan)
set(OCTET_LINK_bxcan can_link.c ../port/cortex_m/can_queue.c bxcan.c)
set(OCTET_LINK_slcan ../port/cortex_m/uart_slcan_link.c uart_f1.c)
set(OCTET_INTERRUPTS 43)   # RM0008 10.1.2
