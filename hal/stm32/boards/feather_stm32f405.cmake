# Adafruit Feather STM32F405 Express.
set(OCTET_CHIP stm32f405)
set(OCTET_CRYSTAL_MHZ 12)
set(OCTET_LED PC1)         # red, beside the USB socket, "13"
set(OCTET_LED_HIGH 1)
set(OCTET_CAN_RX PB8)      # "9"
set(OCTET_CAN_TX PB9)      # "10"
set(OCTET_UART_RX PB7)     # "SDA"
set(OCTET_UART_TX PB6)     # "SCL"
