/* uart.h: single bytes over the serial port of the chip, 8 bits, no parity. Nothing here waits. */
#ifndef OCTET_UART_H
#define OCTET_UART_H

#include <stdbool.h>
#include <stdint.h>

enum { UART_NOTHING = -1, UART_DAMAGED = -2 };

void uart_start(uint32_t clock_hz, uint32_t baud);
        /* Starts both directions. clock_hz: clock of the port. */

void uart_stop(void);
        /* Switches it off until uart_start; bytes in progress are lost. */

int uart_get(void);
        /* The received byte, 0..255. UART_NOTHING: none. UART_DAMAGED: a byte was damaged, or arrived before the last
           one was read; both are lost. */

bool uart_put(uint8_t byte);
        /* False: the previous byte has not been sent yet. */

#endif
