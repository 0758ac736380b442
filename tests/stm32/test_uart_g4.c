#include "hal/stm32/uart.h"

#include <stddef.h>
#include <string.h>

#include <unity.h>

#include "hal/stm32/uart_g4_registers.h"

enum { RXNE = 32, TXE = 128 };

volatile struct uart_g4_registers UART;

void setUp(void)
{
    memset((void *)&UART, 0, sizeof UART);
}

void tearDown(void) {}

static void test_the_registers_lie_where_the_manual_has_them(void)
{
    TEST_ASSERT_EQUAL_HEX(0x0C, offsetof(struct uart_g4_registers, brr));
    TEST_ASSERT_EQUAL_HEX(0x1C, offsetof(struct uart_g4_registers, isr));
    TEST_ASSERT_EQUAL_HEX(0x20, offsetof(struct uart_g4_registers, icr));
    TEST_ASSERT_EQUAL_HEX(0x28, offsetof(struct uart_g4_registers, tdr));
    TEST_ASSERT_EQUAL_HEX(0x2C, offsetof(struct uart_g4_registers, presc));
}

static void test_the_divisor_is_the_nearest(void)
{
    uart_start(72000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(625, UART.brr);
    uart_start(80000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(694, UART.brr);   /* 694.44 */
    uart_start(42000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(365, UART.brr);   /* 364.58 */
}

static void test_it_starts_in_both_directions_with_fifo_and_without_interrupts(void)
{
    UART.cr2 = UART.cr3 = UART.presc = 0xFFFF;
    uart_start(72000000, 115200);
    TEST_ASSERT_EQUAL_HEX32(0x2000000D, UART.cr1);
    TEST_ASSERT_EQUAL_HEX32(0, UART.cr2 | UART.cr3 | UART.presc);
}

static void test_stopping_switches_the_port_off(void)
{
    uart_start(72000000, 115200);
    uart_stop();
    TEST_ASSERT_EQUAL_HEX32(0, UART.cr1);
}

static void test_no_byte_is_nothing(void)
{
    UART.rdr = 'x';
    TEST_ASSERT_EQUAL(UART_NOTHING, uart_get());
}

static void test_a_byte_is_got_as_it_is(void)
{
    UART.isr = RXNE;
    UART.rdr = 0x1FF;   /* the ninth bit is none of ours */
    TEST_ASSERT_EQUAL(0xFF, uart_get());
}

static void test_each_receive_error_is_told_and_cleared(void)
{
    for (uint32_t error = 1; error <= 8; error <<= 1) {
        UART.isr = RXNE | error;
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
        TEST_ASSERT_EQUAL_HEX32(error, UART.icr);
        UART.isr = error;
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
    }
}

static void test_a_byte_goes_out_when_there_is_room(void)
{
    UART.isr = TXE;
    TEST_ASSERT_TRUE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0xA7, UART.tdr);
}

static void test_without_room_nothing_is_written(void)
{
    UART.tdr = 0x55;
    UART.isr = ~(uint32_t)TXE;
    TEST_ASSERT_FALSE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0x55, UART.tdr);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_registers_lie_where_the_manual_has_them);
    RUN_TEST(test_the_divisor_is_the_nearest);
    RUN_TEST(test_it_starts_in_both_directions_with_fifo_and_without_interrupts);
    RUN_TEST(test_stopping_switches_the_port_off);
    RUN_TEST(test_no_byte_is_nothing);
    RUN_TEST(test_a_byte_is_got_as_it_is);
    RUN_TEST(test_each_receive_error_is_told_and_cleared);
    RUN_TEST(test_a_byte_goes_out_when_there_is_room);
    RUN_TEST(test_without_room_nothing_is_written);
    return UNITY_END();
}
