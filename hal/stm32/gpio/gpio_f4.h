/* gpio_f4.h: the pins of STM32F4, G4 and their like (RM0090 8.4, RM0440 9.4): a mode and a function each. Notation as
 * in registers.h. */
#ifndef OCTET_GPIO_F4_H
#define OCTET_GPIO_F4_H

#include <stdint.h>

struct gpio_registers {
    uint32_t moder;           /* rw   two bits a pin */
    uint32_t otyper;          /* rw */
    uint32_t ospeedr;         /* rw */
    uint32_t pupdr;           /* rw   two bits a pin */
    uint32_t idr;             /* r */
    uint32_t odr;             /* rw */
    uint32_t bsrr;            /* w    low half sets, high half clears */
    uint32_t lckr;            /* rw */
    uint32_t afr[2];          /* rw   four bits a pin */
};

struct gpio_port {            /* one each 1 KB */
    struct gpio_registers at;
    uint32_t reserved[246];
};

extern volatile struct gpio_port GPIO[];   /* from A on */

#endif
