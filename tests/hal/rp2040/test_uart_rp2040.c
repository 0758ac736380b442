#include "hal/port/cortex_m/uart.h"

#include <string.h>

#include "tests/test.h"
#include "hal/rp2040/machine.h"
#include "hal/rp2040/registers.h"

enum { EMPTY = 1 << 4, FULL = 1 << 5 };

volatile struct uart_registers UART0;

static uint32_t core_hz;

struct clocks machine_clocks(void)
{
    return (struct clocks){core_hz, true};
}

void setUp(void)
{
    memset((void *)&UART0, 0, sizeof UART0);
    core_hz = 125000000;
    uart_start(115200);
}

TEST(uart_divisor_is_the_nearest)
{
    TEST_ASSERT_EQUAL_UINT32(67, UART0.uartibrd);
    TEST_ASSERT_EQUAL_UINT32(52, UART0.uartfbrd);   /* 67.8168 */
    core_hz = 12000000;
    uart_start(115200);
    TEST_ASSERT_EQUAL_UINT32(6, UART0.uartibrd);
    TEST_ASSERT_EQUAL_UINT32(33, UART0.uartfbrd);   /* 6.5104 */
}

TEST(uart_starts_both_directions_with_fifos)
{
    TEST_ASSERT_EQUAL_HEX32(0x70, UART0.uartlcr_h);
    TEST_ASSERT_EQUAL_HEX32(0x301, UART0.uartcr);
}

TEST(uart_stop_disables_the_port)
{
    uart_stop();
    TEST_ASSERT_EQUAL_HEX32(0, UART0.uartcr);
}

TEST(uart_get_returns_nothing_without_a_byte)
{
    UART0.uartfr = EMPTY;
    TEST_ASSERT_EQUAL(UART_NOTHING, uart_get());
}

TEST(uart_get_returns_the_received_byte)
{
    UART0.uartdr = 0xFF;
    TEST_ASSERT_EQUAL(0xFF, uart_get());
}

TEST(uart_get_reports_every_receive_error)
{
    for (uint32_t error = 1u << 8; error <= 1u << 11; error <<= 1) {
        UART0.uartdr = error | 'x';
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
    }
}

TEST(uart_get_sends_a_queued_byte)
{
    TEST_ASSERT_TRUE(uart_put(0xA7));
    UART0.uartfr = EMPTY;
    (void)uart_get();
    TEST_ASSERT_EQUAL_HEX32(0xA7, UART0.uartdr);
}

TEST(uart_put_queues_256_bytes_and_loses_none)
{
    UART0.uartdr = 0x55;
    UART0.uartfr = FULL | EMPTY;
    for (unsigned i = 0; i < 256; i++)
        TEST_ASSERT_TRUE(uart_put((uint8_t)i));
    TEST_ASSERT_FALSE(uart_put(0xA7));
    (void)uart_get();
    TEST_ASSERT_EQUAL_HEX32(0x55, UART0.uartdr);
    UART0.uartfr = EMPTY;
    TEST_ASSERT_TRUE(uart_put(0xA7));
    TEST_ASSERT_EQUAL_HEX32(0xFF, UART0.uartdr);   /* the last of them */
    (void)uart_get();
    TEST_ASSERT_EQUAL_HEX32(0xA7, UART0.uartdr);
}
