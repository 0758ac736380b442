/* registers.h: the peripherals that several of our chips have alike, register by register.
 *
 * Behind each register: what an access does (rw; r: read only; w1c: writing 1 clears the bit, 0 leaves it; w1s:
 * writing 1 sets it; w: write only) and where the manuals describe it: F4 is RM0090, F1 is RM0008. The objects lie
 * where the chip's linker script puts them, which says which instance they are; a test defines its own. */
#ifndef OCTET_REGISTERS_H
#define OCTET_REGISTERS_H

#include <stdint.h>

struct can_mailbox {          /* F4 32.9.3, F1 24.9.3 */
    uint32_t id;              /* rw; no reset value: write it whole. A sent one: bit 0 asks for transmission */
    uint32_t length;          /* rw; no reset value */
    uint32_t data[2];         /* rw; first byte lowest */
};

struct can_registers {        /* F4 32.9.5, F1 24.9.5 */
    uint32_t mcr;             /* rw   master control           F4 32.9.2, F1 24.9.2 */
    uint32_t msr;             /* r, bits 4..2 w1c   master status */
    uint32_t tsr;             /* r, bits 0..3, 8..11, 16..19 w1c, ABRQ bits w1s   transmit status */
    uint32_t rfr[2];          /* r, bits 3, 4 w1c, bit 5 w1s   receive FIFO 0, 1 */
    uint32_t ier;             /* rw   interrupt enable */
    uint32_t esr;             /* bits 6..4 rw, else r   error status */
    uint32_t btr;             /* rw in initialization only   bit timing */
    uint32_t reserved_1[88];
    struct can_mailbox sent[3];
    struct can_mailbox received[2];   /* r */
    uint32_t reserved_2[12];
    uint32_t fmr;             /* rw   filter master            F4 32.9.4, F1 24.9.4 */
    uint32_t fm1r;            /* rw while FINIT   bit n: bank n is a list, not a mask */
    uint32_t reserved_3;
    uint32_t fs1r;            /* rw while FINIT   bit n: bank n holds 32-bit filters, not 16-bit */
    uint32_t reserved_4;
    uint32_t ffa1r;           /* rw while FINIT   bit n: bank n feeds FIFO 1, not 0 */
    uint32_t reserved_5;
    uint32_t fa1r;            /* rw   bit n: bank n is in use */
    uint32_t reserved_6[8];
    uint32_t bank[14][2];     /* rw while FINIT or unused */
};

struct usart_registers {      /* F4 30.6.8, F1 27.6.8 */
    uint32_t sr;              /* r; TC and RXNE also clear with 0   status   F4 30.6.1, F1 27.6.1 */
    uint32_t dr;              /* rw; reading sr, then this, clears RXNE and the receive errors */
    uint32_t brr;             /* rw   clock over baud rate */
    uint32_t cr1;             /* rw */
    uint32_t cr2;             /* rw */
    uint32_t cr3;             /* rw */
    uint32_t gtpr;            /* rw */
};

struct watchdog_registers {   /* F4 21.4.5, F1 19.4.5 */
    uint32_t kr;              /* w    key */
    uint32_t pr;              /* rw once unlocked, while sr is 0   prescaler */
    uint32_t rlr;             /* rw once unlocked, while sr is 0   reload */
    uint32_t sr;              /* r    update under way */
};

/* Timers and DMA, which F1 and G4 (RM0440) have alike; G4 has more behind them. */

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

/* FDCAN, the controller of STM32G0, G4 and their like (RM0440 44), and its message RAM, whose layout is fixed. */

struct fdcan_fifo {
    uint32_t status;          /* r */
    uint32_t read;            /* rw   place of the element that has been read: releases it */
};

struct fdcan_registers {      /* 44.4 */
    uint32_t crel;            /* r */
    uint32_t endn;            /* r */
    uint32_t reserved_1;
    uint32_t dbtp;            /* rw while CCE */
    uint32_t test;            /* rw while CCCR.TEST */
    uint32_t rwd;             /* rw while CCE */
    uint32_t cccr;            /* rw   control: INIT is read back later; CCE, and all but INIT, only while INIT */
    uint32_t nbtp;            /* rw while CCE   bit timing */
    uint32_t tscc;            /* rw while CCE */
    uint32_t tscv;            /* rw */
    uint32_t tocc;            /* rw while CCE */
    uint32_t tocv;            /* rw */
    uint32_t reserved_2[4];
    uint32_t ecr;             /* r    error counters */
    uint32_t psr;             /* r; reading resets the last error codes   protocol status */
    uint32_t tdcr;            /* rw while CCE */
    uint32_t reserved_3;
    uint32_t ir;              /* w1c  interrupt flags */
    uint32_t ie;              /* rw   interrupt enable */
    uint32_t ils;             /* rw */
    uint32_t ile;             /* rw   interrupt lines enable */
    uint32_t reserved_4[8];
    uint32_t rxgfc;           /* rw while CCE   what becomes of frames that no filter matches; number of filters */
    uint32_t xidam;           /* rw while CCE */
    uint32_t hpms;            /* r */
    uint32_t reserved_5;
    struct fdcan_fifo rxf[2]; /* receive FIFO 0, 1 */
    uint32_t reserved_6[8];
    uint32_t txbc;            /* rw while CCE   buffers as a FIFO, or as a queue by identifier */
    uint32_t txfqs;           /* r    the next buffer that is free */
    uint32_t txbrp;           /* r    bit n: buffer n waits to be sent; reset by CCE */
    uint32_t txbar;           /* w1s  bit n: send buffer n */
    uint32_t txbcr;           /* w1s  bit n: cancel buffer n */
    uint32_t txbto;           /* r */
    uint32_t txbcf;           /* r */
    uint32_t txbtie;          /* rw */
    uint32_t txbcie;          /* rw */
    uint32_t txefs;           /* r */
    uint32_t txefa;           /* rw */
};

struct fdcan_element {        /* 44.3.15, 44.3.17 */
    uint32_t id;
    uint32_t control;
    uint32_t data[16];        /* first byte lowest */
};

enum { FDCAN_FILTERS = 28, FDCAN_ELEMENTS = 3 };

struct fdcan_ram {            /* 44.3.14; rw by whole words, no reset value */
    uint32_t standard_filters[FDCAN_FILTERS];
    uint32_t extended_filters[8][2];
    struct fdcan_element received[2][FDCAN_ELEMENTS];   /* FIFO 0, 1 */
    uint32_t events[3][2];
    struct fdcan_element sent[FDCAN_ELEMENTS];
};

extern volatile struct can_registers CAN1;
extern volatile struct usart_registers UART;
extern volatile struct watchdog_registers IWDG;
extern volatile struct timer_registers TIM1, TIM2, TIM3, TIM4;
extern volatile struct dma_registers DMA1;
extern volatile struct fdcan_registers FDCAN;
extern volatile struct fdcan_ram FDCAN_RAM;   /* that of the same instance */

#endif
