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

extern volatile struct can_registers CAN1;
extern volatile struct usart_registers UART;
extern volatile struct watchdog_registers IWDG;

#endif
