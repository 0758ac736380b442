/* pins.h: what the body of a robot of its own needs of the microcontroller's pins. Each family of chips provides it:
 * hal/stm32/robot/robot_pins.c is one. Everything is done by timers and the converter by themselves; a beat of 5 ms, made
 * by the timer of the motors, tells when there is something to do. One thread calls all of it. */
#ifndef OCTET_PINS_H
#define OCTET_PINS_H

#include "firmware/io.h"

enum { PINS_SIDES = 2 };   /* 0 left, 1 right */

void pins_open(void);
        /* Timers, converter and pins, with the bridge asleep, both motors without current and the infrared LEDs off. Beats begin
           with the call. */

void pins_wait(void);
        /* Sleeps until the next beat. One that has passed since the last call counts as the next. */

uint16_t pins_count(unsigned side);
        /* Counts of a wheel's encoder, forward up; wraps. */

void pins_push(unsigned side, int32_t duty);
        /* Current for a motor: duty in 1/65536 of the supply, forward positive. */

void pins_wake_bridge(bool awake);
        /* The bridge between PWM and motors; asleep, both motors are free. */

bool pins_bridge_failed(void);
        /* It reports a short circuit or that it is too hot. The timer has then stopped the PWM by itself, until the bridge is woken
           again. */

void pins_shine(bool on);
        /* The infrared LEDs of the proximity sensors. */

void pins_measure(uint16_t light[FEEL_COUNT]);
        /* What the proximity sensors receive, 0..4095, in the order of feel's bits: less than half a millisecond old. */

uint32_t pins_battery_mv(void);

uint16_t pins_bursts(void);
        /* Bursts of the beacon's light received so far; wraps. */

bool pins_bumped(void);
bool pins_button(void);
        /* Pressed at this moment; contacts bounce. */

#endif
