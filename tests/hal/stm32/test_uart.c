/* What every chip's serial port has to do. Built once for each kind, with UART_EXPECTED: the header that says what its registers
 * are called and what they hold. */
#include "hal/port/cortex_m/uart.h"

#include <string.h>

#include "tests/test.h"
#include "hal/stm32/chip.h"
#include UART_EXPECTED

enum { RXNE = 32, TXE = 128 };

static uint32_t usart_hz;

struct clocks machine_clocks(void)
{
    return (struct clocks){.usart_hz = usart_hz};
}

static void start(uint32_t clock_hz)
{
    usart_hz = clock_hz;
    uart_start(115200);
}

void setUp(void)
{
    memset((void *)&UART, 0, sizeof UART);
}

TEST(uart_divisor_is_the_nearest)
{
    start(72000000);
    TEST_ASSERT_EQUAL_UINT32(625, UART.brr);
    start(84000000);
    TEST_ASSERT_EQUAL_UINT32(729, UART.brr);   /* 729.17 */
    start(80000000);
    TEST_ASSERT_EQUAL_UINT32(694, UART.brr);   /* 694.44 */
    start(42000000);
    TEST_ASSERT_EQUAL_UINT32(365, UART.brr);   /* 364.58 */
}

TEST(uart_starts_both_directions_without_interrupts)
{
    memset((void *)&UART, 0xFF, sizeof UART);
    start(72000000);
    assert_started();
}

TEST(uart_stop_disables_the_port)
{
    start(72000000);
    uart_stop();
    TEST_ASSERT_EQUAL_HEX32(0, UART.cr1);
}

TEST(uart_get_returns_nothing_without_a_byte)
{
    UART.RECEIVED = 'x';
    TEST_ASSERT_EQUAL(UART_NOTHING, uart_get());
}

TEST(uart_get_returns_the_received_byte)
{
    UART.STATUS = RXNE;
    UART.RECEIVED = 0x1FF;   /* the ninth bit is none of ours */
    TEST_ASSERT_EQUAL(0xFF, uart_get());
}

TEST(uart_get_reports_every_receive_error)
{
    for (uint32_t error = 1; error <= 8; error <<= 1) {
        UART.STATUS = RXNE | error;
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
        assert_cleared(error);
        UART.STATUS = error;
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
    }
}

TEST(uart_put_sends_a_byte_if_there_is_room)
{
    UART.STATUS = TXE;
    TEST_ASSERT_TRUE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0xA7, UART.SENT);
}

TEST(uart_put_refuses_a_byte_without_room)
{
    UART.SENT = 0x55;
    UART.STATUS = ~(uint32_t)TXE;
    TEST_ASSERT_FALSE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0x55, UART.SENT);
}
