/* pins.h: what a body on pins needs from the microcontroller. Each chip family provides it:
 * hal/stm32/robot_pins.c and hal/rp2040/robot_pins.c are two. Timers do everything in hardware; a beat of 5 ms
 * from one of them paces the software. One thread calls all of it. */
#ifndef OCTET_PINS_H
#define OCTET_PINS_H

#include "firmware/io.h"

enum { PINS_SIDES = 2 };   /* 0 left, 1 right */

extern const uint8_t PINS_SENSORS;   /* the proximity sensors that it has, the sum of their bits in feel */

void pins_open(void);
        /* Sets up timers, ADC and pins, with the bridge asleep, both motors off and the infrared LEDs off. Beats
           begin with the call. */

void pins_wait(void);
        /* Sleeps until the next beat; returns at once if one has passed since the last call. */

uint16_t pins_count(unsigned side);
        /* Counts of a wheel's encoder, forward up; wraps. */

void pins_push(unsigned side, int32_t duty);
        /* Drives a motor: duty in 1/65536 of the supply, forward positive. In the rest of the time the bridge brakes
           it, either way: so its speed is proportional to the duty, whatever its inductance. */

void pins_wake_bridge(bool awake);
        /* Wakes the motor bridge or puts it to sleep; asleep, both motors coast. */

bool pins_bridge_failed(void);
        /* Whether the bridge has reported a short circuit or overtemperature since pins_open. It switches itself off;
           on an STM32 the timer has stopped the PWM, too. */

void pins_shine(bool on);
        /* Switches the infrared LEDs of the proximity sensors. */

void pins_measure(uint16_t light[FEEL_COUNT]);
        /* Light received by the proximity sensors, 0..4095, in the order of feel's bits, less than 0.5 ms old; 0 for
           a sensor that the body does not have. */

uint32_t pins_battery_mv(void);
        /* Voltage of the battery, of which WHEEL_NOMINAL_MV stands for the motors' nominal voltage. */

uint16_t pins_bursts(void);
        /* Bursts of the beacon's light received so far; wraps. */

bool pins_bumped(void);
bool pins_button(void);
        /* Whether a bumper or the button is pressed now, not debounced. */

#endif
