#include "hal/stm32/chip.h"
#include "hal/stm32/gpio/gpio.h"
#include "hal/stm32/stm32g431/registers.h"

enum {
    GPIO_A_TO_C = 7,              /* in ahb2enr */
    FDCAN_ON = 1u << 25,          /* in apb1enr1 */
    USART2_ON = 1u << 17,
    PWR_ON = 1u << 28,
    BELOW_2_9_V = 1u << 0 | 6u << 1,
    UCPD1_DBDIS = 1u << 14,       /* in cr3: else PB4 and PB6, an encoder's, have the pull-downs of USB-C (6.4.3) */
    CCIPR_FDCAN_PCLK1 = 2u << 24  /* otherwise the crystal, which may be missing */
};

void pins_start(void)
{
    RCC.ahb2enr |= GPIO_A_TO_C;
    RCC.ccipr = CCIPR_FDCAN_PCLK1;
    RCC.apb1enr1 |= FDCAN_ON | USART2_ON | PWR_ON;
    (void)RCC.apb1enr1;   /* a peripheral may be accessed two cycles after its clock is on */
    PWR.cr2 |= BELOW_2_9_V;
    PWR.cr3 |= UCPD1_DBDIS;
    gpio_start();
}
