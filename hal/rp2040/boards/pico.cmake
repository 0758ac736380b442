# Raspberry Pi Pico: RP2040 with 2 MB of flash.
set(OCTET_CHIP rp2040)
set(OCTET_LINKS slcan)
set(OCTET_LED GP25)
set(OCTET_LED_HIGH 1)
set(OCTET_UART_TX GP0)
set(OCTET_UART_RX GP1)

# A robot of its own: three infrared pairs in front, two motors with encoders behind a bridge, a beacon's receiver.
set(OCTET_BODIES pins check)
set(OCTET_LEFT_PWM GP2)
set(OCTET_LEFT_BACK GP3)        # the PWM of driving forward; the other one is of driving backward
set(OCTET_RIGHT_PWM GP4)
set(OCTET_RIGHT_BACK GP5)
set(OCTET_LEFT_ENCODER_A GP6)
set(OCTET_LEFT_ENCODER_B GP7)
set(OCTET_RIGHT_ENCODER_A GP8)
set(OCTET_RIGHT_ENCODER_B GP9)
set(OCTET_BRIDGE_AWAKE GP10)    # nSLEEP
set(OCTET_BRIDGE_FAULT GP11)    # nFAULT
set(OCTET_INFRARED GP12)        # on: the pairs shine
set(OCTET_BEACON GP13)
set(OCTET_BUMPER_LEFT GP14)     # to ground when pressed
set(OCTET_BUMPER_RIGHT GP15)
set(OCTET_BUTTON GP16)          # to ground when pressed
set(OCTET_PROXIMITY_FRONT_RIGHT GP26)
set(OCTET_PROXIMITY_FRONT GP27)
set(OCTET_PROXIMITY_FRONT_LEFT GP28)
set(OCTET_BATTERY GP29)         # on the board itself: a third of VSYS

# What is printed beside its pins, seen from above, from the USB socket on.
set(OCTET_HEADER_1 "GP0 GP1 GND GP2 GP3 GP4 GP5 GND GP6 GP7 GP8 GP9 GND GP10 GP11 GP12 GP13 GND GP14 GP15")
set(OCTET_HEADER_2 "VBUS VSYS GND 3V3_EN 3V3 ADC_VREF GP28 GND GP27 GP26 RUN GP22 GND GP21 GP20 GP19 GP18 GND GP17 GP16")
set(OCTET_HEADER_END "USB")
