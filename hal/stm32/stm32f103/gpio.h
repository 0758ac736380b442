/* stm32f103/gpio.h: the pins of an STM32F1 (RM0008 9.2): four bits of mode each. */
#ifndef OCTET_STM32F103_GPIO_H
#define OCTET_STM32F103_GPIO_H

#include "hal/stm32/board.h"

enum { GPIO_ANALOGUE = 0, GPIO_OUTPUT = 2, GPIO_PULLED = 8, GPIO_ALTERNATE = 11 };

void gpio_mode(struct pin pin, uint32_t mode);
void gpio_pull_up(struct pin pin);
        /* An input with a pull-up: an open one reads high. */

void gpio_write(struct pin pin, bool high);
bool gpio_read(struct pin pin);

#endif
