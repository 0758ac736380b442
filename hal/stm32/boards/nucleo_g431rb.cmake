# ST NUCLEO-G431RB.
set(OCTET_CHIP stm32g431)
set(OCTET_CRYSTAL_MHZ 24)
set(OCTET_LED PA5)         # LD2, green
set(OCTET_LED_HIGH 1)
set(OCTET_CAN_RX PA11)     # CN10, 14; not PB8, which is BOOT0 as well
set(OCTET_CAN_TX PA12)     # CN10, 12
set(OCTET_UART_RX PA3)     # the ST-LINK's serial port
set(OCTET_UART_TX PA2)
