/* core.h: what every Cortex-M has, register by register.
 *
 * Behind each register: what an access does (rw; r: read only; w: write only; w1c: writing 1 clears the bit) and
 * where it is described: PM0214 4.4, 4.5 (Cortex-M4), PM0056 4.4, 4.5 (Cortex-M3). The objects lie where sections.ld
 * puts them; a test defines its own. */
#ifndef OCTET_CORE_H
#define OCTET_CORE_H

#include <stdint.h>

struct systick_registers {
    uint32_t ctrl;            /* rw; reading clears bit 16 */
    uint32_t load;            /* rw   24 bits */
    uint32_t val;             /* rw; any write sets 0   24 bits, counts down */
    uint32_t calib;           /* r */
};

struct system_registers {
    uint32_t cpuid;           /* r */
    uint32_t icsr;            /* rw, some bits w */
    uint32_t vtor;            /* rw */
    uint32_t aircr;           /* rw, with a key in the high half */
    uint32_t scr;             /* rw */
    uint32_t ccr;             /* rw */
    uint32_t shpr[3];         /* rw */
    uint32_t shcsr;           /* rw */
    uint32_t cfsr;            /* w1c  configurable fault status */
    uint32_t hfsr;            /* w1c  hard fault status */
    uint32_t dfsr;            /* w1c */
    uint32_t mmfar;           /* rw   address of a memory fault */
    uint32_t bfar;            /* rw   address of a bus fault */
};

struct interrupt_registers {  /* PM0056 4.3: bit n of word m is for interrupt 32 m + n */
    uint32_t iser[32];        /* w1s  enable */
    uint32_t icer[32];        /* w1c  the same */
    uint32_t ispr[32];        /* w1s  pending */
    uint32_t icpr[32];        /* w1c  the same */
};

extern volatile struct systick_registers SYSTICK;
extern volatile struct system_registers SCB;
extern volatile struct interrupt_registers NVIC;

void core_sleep(void);
        /* Sleeps until an enabled interrupt is pending. None is ever taken: they only wake the core. */

#endif
