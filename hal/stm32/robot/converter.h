/* converter.h: what robot_pins.c leaves to each family: clocks, and the converter that measures the sensors. */
#ifndef OCTET_CONVERTER_H
#define OCTET_CONVERTER_H

#include <stdint.h>

enum { CONVERTER_SAMPLES = 6 };

const volatile uint32_t *converter_power(void);
        /* Clocks for TIM1 to TIM4, DMA1 and the converter. Returns the register from which DMA is to take the samples. */

void converter_start(const uint8_t channels[CONVERTER_SAMPLES]);
        /* Measures them one after the other, over and over: a round takes less than half a millisecond. Channel 1 of DMA1 is ready. */

#endif
