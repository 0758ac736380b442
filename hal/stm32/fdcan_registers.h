/* fdcan_registers.h: FDCAN, the controller of STM32G0, G4 and their like (RM0440 44), and its message RAM, whose
 * layout is fixed. Notation as in registers.h. */
#ifndef OCTET_FDCAN_REGISTERS_H
#define OCTET_FDCAN_REGISTERS_H

#include <stdint.h>

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

extern volatile struct fdcan_registers FDCAN;
extern volatile struct fdcan_ram FDCAN_RAM;   /* that of the same instance */

#endif
