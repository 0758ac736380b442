/* gpio.h: one pin at a time. */
#ifndef OCTET_RP2040_GPIO_H
#define OCTET_RP2040_GPIO_H

#include <stdbool.h>
#include <stdint.h>

enum gpio_function { GPIO_UART = 2, GPIO_BY_PWM = 4, GPIO_BY_CORE = 5 };   /* data sheet 1.4.3 */

void gpio_set(uint32_t pin, enum gpio_function function);
        /* Connects a pin to what drives or reads it, pulled up while nothing drives it. */

void gpio_analogue(uint32_t pin);
        /* Disconnects all but the ADC from a pin. */

void gpio_output(uint32_t pin);
void gpio_write(uint32_t pin, bool high);
bool gpio_read(uint32_t pin);
        /* For a pin of GPIO_BY_CORE. */

#endif
