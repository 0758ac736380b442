/* converter.h: what robot_pins.c leaves to each chip family: clocks, the ADC for the sensors, and additional
 * registers of its TIM1. */
#ifndef OCTET_CONVERTER_H
#define OCTET_CONVERTER_H

#include <stdint.h>

enum { CONVERTER_SAMPLES = 6 };

extern const uint32_t BREAK_FILTER;   /* in TIM1's bdtr: of the pulses at its break input; 0: it has none */

const volatile uint32_t *converter_power(void);
        /* Enables the clocks of TIM1 to TIM4, DMA1 and the ADC. Returns the register from which DMA reads samples. */

void converter_start(const uint8_t channels[CONVERTER_SAMPLES]);
        /* Starts converting all channels in rounds of under 0.5 ms, repeatedly. Channel 1 of DMA1 must be ready. */

#endif
