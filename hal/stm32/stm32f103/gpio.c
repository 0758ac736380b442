/* Four mode bits per pin (RM0008 9.2); AFIO routes the peripherals. */
#include "hal/stm32/gpio/gpio.h"

#include "hal/stm32/stm32f103/registers.h"

enum { ANALOGUE = 0, OUTPUT_2_MHZ = 2, PULLED = 8, ALTERNATE_50_MHZ = 11 };

void gpio_set(uint32_t pin, enum gpio_mode mode, uint32_t function)
{
    static const uint8_t modes[GPIO_MODES] = {
        [GPIO_ANALOGUE] = ANALOGUE, [GPIO_OUTPUT] = OUTPUT_2_MHZ, [GPIO_PULLED_UP] = PULLED, [GPIO_FROM] = PULLED,
        [GPIO_TO] = ALTERNATE_50_MHZ,
    };
    volatile uint32_t *reg = &GPIO[pin / PORT_PINS].at.cr[pin % PORT_PINS / 8];
    unsigned at = 4 * (pin % 8);

    (void)function;
    if (modes[mode] == PULLED)
        gpio_write(pin, true);
    *reg = (*reg & ~(15u << at)) | (uint32_t)modes[mode] << at;
}

void gpio_write(uint32_t pin, bool high)
{
    GPIO[pin / PORT_PINS].at.bsrr = 1u << (pin % PORT_PINS + (high ? 0u : 16u));
}

bool gpio_read(uint32_t pin)
{
    return GPIO[pin / PORT_PINS].at.idr >> pin % PORT_PINS & 1u;
}
