/* uart.h: single bytes over the serial port of the chip, 8 bits, no parity. Nothing here waits. */
#ifndef OCTET_UART_H
#define OCTET_UART_H

#include <stdbool.h>
#include <stdint.h>

enum { UART_NOTHING = -1, UART_DAMAGED = -2 };

void uart_start(uint32_t baud);
        /* Starts both directions. */

void uart_stop(void);
        /* Switches it off until uart_start; bytes in progress are lost. */

int uart_get(void);
        /* The received byte, 0..255. UART_NOTHING: none. UART_DAMAGED: a byte was damaged, or arrived before the last
           one was read; both are lost. */

bool uart_put(uint8_t byte);
        /* False: there is no room for it yet. A port may keep bytes, and send them in later calls of uart_get. */

/* For code that busies the core for longer than a byte takes on a serial line. */

void line_pump(void);
        /* Buffers what the link has received so far, if it would be lost otherwise. A byte takes 87 us. */

#endif
