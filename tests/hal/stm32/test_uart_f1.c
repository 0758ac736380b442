#include "hal/stm32/uart.h"

#include <string.h>

#include "tests/test.h"
#include "hal/stm32/registers.h"

enum { RXNE = 32, TXE = 128 };

volatile struct usart_registers UART;

void setUp(void)
{
    memset((void *)&UART, 0, sizeof UART);
}

TEST(the_divisor_is_the_nearest)
{
    uart_start(72000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(625, UART.brr);
    uart_start(84000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(729, UART.brr);   /* 729.17 */
    uart_start(42000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(365, UART.brr);   /* 364.58 */
}

TEST(it_starts_in_both_directions_without_interrupts)
{
    UART.cr2 = UART.cr3 = 0xFFFF;
    uart_start(72000000, 115200);
    TEST_ASSERT_EQUAL_HEX32(0x200C, UART.cr1);
    TEST_ASSERT_EQUAL_HEX32(0, UART.cr2 | UART.cr3);
}

TEST(stopping_switches_the_port_off)
{
    uart_start(72000000, 115200);
    uart_stop();
    TEST_ASSERT_EQUAL_HEX32(0, UART.cr1);
}

TEST(no_byte_is_nothing)
{
    UART.dr = 'x';
    TEST_ASSERT_EQUAL(UART_NOTHING, uart_get());
}

TEST(a_byte_is_got_as_it_is)
{
    UART.sr = RXNE;
    UART.dr = 0x1FF;   /* the ninth bit is none of ours */
    TEST_ASSERT_EQUAL(0xFF, uart_get());
}

TEST(each_receive_error_is_told)
{
    for (uint32_t error = 1; error <= 8; error <<= 1) {
        UART.sr = RXNE | error;
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
        UART.sr = error;
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
    }
}

TEST(a_byte_goes_out_when_there_is_room)
{
    UART.sr = TXE;
    TEST_ASSERT_TRUE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0xA7, UART.dr);
}

TEST(without_room_nothing_is_written)
{
    UART.dr = 0x55;
    UART.sr = ~(uint32_t)TXE;
    TEST_ASSERT_FALSE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0x55, UART.dr);
}
