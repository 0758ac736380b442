#include "hal/stm32/chip.h"
#include "hal/stm32/gpio/gpio.h"
#include "hal/stm32/stm32f103/registers.h"

enum {
    CAN1_ON = 1u << 25,           /* in apb1enr */
    PWR_ON = 1u << 28,
    BELOW_2_9_V = 1u << 4 | 7u << 5,
    AFIO_ON = 1u << 0,            /* in apb2enr */
    GPIO_A_TO_C = 7u << 2,
    USART1_ON = 1u << 14,
    MAPR_NO_JTAG = 2u << 24       /* SWD stays enabled; the other JTAG pins are free */
};

void pins_start(void)
{
    RCC.apb2enr |= AFIO_ON | GPIO_A_TO_C | USART1_ON;
    RCC.apb1enr |= CAN1_ON | PWR_ON;
    (void)RCC.apb1enr;   /* a peripheral may be accessed two cycles after its clock is on */
    PWR.cr |= BELOW_2_9_V;
    AFIO.mapr = (uint32_t)BOARD_REMAP | MAPR_NO_JTAG;
    gpio_start();
}
