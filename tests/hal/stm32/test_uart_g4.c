#include "hal/stm32/uart.h"

#include <stddef.h>
#include <string.h>

#include "tests/test.h"
#include "hal/stm32/uart_g4_registers.h"

enum { RXNE = 32, TXE = 128 };

volatile struct uart_g4_registers UART;

void setUp(void)
{
    memset((void *)&UART, 0, sizeof UART);
}

TEST(the_registers_lie_where_the_manual_has_them)
{
    TEST_ASSERT_EQUAL_HEX(0x0C, offsetof(struct uart_g4_registers, brr));
    TEST_ASSERT_EQUAL_HEX(0x1C, offsetof(struct uart_g4_registers, isr));
    TEST_ASSERT_EQUAL_HEX(0x20, offsetof(struct uart_g4_registers, icr));
    TEST_ASSERT_EQUAL_HEX(0x28, offsetof(struct uart_g4_registers, tdr));
    TEST_ASSERT_EQUAL_HEX(0x2C, offsetof(struct uart_g4_registers, presc));
}

TEST(the_divisor_is_the_nearest)
{
    uart_start(72000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(625, UART.brr);
    uart_start(80000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(694, UART.brr);   /* 694.44 */
    uart_start(42000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(365, UART.brr);   /* 364.58 */
}

TEST(it_starts_in_both_directions_with_fifo_and_without_interrupts)
{
    UART.cr2 = UART.cr3 = UART.presc = 0xFFFF;
    uart_start(72000000, 115200);
    TEST_ASSERT_EQUAL_HEX32(0x2000000D, UART.cr1);
    TEST_ASSERT_EQUAL_HEX32(0, UART.cr2 | UART.cr3 | UART.presc);
}

TEST(stopping_switches_the_port_off)
{
    uart_start(72000000, 115200);
    uart_stop();
    TEST_ASSERT_EQUAL_HEX32(0, UART.cr1);
}

TEST(no_byte_is_nothing)
{
    UART.rdr = 'x';
    TEST_ASSERT_EQUAL(UART_NOTHING, uart_get());
}

TEST(a_byte_is_got_as_it_is)
{
    UART.isr = RXNE;
    UART.rdr = 0x1FF;   /* the ninth bit is none of ours */
    TEST_ASSERT_EQUAL(0xFF, uart_get());
}

TEST(each_receive_error_is_told_and_cleared)
{
    for (uint32_t error = 1; error <= 8; error <<= 1) {
        UART.isr = RXNE | error;
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
        TEST_ASSERT_EQUAL_HEX32(error, UART.icr);
        UART.isr = error;
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
    }
}

TEST(a_byte_goes_out_when_there_is_room)
{
    UART.isr = TXE;
    TEST_ASSERT_TRUE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0xA7, UART.tdr);
}

TEST(without_room_nothing_is_written)
{
    UART.tdr = 0x55;
    UART.isr = ~(uint32_t)TXE;
    TEST_ASSERT_FALSE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0x55, UART.tdr);
}
