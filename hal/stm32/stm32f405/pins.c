#include "hal/stm32/chip.h"
#include "hal/stm32/gpio/gpio.h"
#include "hal/stm32/stm32f405/registers.h"

enum {
    GPIO_A_TO_C = 7,              /* in ahb1enr */
    CAN1_ON = 1u << 25,           /* in apb1enr */
    PWR_ON = 1u << 28,
    BELOW_2_9_V = 1u << 4 | 7u << 5,
    USART1_ON = 1u << 4           /* in apb2enr */
};

void pins_start(void)
{
    RCC.ahb1enr |= GPIO_A_TO_C;
    RCC.apb1enr |= CAN1_ON | PWR_ON;
    RCC.apb2enr |= USART1_ON;
    (void)RCC.apb1enr;   /* a peripheral may be accessed two cycles after its clock is on */
    PWR.cr |= BELOW_2_9_V;
    gpio_start();
}
