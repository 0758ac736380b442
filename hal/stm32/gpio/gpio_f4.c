/* Each pin has a mode, a pull and an alternate function. */
#include "hal/stm32/gpio/gpio_f4.h"

#include "hal/stm32/gpio/gpio.h"

enum { INPUT = 0, OUTPUT = 1, ALTERNATE = 2, ANALOGUE = 3 };

__attribute__((noinline)) static void set_bits(volatile uint32_t *reg, unsigned at, unsigned width, uint32_t value)
{
    *reg = (*reg & ~(((1u << width) - 1u) << at)) | value << at;
}

void gpio_set(uint32_t pin, enum gpio_mode mode, uint32_t function)
{
    static const uint8_t modes[GPIO_MODES] = {
        [GPIO_ANALOGUE] = ANALOGUE, [GPIO_OUTPUT] = OUTPUT, [GPIO_PULLED_UP] = INPUT, [GPIO_FROM] = ALTERNATE,
        [GPIO_TO] = ALTERNATE,
    };
    volatile struct gpio_registers *gpio = &GPIO[pin / PORT_PINS].at;
    unsigned number = pin % PORT_PINS;

    set_bits(&gpio->pupdr, 2 * number, 2, mode == GPIO_PULLED_UP || mode == GPIO_FROM);
    set_bits(&gpio->afr[number / 8], 4 * (number % 8), 4, function);
    set_bits(&gpio->moder, 2 * number, 2, modes[mode]);
}

void gpio_write(uint32_t pin, bool high)
{
    GPIO[pin / PORT_PINS].at.bsrr = 1u << (pin % PORT_PINS + (high ? 0u : 16u));
}

bool gpio_read(uint32_t pin)
{
    return GPIO[pin / PORT_PINS].at.idr >> pin % PORT_PINS & 1u;
}
