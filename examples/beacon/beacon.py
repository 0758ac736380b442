"""Food for a robot of your own: infrared bursts for its receiver. MicroPython, for a Raspberry Pi Pico.

Each 2.5 ms there is a burst of 38 kHz: by turns strong, from pin 14, and weak, from pin 15. A robot that receives the
strong ones sees food; one that receives the weak ones, too, is close enough to eat it.
"""

from time import sleep_us, ticks_add, ticks_diff, ticks_us

from machine import PWM, Pin

BURST_US, PERIOD_US = 600, 2500
LIT = 1 << 15  # half of each period of 38 kHz

leds = [PWM(Pin(number), freq=38000, duty_u16=0) for number in (14, 15)]
due = ticks_us()
while True:
    for led in leds:
        led.duty_u16(LIT)
        sleep_us(BURST_US)
        led.duty_u16(0)
        due = ticks_add(due, PERIOD_US)
        sleep_us(max(ticks_diff(due, ticks_us()), 0))
