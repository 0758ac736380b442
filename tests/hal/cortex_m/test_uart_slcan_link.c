#include <string.h>

#include "hal/link/link.h"
#include "hal/port/cortex_m/systick.h"
#include "hal/port/cortex_m/uart.h"
#include "tests/test.h"

enum { TEXT_MAX = 1024, LOOK_US = 10, BYTE_US = 87, FIFO_MAX = 32, DAMAGED = '\x80', NEVER = 0 };

/* The fake line: a byte each way every 87 us, of which the port holds one or some; what comes then is lost, and noticed.
 * Time passes with each look at the clock. */
static struct {
    uint32_t now_us, next_us, look_us, byte_us;
    char in[TEXT_MAX], out[TEXT_MAX];
    unsigned in_len, in_at, out_len;
    char held[FIFO_MAX];
    unsigned held_count, depth;
    bool overrun;
    uint32_t busy_until_us;
    unsigned blocked_from;      /* from this byte on, counted from 1, nothing goes out */
    uint32_t baud;
    bool on;
} fake;

static struct link *link_here;
static struct frame frame;

uint32_t machine_ms(void)
{
    fake.now_us += fake.look_us;
    return fake.now_us / 1000;
}

void uart_start(uint32_t baud)
{
    fake.baud = baud;
    fake.on = true;
}

void uart_stop(void)
{
    fake.on = false;
}

static void arrive(void)
{
    while (fake.in_at < fake.in_len && fake.now_us >= fake.next_us && (fake.byte_us || fake.held_count < fake.depth)) {
        if (fake.held_count < fake.depth)
            fake.held[fake.held_count++] = fake.in[fake.in_at];
        else
            fake.overrun = true;
        fake.in_at++;
        fake.next_us += fake.byte_us;
    }
}

int uart_get(void)
{
    bool damaged;
    char byte;

    arrive();
    damaged = fake.overrun;
    if (fake.held_count == 0)
        return UART_NOTHING;
    byte = fake.held[0];
    memmove(fake.held, fake.held + 1, --fake.held_count);
    fake.overrun = false;
    return damaged || byte == DAMAGED ? UART_DAMAGED : byte;
}

bool uart_put(uint8_t byte)
{
    if (fake.now_us < fake.busy_until_us || fake.out_len + 1 == fake.blocked_from)
        return false;
    fake.busy_until_us = fake.now_us + BYTE_US;
    fake.out[fake.out_len++] = (char)byte;
    return true;
}

void setUp(void)
{
    static const uint16_t ids[] = {0x0C1, 0x041};

    memset(&fake, 0, sizeof fake);
    fake.look_us = LOOK_US;
    fake.byte_us = BYTE_US;
    fake.depth = 1;
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, 2));
}

static void comes(const char *text)
{
    size_t len = strlen(text);

    arrive();
    if (fake.in_at == fake.in_len)
        fake.next_us = fake.now_us + fake.byte_us;
    memcpy(fake.in + fake.in_len, text, len);
    fake.in_len += (unsigned)len;
}

static int receive(uint32_t wait_ms)
{
    return link_receive(link_here, &frame, wait_ms);
}

TEST(it_opens_at_115200_baud)
{
    TEST_ASSERT_EQUAL_UINT32(115200, fake.baud);
}

TEST(a_line_is_a_frame)
{
    comes("t0C1201FE\r");
    TEST_ASSERT_EQUAL(1, receive(20));
    TEST_ASSERT_EQUAL_HEX32(0x0C1, frame.id);
    TEST_ASSERT_EQUAL_UINT8(2, frame.len);
    TEST_ASSERT_EQUAL_HEX8(0xFE, frame.data[1]);
}

TEST(silence_is_waited_out)
{
    TEST_ASSERT_EQUAL(0, receive(20));
    TEST_ASSERT_UINT32_WITHIN(100, 20000, fake.now_us);
}

/* A millisecond may pass unseen, as while the flash is written. */
TEST(a_wait_ends_even_if_nobody_looks_in_its_last_millisecond)
{
    fake.look_us = 1500;
    TEST_ASSERT_EQUAL(0, receive(20));
    TEST_ASSERT_UINT32_WITHIN(2000, 20000, fake.now_us);
}

TEST(what_was_half_received_is_forgotten_when_it_is_opened_again)
{
    static const uint16_t ids[] = {0x0C1};

    comes("t0C1201");
    TEST_ASSERT_EQUAL(0, receive(20));
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, 1));
    comes("t0C10\r");
    TEST_ASSERT_EQUAL(1, receive(20));
    TEST_ASSERT_EQUAL_UINT8(0, frame.len);
}

TEST(half_a_line_waits_for_the_other_half)
{
    comes("t0C1201");
    TEST_ASSERT_EQUAL(0, receive(20));
    comes("FE\r");
    TEST_ASSERT_EQUAL(1, receive(20));
}

TEST(a_damaged_byte_makes_one_garbled_line)
{
    comes("t0C12\x80" "1FE\rt0C10\r");
    TEST_ASSERT_EQUAL(LINK_E_GARBLED, receive(20));
    TEST_ASSERT_EQUAL(1, receive(20));
    TEST_ASSERT_EQUAL(0, receive(20));
}

static void send_some(unsigned count)
{
    static const struct frame some = {.id = 0x081, .len = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}};

    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(0, link_send(link_here, &some));
}

TEST(a_frame_goes_out_as_a_line)
{
    send_some(1);
    TEST_ASSERT_EQUAL_STRING_LEN("t08180102030405060708\r", fake.out, fake.out_len);
}

TEST(what_comes_while_sending_is_not_lost)
{
    comes("t0C1801020304050607FF\rt0C10\r");
    send_some(3);
    TEST_ASSERT_EQUAL(1, receive(0));
    TEST_ASSERT_EQUAL_HEX8(0xFF, frame.data[7]);
    TEST_ASSERT_EQUAL(1, receive(0));
}

TEST(what_is_pumped_is_not_lost)
{
    comes("t0C10\r");
    for (unsigned i = 0; i < 100; i++) {
        line_pump();
        (void)machine_ms();
    }
    TEST_ASSERT_EQUAL(1, receive(0));
}

TEST(more_than_there_is_room_for_is_garbled_and_then_all_is_well)
{
    unsigned garbled = 0, whole = 0;

    for (unsigned i = 0; i < 10; i++)
        comes("t0C1801020304050607FF\r");
    send_some(10);
    comes("\rt0C11AA\r");
    for (int result = receive(20); result != 0; result = receive(20)) {
        garbled += result == LINK_E_GARBLED;
        whole += result == 1;
    }
    TEST_ASSERT_EQUAL_UINT(1, garbled);
    TEST_ASSERT_EQUAL_UINT(6, whole);   /* five that there was room for, and the one after */
    TEST_ASSERT_EQUAL_HEX8(0xAA, frame.data[0]);
}

TEST(lines_lost_as_a_whole_are_noticed_too)
{
    unsigned garbled = 0;

    for (unsigned i = 0; i < 12; i++)
        comes("t0C15AABBCCDDEE\r");   /* 16 bytes: eight fill the room exactly */
    send_some(13);
    TEST_ASSERT_EQUAL(1, receive(20));   /* there is room again */
    comes("\r");
    for (int result = receive(20); result != 0; result = receive(20))
        garbled += result == LINK_E_GARBLED;
    TEST_ASSERT_EQUAL_UINT(1, garbled);
}

TEST(what_a_port_holds_is_taken_at_one_look)
{
    fake.depth = FIFO_MAX;
    comes("t0C1801020304050607FF\r");
    fake.now_us += 100 * BYTE_US;
    TEST_ASSERT_EQUAL(1, receive(0));
    TEST_ASSERT_EQUAL_HEX8(0xFF, frame.data[7]);
}

/* As in QEMU, whose serial port has no bit rate. */
TEST(a_port_that_always_has_a_byte_loses_none)
{
    fake.byte_us = 0;
    for (unsigned i = 0; i < 10; i++)
        comes("t0C1801020304050607FF\r");
    for (unsigned i = 0; i < 10; i++)
        TEST_ASSERT_EQUAL(1, receive(0));
    TEST_ASSERT_EQUAL(0, receive(0));
}

static const struct frame SHORT = {.id = 0x123, .len = 1, .data = {0xAB}};

/* A frame does not leave while the line is blocked from a byte on; afterwards it does. */
static void send_once_in_vain(unsigned blocked_from)
{
    fake.blocked_from = blocked_from;
    TEST_ASSERT_EQUAL(LINK_E_FULL, link_send(link_here, &SHORT));
    fake.blocked_from = NEVER;
    TEST_ASSERT_EQUAL(0, link_send(link_here, &SHORT));
}

TEST(a_line_that_never_began_needs_no_end)
{
    send_once_in_vain(1);
    TEST_ASSERT_EQUAL_STRING_LEN("t1231AB\r", fake.out, fake.out_len);
}

TEST(a_line_that_does_not_take_it_is_given_up_in_time)
{
    fake.blocked_from = 1;
    TEST_ASSERT_EQUAL(LINK_E_FULL, link_send(link_here, &frame));
    TEST_ASSERT_UINT32_WITHIN(100, 1000 * (LINK_SEND_MS + 1), fake.now_us);
}

TEST(a_line_cut_short_is_ended_before_the_next)
{
    send_once_in_vain(4);
    TEST_ASSERT_EQUAL(0, link_send(link_here, &SHORT));
    TEST_ASSERT_EQUAL_STRING_LEN("t12\rt1231AB\rt1231AB\r", fake.out, fake.out_len);
}

TEST(a_line_cut_short_after_its_first_byte_is_ended_too)
{
    send_once_in_vain(2);
    TEST_ASSERT_EQUAL_STRING_LEN("t\rt1231AB\r", fake.out, fake.out_len);
}

TEST(its_health_is_always_fine)
{
    static const struct link_health fine = {.state = BUS_ACTIVE};
    struct link_health health;

    memset(&health, 0xA5, sizeof health);
    link_health(link_here, &health);
    TEST_ASSERT_EQUAL(fine.state, health.state);
    TEST_ASSERT_EQUAL_UINT8(0, health.tx_errors | health.rx_errors | health.bus_offs | health.dropped);
}

TEST(closing_stops_the_serial_port)
{
    link_close(NULL);
    TEST_ASSERT_TRUE(fake.on);
    link_close(link_here);
    TEST_ASSERT_FALSE(fake.on);
}
