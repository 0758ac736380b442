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

TEST(the_divisor_is_the_nearest)
{
    TEST_ASSERT_EQUAL_UINT32(67, UART0.uartibrd);
    TEST_ASSERT_EQUAL_UINT32(52, UART0.uartfbrd);   /* 67.8168 */
    core_hz = 12000000;
    uart_start(115200);
    TEST_ASSERT_EQUAL_UINT32(6, UART0.uartibrd);
    TEST_ASSERT_EQUAL_UINT32(33, UART0.uartfbrd);   /* 6.5104 */
}

TEST(it_starts_in_both_directions_with_queues)
{
    TEST_ASSERT_EQUAL_HEX32(0x70, UART0.uartlcr_h);
    TEST_ASSERT_EQUAL_HEX32(0x301, UART0.uartcr);
}

TEST(stopping_switches_the_port_off)
{
    uart_stop();
    TEST_ASSERT_EQUAL_HEX32(0, UART0.uartcr);
}

TEST(no_byte_is_nothing)
{
    UART0.uartfr = EMPTY;
    TEST_ASSERT_EQUAL(UART_NOTHING, uart_get());
}

TEST(a_byte_is_got_as_it_is)
{
    UART0.uartdr = 0xFF;
    TEST_ASSERT_EQUAL(0xFF, uart_get());
}

TEST(each_receive_error_is_told)
{
    for (uint32_t error = 1u << 8; error <= 1u << 11; error <<= 1) {
        UART0.uartdr = error | 'x';
        TEST_ASSERT_EQUAL(UART_DAMAGED, uart_get());
    }
}

TEST(a_byte_goes_out_with_the_next_look_at_what_was_received)
{
    TEST_ASSERT_TRUE(uart_put(0xA7));
    UART0.uartfr = EMPTY;
    (void)uart_get();
    TEST_ASSERT_EQUAL_HEX32(0xA7, UART0.uartdr);
}

TEST(what_the_port_does_not_take_waits_and_nothing_is_lost)
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
