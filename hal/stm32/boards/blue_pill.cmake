# Blue Pill: STM32F103C8.
set(OCTET_CHIP stm32f103)
set(OCTET_CRYSTAL_MHZ 8)
set(OCTET_LED PC13)
set(OCTET_LED_HIGH 0)
set(OCTET_CAN_RX PB8)
set(OCTET_CAN_TX PB9)
set(OCTET_UART_RX PA10)
set(OCTET_UART_TX PA9)

# A robot of its own: five infrared pairs, two motors with encoders behind a bridge, a beacon's receiver.
set(OCTET_PROXIMITY_RIGHT PA0)
set(OCTET_PROXIMITY_FRONT_RIGHT PA1)
set(OCTET_PROXIMITY_FRONT PA2)
set(OCTET_PROXIMITY_FRONT_LEFT PA3)
set(OCTET_PROXIMITY_LEFT PA4)
set(OCTET_INFRARED PB13)        # on: the pairs shine
set(OCTET_BATTERY PA5)          # a third of it: 20 kohm above, 10 kohm below
set(OCTET_LEFT_ENCODER_A PA6)
set(OCTET_LEFT_ENCODER_B PA7)
set(OCTET_RIGHT_ENCODER_A PB6)
set(OCTET_RIGHT_ENCODER_B PB7)
set(OCTET_LEFT_PWM PB14)
set(OCTET_RIGHT_PWM PB15)
set(OCTET_LEFT_BACK PA8)        # the PWM of driving forward; the other one is of driving backward
set(OCTET_RIGHT_BACK PA11)
set(OCTET_BRIDGE_AWAKE PB5)     # nSLEEP
set(OCTET_BRIDGE_FAULT PB12)    # nFAULT
set(OCTET_BEACON PA15)
set(OCTET_BUMPER_LEFT PB10)     # to ground when pressed
set(OCTET_BUMPER_RIGHT PB11)
set(OCTET_BUTTON PB0)           # to ground when pressed

# What is printed beside its headers, seen from above, from the end with B12 on.
set(OCTET_HEADER_1 "B12 B13 B14 B15 A8 A9 A10 A11 A12 A15 B3 B4 B5 B6 B7 B8 B9 5V G 3.3")
set(OCTET_HEADER_2 "G G 3.3 R B11 B10 B1 B0 A7 A6 A5 A4 A3 A2 A1 A0 C15 C14 C13 VB")
