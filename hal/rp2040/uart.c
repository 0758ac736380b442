/* The serial port, a PL011 with FIFOs of 32 bytes (data sheet 4.2). */
#include "hal/port/cortex_m/uart.h"

#include "hal/rp2040/machine.h"
#include "hal/rp2040/registers.h"

enum {
    DR_ERRORS = 15 << 8,   /* framing, parity, break, overrun */
    FR_RXFE = 1 << 4,
    FR_TXFF = 1 << 5,
    LCR_FEN = 1 << 4,
    LCR_8_BITS = 3 << 5,
    CR_UARTEN = 1 << 0,
    CR_TXE = 1 << 8,
    CR_RXE = 1 << 9,
    QUEUE = 256
};

/* Bytes that wait for the transmitter: a tick's frames take some 4 ms, in which a body on pins has other work. */
static struct {
    uint8_t bytes[QUEUE];
    uint8_t first;
    uint16_t count;
} queue;

static void transmit(void)
{
    while (queue.count > 0 && !(UART0.uartfr & FR_TXFF)) {
        UART0.uartdr = queue.bytes[queue.first];
        queue.first++;
        queue.count--;
    }
}

void uart_start(uint32_t baud)
{
    uint32_t divisor = (machine_clocks().core_hz * 4u + baud / 2) / baud;   /* of a sixteenth of the clock, in 1/64 */

    uart_stop();
    UART0.uartibrd = divisor / 64;
    UART0.uartfbrd = divisor % 64;
    UART0.uartlcr_h = LCR_8_BITS | LCR_FEN;
    UART0.uartcr = CR_UARTEN | CR_TXE | CR_RXE;
}

void uart_stop(void)
{
    UART0.uartcr = 0;
    queue.count = 0;
}

int uart_get(void)
{
    uint32_t data;

    transmit();
    if (UART0.uartfr & FR_RXFE)
        return UART_NOTHING;
    data = UART0.uartdr;
    return data & DR_ERRORS ? UART_DAMAGED : (int)(data & 0xFF);
}

/* The queue moves on with the next look at what was received. */
bool uart_put(uint8_t byte)
{
    if (queue.count == QUEUE)
        transmit();
    if (queue.count == QUEUE)
        return false;
    queue.bytes[(queue.first + queue.count) % QUEUE] = byte;
    queue.count++;
    return true;
}
