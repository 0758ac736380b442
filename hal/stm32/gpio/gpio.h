/* gpio.h: the pins of a chip, numbered as in board.h, once their ports have power. */
#ifndef OCTET_GPIO_H
#define OCTET_GPIO_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/stm32/board.h"

enum gpio_mode {
    GPIO_ANALOGUE,
    GPIO_OUTPUT,
    GPIO_PULLED_UP,   /* an input: an open one reads high */
    GPIO_FROM,        /* the input of a peripheral, pulled up */
    GPIO_TO,          /* the output of one */
    GPIO_MODES
};

void gpio_set(uint32_t pin, enum gpio_mode mode, uint32_t function);
        /* function: the number of the peripheral's, such as BOARD_CAN_RX_FUNCTION, in chips whose pins choose theirs. */

void gpio_write(uint32_t pin, bool high);
bool gpio_read(uint32_t pin);

void gpio_start(void);
        /* The board's LED, CAN and serial port get their pins. An open receive pin reads idle. */

#endif
