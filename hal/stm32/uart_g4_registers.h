/* uart_g4_registers.h: serial port of STM32F0, F3, G4, L4 and similar (RM0440 37.8). Notation as in registers.h. */
#ifndef OCTET_UART_G4_REGISTERS_H
#define OCTET_UART_G4_REGISTERS_H

#include <stdint.h>

struct uart_g4_registers {
    uint32_t cr1;             /* rw; FIFOEN while UE is 0 */
    uint32_t cr2;             /* rw while UE is 0 */
    uint32_t cr3;             /* rw while UE is 0 */
    uint32_t brr;             /* rw while UE is 0   clock over baud rate */
    uint32_t gtpr;            /* rw */
    uint32_t rtor;            /* rw */
    uint32_t rqr;             /* w */
    uint32_t isr;             /* r    status */
    uint32_t icr;             /* w1c  clears flags of isr */
    uint32_t rdr;             /* r; takes the oldest byte from the FIFO, with its error flags */
    uint32_t tdr;             /* rw */
    uint32_t presc;           /* rw while UE is 0 */
};

extern volatile struct uart_g4_registers UART;

#endif
