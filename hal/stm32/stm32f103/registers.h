/* stm32f103/registers.h: registers of the STM32F103 alone (RM0008, flash PM0075). Notation as in ../registers.h. */
#ifndef OCTET_STM32F103_REGISTERS_H
#define OCTET_STM32F103_REGISTERS_H

#include <stdint.h>

struct rcc_registers {        /* 7.3.11 */
    uint32_t cr;              /* rw, ready bits r   7.3.1 */
    uint32_t cfgr;            /* rw, SWS r; PLL bits while the PLL is off   7.3.2 */
    uint32_t cir;             /* rw */
    uint32_t apb2rstr;        /* rw */
    uint32_t apb1rstr;        /* rw */
    uint32_t ahbenr;          /* rw */
    uint32_t apb2enr;         /* rw   7.3.7 */
    uint32_t apb1enr;         /* rw   7.3.8 */
    uint32_t bdcr;            /* rw */
    uint32_t csr;             /* reset flags r, RMVF rw   7.3.10 */
};

struct flash_registers {      /* PM0075 3.9 */
    uint32_t acr;             /* rw   3.1 */
    uint32_t keyr;            /* w    3.2 */
    uint32_t optkeyr;         /* w */
    uint32_t sr;              /* w1c, BSY r   3.4 */
    uint32_t cr;              /* rw once unlocked, STRT w1s   3.5 */
    uint32_t ar;              /* w    page to erase   3.6 */
};

struct gpio_registers {       /* 9.5 */
    uint32_t cr[2];           /* rw   four bits a pin   9.2.1 */
    uint32_t idr;             /* r */
    uint32_t odr;             /* rw; also the direction of an input's pull */
    uint32_t bsrr;            /* w    low half sets, high half clears */
    uint32_t brr;             /* w */
    uint32_t lckr;            /* rw */
};

struct gpio_port {            /* one each 1 KB */
    struct gpio_registers at;
    uint32_t reserved[249];
};

struct afio_registers {       /* 9.5 */
    uint32_t evcr;            /* rw */
    uint32_t mapr;            /* rw, SWJ bits w   9.4.2 */
};

struct power_registers {      /* 5.4 */
    uint32_t cr;              /* rw   5.4.1 */
    uint32_t csr;             /* r but for bit 8   5.4.2 */
};

struct adc_registers {        /* 11.12.15 */
    uint32_t sr;              /* w0c */
    uint32_t cr1;             /* rw */
    uint32_t cr2;             /* rw, CAL and RSTCAL cleared when done */
    uint32_t smpr[2];         /* rw   three bits a channel: 10..17, 0..9 */
    uint32_t jofr[4];         /* rw */
    uint32_t htr;             /* rw */
    uint32_t ltr;             /* rw */
    uint32_t sqr[3];          /* rw   five bits a place: 13..16 and the number of them, 7..12, 1..6 */
    uint32_t jsqr;            /* rw */
    uint32_t jdr[4];          /* r */
    uint32_t dr;              /* r */
};

extern volatile struct adc_registers ADC1;
extern volatile struct rcc_registers RCC;
extern volatile struct power_registers PWR;
extern volatile struct flash_registers FLASH;
extern volatile struct gpio_port GPIO[5];   /* A..E */
extern volatile struct afio_registers AFIO;

#endif
