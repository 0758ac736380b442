#include "hal/stm32/stm32f103/gpio.h"

#include "hal/stm32/stm32f103/registers.h"

void gpio_mode(struct pin pin, uint32_t mode)
{
    volatile uint32_t *reg = &GPIO[pin.port].at.cr[pin.number / 8u];
    unsigned at = 4u * (pin.number % 8u);

    *reg = (*reg & ~(15u << at)) | mode << at;
}

void gpio_pull_up(struct pin pin)
{
    gpio_write(pin, true);
    gpio_mode(pin, GPIO_PULLED);
}

void gpio_write(struct pin pin, bool high)
{
    GPIO[pin.port].at.bsrr = 1u << (pin.number + (high ? 0u : 16u));
}

bool gpio_read(struct pin pin)
{
    return GPIO[pin.port].at.idr >> pin.number & 1u;
}
