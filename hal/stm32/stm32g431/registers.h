/* stm32g431/registers.h: registers that differ on the STM32G431 (RM0440). Notation as in hal/stm32/registers.h. */
#ifndef OCTET_STM32G431_REGISTERS_H
#define OCTET_STM32G431_REGISTERS_H

#include <stdint.h>

struct rcc_registers {        /* 7.4 */
    uint32_t cr;              /* rw, ready bits r */
    uint32_t icscr;           /* rw */
    uint32_t cfgr;            /* rw, SWS r */
    uint32_t pllcfgr;         /* rw while the PLL is off */
    uint32_t reserved_1[2];
    uint32_t cier;            /* rw */
    uint32_t cifr;            /* r */
    uint32_t cicr;            /* w1c */
    uint32_t reserved_2;
    uint32_t ahb_rstr[3];     /* rw */
    uint32_t reserved_3;
    uint32_t apb_rstr[3];     /* rw */
    uint32_t reserved_4;
    uint32_t ahb1enr;         /* rw */
    uint32_t ahb2enr;         /* rw */
    uint32_t ahb3enr;         /* rw */
    uint32_t reserved_5;
    uint32_t apb1enr1;        /* rw */
    uint32_t apb1enr2;        /* rw */
    uint32_t apb2enr;         /* rw */
    uint32_t reserved_6[9];
    uint32_t ccipr;           /* rw   clocks of peripherals */
    uint32_t reserved_7;
    uint32_t bdcr;            /* rw */
    uint32_t csr;             /* reset flags r, RMVF rw */
};

struct flash_registers {      /* 5.7 */
    uint32_t acr;             /* rw */
    uint32_t pdkeyr;          /* w */
    uint32_t keyr;            /* w */
    uint32_t optkeyr;         /* w */
    uint32_t sr;              /* w1c, BSY r */
    uint32_t cr;              /* rw once unlocked, STRT w1s */
    uint32_t eccr;            /* flags w1c, address r   error correction */
};

struct power_registers {      /* 6.4 */
    uint32_t cr1;             /* rw */
    uint32_t cr2;             /* rw   6.4.2 */
    uint32_t cr3;             /* rw */
    uint32_t cr4;             /* rw */
    uint32_t sr1;             /* r */
    uint32_t sr2;             /* r   6.4.6 */
};

struct adc_registers {        /* 21.7 */
    uint32_t isr;             /* w1c */
    uint32_t ier;             /* rw */
    uint32_t cr;              /* rw, bits 0..5 and 31 w1s and cleared when done */
    uint32_t cfgr;            /* rw while not begun */
    uint32_t cfgr2;           /* rw */
    uint32_t smpr[2];         /* rw   three bits a channel: 0..9, 10..18 */
    uint32_t reserved_1[5];
    uint32_t sqr[4];          /* rw   six bits a place: the number of them less 1 and 1..4, 5..9, 10..14, 15 and 16 */
    uint32_t dr;              /* r */
    uint32_t reserved_2[175];
    struct {                  /* of ADC1 and ADC2 */
        uint32_t csr;         /* r */
        uint32_t reserved;
        uint32_t ccr;         /* rw */
    } common;                 /* at 0x300 */
};

struct dmamux_registers {     /* 13.6 */
    uint32_t ccr[12];         /* rw   whose request each channel serves */
};

extern volatile struct adc_registers ADC1;
extern volatile struct dmamux_registers DMAMUX;
extern volatile struct rcc_registers RCC;
extern volatile struct power_registers PWR;
extern volatile struct flash_registers FLASH;

#endif
