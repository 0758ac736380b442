/* The ADC of an STM32F1 (RM0008 11). */
#include "hal/stm32/chip.h"

#include "hal/stm32/stm32f103/registers.h"

enum {
    DMA1_ON = 1u << 0,                             /* in ahbenr */
    ADC1_TIM1_ON = 1u << 9 | 1u << 11,             /* in apb2enr */
    TIM2_TO_4_ON = 7u << 0,                        /* in apb1enr */
    ADC_BY_6 = 2u << 14,                           /* in cfgr: at most 14 MHz */
    ADC_ON = 1u << 0, CONTINUOUS = 1u << 1, CALIBRATE = 1u << 2, RESET_CALIBRATION = 1u << 3, BY_DMA = 1u << 8,
    BY_SOFTWARE = 7u << 17 | 1u << 20, BEGIN = 1u << 22,
    SCAN = 1u << 8,                                /* in cr1 */
    LONGEST_0_TO_9 = 0x3FFFFFFF,                   /* in smpr: 239.5 cycles of 12 MHz */
    CALIBRATION_WAIT_MAX = 20000                   /* polls; calibration takes some 90 ADC cycles */
};

const uint32_t BREAK_FILTER = 0;

const volatile uint32_t *converter_power(void)
{
    RCC.ahbenr |= DMA1_ON;
    RCC.apb2enr |= ADC1_TIM1_ON;
    RCC.apb1enr |= TIM2_TO_4_ON;
    RCC.cfgr |= ADC_BY_6;
    return &ADC1.dr;
}

static void await_clear(uint32_t bit)
{
    ADC1.cr2 = ADC_ON | bit;
    for (unsigned i = 0; i < CALIBRATION_WAIT_MAX && (ADC1.cr2 & bit); i++)
        continue;
}

void converter_start(const uint8_t channels[CONVERTER_SAMPLES])
{
    ADC1.smpr[1] = LONGEST_0_TO_9;
    ADC1.sqr[0] = (CONVERTER_SAMPLES - 1u) << 20;
    ADC1.sqr[2] = channels[0] | (uint32_t)channels[1] << 5 | (uint32_t)channels[2] << 10 | (uint32_t)channels[3] << 15
                | (uint32_t)channels[4] << 20 | (uint32_t)channels[5] << 25;
    ADC1.cr1 = SCAN;
    ADC1.cr2 = ADC_ON;
    await_clear(RESET_CALIBRATION);
    await_clear(CALIBRATE);
    ADC1.cr2 = ADC_ON | CONTINUOUS | BY_DMA | BY_SOFTWARE;
    ADC1.cr2 = ADC_ON | CONTINUOUS | BY_DMA | BY_SOFTWARE | BEGIN;
}
