/* stm32f405/registers.h: registers that differ on the STM32F405 (RM0090). Notation as in hal/stm32/registers.h. */
#ifndef OCTET_STM32F405_REGISTERS_H
#define OCTET_STM32F405_REGISTERS_H

#include <stdint.h>

struct rcc_registers {        /* 7.3.24 */
    uint32_t cr;              /* rw, ready bits r   7.3.1 */
    uint32_t pllcfgr;         /* rw while the PLL is off   7.3.2 */
    uint32_t cfgr;            /* rw, SWS r   7.3.3 */
    uint32_t cir;             /* rw */
    uint32_t reserved_1[8];
    uint32_t ahb1enr;         /* rw   7.3.10 */
    uint32_t reserved_2[3];
    uint32_t apb1enr;         /* rw   7.3.13 */
    uint32_t apb2enr;         /* rw   7.3.14 */
    uint32_t reserved_3[10];
    uint32_t bdcr;            /* rw */
    uint32_t csr;             /* reset flags r, RMVF rw   7.3.21 */
};

struct flash_registers {      /* 3.9.8 */
    uint32_t acr;             /* rw   3.9.1 */
    uint32_t keyr;            /* w    3.9.2 */
    uint32_t optkeyr;         /* w */
    uint32_t sr;              /* w1c, BSY r   3.9.4 */
    uint32_t cr;              /* rw once unlocked, STRT w1s   3.9.5 */
};

struct power_registers {      /* 5.5 */
    uint32_t cr;              /* rw, not 0 after a reset   5.5.1 */
    uint32_t csr;             /* r but for bits 8, 9   5.5.2 */
};

extern volatile struct rcc_registers RCC;
extern volatile struct power_registers PWR;
extern volatile struct flash_registers FLASH;

#endif
