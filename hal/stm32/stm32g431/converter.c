/* The ADC of an STM32G4 (RM0440 21), and the DMA request multiplexer (13). */
#include "hal/stm32/chip.h"

#include "hal/stm32/stm32g431/registers.h"

enum {
    DMA1_DMAMUX_ON = 1u << 0 | 1u << 2,            /* in ahb1enr */
    ADC12_ON = 1u << 13,                           /* in ahb2enr */
    TIM1_ON = 1u << 11,                            /* in apb2enr */
    TIM2_TO_4_ON = 7u << 0,                        /* in apb1enr1 */
    FROM_ADC1 = 5,                                 /* in the multiplexer */
    CORE_BY_4 = 3u << 16,                          /* in the common ccr: 20 MHz */
    ADC_ON = 1u << 0, BEGIN = 1u << 2, REGULATOR_ON = 1u << 28,   /* in cr */
    READY = 1u << 0,                               /* in isr */
    ROUND_BY_DMA = 3u << 0, KEEP_LAST = 1u << 12, CONTINUOUS = 1u << 13,   /* in cfgr */
    LONGEST_0_TO_9 = 0x3FFFFFFF, LONGEST_10_TO_18 = 0x07FFFFFF,   /* in smpr: 640.5 cycles of 20 MHz */
    WAIT_MAX = 20000,                              /* polls; calibration takes 116 ADC cycles */
    PAUSE = 2000                                   /* polls: more than the regulator's 20 us */
};

const uint32_t BREAK_FILTER = 15u << 16;   /* pulses under 256 clocks, 3.2 us, are noise */

const volatile uint32_t *converter_power(void)
{
    RCC.ahb1enr |= DMA1_DMAMUX_ON;
    RCC.ahb2enr |= ADC12_ON;
    RCC.apb2enr |= TIM1_ON;
    RCC.apb1enr1 |= TIM2_TO_4_ON;
    DMAMUX.ccr[0] = FROM_ADC1;
    return &ADC1.dr;
}

/* Sets a bit of cr, keeping the regulator on, and waits for some cycles. */
static void set(uint32_t bit)
{
    ADC1.cr = REGULATOR_ON | bit;
    for (unsigned i = 0; i < PAUSE; i++)
        (void)ADC1.cr;
}

void converter_start(const uint8_t channels[CONVERTER_SAMPLES])
{
    const uint32_t calibrate = 1u << 31;   /* in cr */

    ADC1.smpr[0] = LONGEST_0_TO_9;
    ADC1.smpr[1] = LONGEST_10_TO_18;
    ADC1.common.ccr = CORE_BY_4;
    set(0);
    set(calibrate);
    for (unsigned i = 0; i < WAIT_MAX && (ADC1.cr & calibrate); i++)
        continue;
    ADC1.sqr[0] = (CONVERTER_SAMPLES - 1u) | (uint32_t)channels[0] << 6 | (uint32_t)channels[1] << 12
                | (uint32_t)channels[2] << 18 | (uint32_t)channels[3] << 24;
    ADC1.sqr[1] = channels[4] | (uint32_t)channels[5] << 6;
    ADC1.cfgr = CONTINUOUS | KEEP_LAST | ROUND_BY_DMA;
    set(ADC_ON);
    for (unsigned i = 0; i < WAIT_MAX && !(ADC1.isr & READY); i++)
        continue;
    ADC1.cr = REGULATOR_ON | ADC_ON | BEGIN;
}
