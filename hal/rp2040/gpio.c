#include "hal/rp2040/machine.h"

#include "hal/rp2040/registers.h"

enum { PAD_SCHMITT = 1 << 1, PAD_PULL_UP = 1 << 3, PAD_4_MA = 1 << 4, PAD_INPUT = 1 << 6, PAD_NO_OUTPUT = 1 << 7 };
enum { BY_NOTHING = 31 };

void gpio_set(uint32_t pin, enum gpio_function function)
{
    PADS_BANK0.gpio[pin] = PAD_SCHMITT | PAD_PULL_UP | PAD_4_MA | PAD_INPUT;
    IO_BANK0.gpio[pin].gpio_ctrl = function;
}

void gpio_analogue(uint32_t pin)
{
    PADS_BANK0.gpio[pin] = PAD_NO_OUTPUT;
    IO_BANK0.gpio[pin].gpio_ctrl = BY_NOTHING;
}

void gpio_output(uint32_t pin)
{
    gpio_set(pin, GPIO_BY_CORE);
    SIO.gpio_oe_set = 1u << pin;
}

void gpio_write(uint32_t pin, bool high)
{
    if (high)
        SIO.gpio_out_set = 1u << pin;
    else
        SIO.gpio_out_clr = 1u << pin;
}

bool gpio_read(uint32_t pin)
{
    return SIO.gpio_in >> pin & 1u;
}
