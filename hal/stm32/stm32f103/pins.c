#include "hal/port/cortex_m/mcu.h"
#include "hal/stm32/board.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/stm32f103/registers.h"

enum {
    CAN1_ON = 1u << 25,           /* in apb1enr */
    PWR_ON = 1u << 28,
    BELOW_2_9_V = 1u << 4 | 7u << 5,
    AFIO_ON = 1u << 0,            /* in apb2enr */
    GPIO_A_TO_C = 7u << 2,
    USART1_ON = 1u << 14,
    MAPR_NO_JTAG = 2u << 24,      /* SWD stays: the other pins of JTAG are free */
    INPUT_PULLED = 8,
    OUTPUT_2_MHZ = 2,
    ALTERNATE_50_MHZ = 11
};

static void set_mode(struct pin pin, uint32_t mode)
{
    volatile uint32_t *reg = &GPIO[pin.port].at.cr[pin.number / 8u];
    unsigned at = 4u * (pin.number % 8u);

    *reg = (*reg & ~(15u << at)) | mode << at;
}

/* An open receive pin reads idle. */
static void listen_on(struct pin pin)
{
    GPIO[pin.port].at.bsrr = 1u << pin.number;
    set_mode(pin, INPUT_PULLED);
}

void pins_start(void)
{
    RCC.apb2enr |= AFIO_ON | GPIO_A_TO_C | USART1_ON;
    RCC.apb1enr |= CAN1_ON | PWR_ON;
    PWR.cr |= BELOW_2_9_V;
    AFIO.mapr = (uint32_t)BOARD_REMAP | MAPR_NO_JTAG;
    listen_on(BOARD_CAN_RX);
    listen_on(BOARD_UART_RX);
    set_mode(BOARD_CAN_TX, ALTERNATE_50_MHZ);
    set_mode(BOARD_UART_TX, ALTERNATE_50_MHZ);
    set_mode(BOARD_LED, OUTPUT_2_MHZ);
}

void mcu_light(bool on)
{
    GPIO[BOARD_LED.port].at.bsrr = 1u << (BOARD_LED.number + (on == BOARD_LED_HIGH ? 0u : 16u));
}
