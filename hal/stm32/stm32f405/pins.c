#include "hal/port/cortex_m/mcu.h"
#include "hal/stm32/board.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/stm32f405/registers.h"

enum {
    GPIO_A_TO_C = 7,              /* in ahb1enr */
    CAN1_ON = 1u << 25,           /* in apb1enr */
    USART1_ON = 1u << 4,          /* in apb2enr */
    OUTPUT = 1,
    ALTERNATE = 2,
    PULL_UP = 1,                  /* an open receive pin reads idle */
    AF_USART1 = 7,
    AF_CAN1 = 9
};

static void set_bits(volatile uint32_t *reg, unsigned at, unsigned width, uint32_t value)
{
    *reg = (*reg & ~(((1u << width) - 1u) << at)) | value << at;
}

static void connect(struct pin pin, uint32_t function)
{
    volatile struct gpio_registers *gpio = &GPIO[pin.port].at;

    set_bits(&gpio->pupdr, 2u * pin.number, 2, PULL_UP);
    set_bits(&gpio->afr[pin.number / 8u], 4u * (pin.number % 8u), 4, function);
    set_bits(&gpio->moder, 2u * pin.number, 2, ALTERNATE);
}

void pins_start(void)
{
    RCC.ahb1enr |= GPIO_A_TO_C;
    RCC.apb1enr |= CAN1_ON;
    RCC.apb2enr |= USART1_ON;
    connect(BOARD_CAN_RX, AF_CAN1);
    connect(BOARD_CAN_TX, AF_CAN1);
    connect(BOARD_UART_RX, AF_USART1);
    connect(BOARD_UART_TX, AF_USART1);
    set_bits(&GPIO[BOARD_LED.port].at.moder, 2u * BOARD_LED.number, 2, OUTPUT);
}

void mcu_light(bool on)
{
    GPIO[BOARD_LED.port].at.bsrr = 1u << (BOARD_LED.number + (on == BOARD_LED_HIGH ? 0u : 16u));
}
