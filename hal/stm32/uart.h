/* uart.h: single bytes over the serial port of the chip, 8 bits, no parity. Nothing here waits. */
#ifndef OCTET_UART_H
#define OCTET_UART_H

#include <stdbool.h>
#include <stdint.h>

enum { UART_NOTHING = -1, UART_DAMAGED = -2 };

void uart_start(uint32_t clock_hz, uint32_t baud);
        /* Both directions. clock_hz: that the port runs from. */

void uart_stop(void);
        /* Off, until uart_start: what is under way is lost. */

int uart_get(void);
        /* The byte that has come, 0..255. UART_NOTHING: none. UART_DAMAGED: one came damaged, or came while the one before
           it had not been taken yet; both are gone. */

bool uart_put(uint8_t byte);
        /* False: the byte before it has not left yet. */

#endif
