#include "hal/stm32/uart.h"

#include <string.h>

#include <unity.h>

#include "hal/stm32/registers.h"

enum { RXNE = 32, TXE = 128 };

volatile struct usart_registers USART1;

void setUp(void)
{
    memset((void *)&USART1, 0, sizeof USART1);
}

void tearDown(void) {}

static void test_the_divisor_is_the_nearest(void)
{
    uart_start(72000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(625, USART1.brr);
    uart_start(84000000, 115200);
    TEST_ASSERT_EQUAL_UINT32(729, USART1.brr);
}

static void test_it_starts_in_both_directions_without_interrupts(void)
{
    USART1.cr2 = USART1.cr3 = 0xFFFF;
    uart_start(72000000, 115200);
    TEST_ASSERT_EQUAL_HEX32(0x200C, USART1.cr1);
    TEST_ASSERT_EQUAL_HEX32(0, USART1.cr2 | USART1.cr3);
}

static void test_it_stops(void)
{
    uart_start(72000000, 115200);
    uart_stop();
    TEST_ASSERT_EQUAL_HEX32(0, USART1.cr1);
}

static void test_no_byte_is_nothing(void)
{
    USART1.dr = 'x';
    TEST_ASSERT_EQUAL(UART_NOTHING, uart_get());
}

static void test_a_byte_is_got_as_it_is(void)
{
    USART1.sr = RXNE;
    USART1.dr = 0x1FF;   /* the ninth bit is none of ours */
    TEST_ASSERT_EQUAL(0xFF, uart_get());
}

static void test_each_receive_error_is_told(void)
{
    for (uint32_t error = 1; error <= 8; error <<= 1) {
        USART1.sr = RXNE | error;
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
        USART1.sr = error;
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
    }
}

static void test_a_byte_goes_out_when_there_is_room(void)
{
    USART1.sr = TXE;
    TEST_ASSERT_TRUE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0xA7, USART1.dr);
}

static void test_without_room_nothing_is_written(void)
{
    USART1.dr = 0x55;
    TEST_ASSERT_FALSE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0x55, USART1.dr);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_divisor_is_the_nearest);
    RUN_TEST(test_it_starts_in_both_directions_without_interrupts);
    RUN_TEST(test_it_stops);
    RUN_TEST(test_no_byte_is_nothing);
    RUN_TEST(test_a_byte_is_got_as_it_is);
    RUN_TEST(test_each_receive_error_is_told);
    RUN_TEST(test_a_byte_goes_out_when_there_is_room);
    RUN_TEST(test_without_room_nothing_is_written);
    return UNITY_END();
}
