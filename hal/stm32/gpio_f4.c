#include "hal/stm32/gpio_f4.h"

#include "hal/port/cortex_m/mcu.h"
#include "hal/stm32/board.h"

enum { OUTPUT = 1, ALTERNATE = 2, PULL_UP = 1 };

__attribute__((noinline)) static void set_bits(volatile uint32_t *reg, unsigned at, unsigned width, uint32_t value)
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

void gpio_start(uint32_t can_function, uint32_t uart_function)
{
    connect(BOARD_CAN_RX, can_function);
    connect(BOARD_CAN_TX, can_function);
    connect(BOARD_UART_RX, uart_function);
    connect(BOARD_UART_TX, uart_function);
    set_bits(&GPIO[BOARD_LED.port].at.moder, 2u * BOARD_LED.number, 2, OUTPUT);
}

void mcu_light(bool on)
{
    GPIO[BOARD_LED.port].at.bsrr = 1u << (BOARD_LED.number + (on == BOARD_LED_HIGH ? 0u : 16u));
}
