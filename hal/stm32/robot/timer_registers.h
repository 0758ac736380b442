/* timer_registers.h: timers and DMA, which STM32F1 and G4 have alike (F1: RM0008, G4: RM0440, which has more behind
 * them). Notation as in registers.h. */
#ifndef OCTET_TIMER_REGISTERS_H
#define OCTET_TIMER_REGISTERS_H

#include <stdint.h>

struct timer_registers {      /* F1 14.4.21 (TIM1), 15.4.19 (TIM2..4, without rcr and bdtr), G4 28, 29 */
    uint32_t cr1;             /* rw */
    uint32_t cr2;             /* rw */
    uint32_t smcr;            /* rw   slave mode: encoder, external clock */
    uint32_t dier;            /* rw   interrupts */
    uint32_t sr;              /* w0c  status */
    uint32_t egr;             /* w    events */
    uint32_t ccmr[2];         /* rw   channels 1, 2 and 3, 4 */
    uint32_t ccer;            /* rw */
    uint32_t cnt;             /* rw */
    uint32_t psc;             /* rw */
    uint32_t arr;             /* rw */
    uint32_t rcr;             /* rw   an update in as many + 1 periods */
    uint32_t ccr[4];          /* rw */
    uint32_t bdtr;            /* rw, BIF by hardware   break */
};

struct dma_registers {        /* F1 13.4.7, G4 12 */
    uint32_t isr;             /* r */
    uint32_t ifcr;            /* w1c */
    struct {
        uint32_t ccr;         /* rw */
        uint32_t cndtr;       /* rw while off */
        uint32_t cpar;        /* rw while off */
        uint32_t cmar;        /* rw while off */
        uint32_t reserved;
    } channel[7];             /* 1..7 */
};

extern volatile struct timer_registers TIM1, TIM2, TIM3, TIM4;
extern volatile struct dma_registers DMA1;

#endif
