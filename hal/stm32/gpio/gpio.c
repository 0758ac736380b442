/* Pins common to all boards. */
#include "hal/stm32/gpio/gpio.h"

#include "hal/port/cortex_m/mcu.h"

void gpio_start(void)
{
    gpio_set(BOARD_CAN_RX, GPIO_FROM, BOARD_CAN_RX_FUNCTION);
    gpio_set(BOARD_CAN_TX, GPIO_TO, BOARD_CAN_TX_FUNCTION);
    gpio_set(BOARD_UART_RX, GPIO_FROM, BOARD_UART_RX_FUNCTION);
    gpio_set(BOARD_UART_TX, GPIO_TO, BOARD_UART_TX_FUNCTION);
    gpio_set(BOARD_LED, GPIO_OUTPUT, 0);
}

void mcu_light(bool on)
{
    gpio_write(BOARD_LED, on == BOARD_LED_HIGH);
}
