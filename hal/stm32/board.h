/* board.h: the pins of the board that this is built for. Its CMake file, hal/stm32/boards/NAME.cmake, says which. */
#ifndef OCTET_BOARD_H
#define OCTET_BOARD_H

#include <stdbool.h>
#include <stdint.h>

enum { PORT_A, PORT_B, PORT_C };

struct pin {
    uint8_t port;
    uint8_t number;   /* 0..15 */
};

static const struct pin BOARD_LED = {OCTET_LED};
static const struct pin BOARD_CAN_RX = {OCTET_CAN_RX};
static const struct pin BOARD_CAN_TX = {OCTET_CAN_TX};
static const struct pin BOARD_UART_RX = {OCTET_UART_RX};
static const struct pin BOARD_UART_TX = {OCTET_UART_TX};

static const bool BOARD_LED_HIGH = OCTET_LED_HIGH;   /* the pin is high while the LED shines */

#endif
