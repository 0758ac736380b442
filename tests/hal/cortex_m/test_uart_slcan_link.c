#include <string.h>

#include "hal/link/link.h"
#include "hal/port/cortex_m/systick.h"
#include "hal/port/cortex_m/uart.h"
#include "tests/test.h"

enum { TEXT_MAX = 1024, LOOK_US = 10, BYTE_US = 87, FIFO_MAX = 32, DAMAGED = '\x80', NEVER = 0 };

/* The fake line: a byte each way every 87 us. The port holds `depth` received bytes; more are lost as an overrun.
 * Time passes with each read of the clock. */
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

static void feed(const char *text)
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

TEST(serial_link_opens_at_115200_baud)
{
    TEST_ASSERT_EQUAL_UINT32(115200, fake.baud);
}

TEST(line_is_received_as_a_frame)
{
    feed("t0C1201FE\r");
    TEST_ASSERT_EQUAL(1, receive(20));
    TEST_ASSERT_EQUAL_HEX32(0x0C1, frame.id);
    TEST_ASSERT_EQUAL_UINT8(2, frame.len);
    TEST_ASSERT_EQUAL_HEX8(0xFE, frame.data[1]);
}

TEST(receive_returns_silence_after_the_wait)
{
    TEST_ASSERT_EQUAL(0, receive(20));
    TEST_ASSERT_UINT32_WITHIN(100, 20000, fake.now_us);
}

/* A millisecond may pass unseen, as while the flash is written. */
TEST(wait_ends_though_the_clock_skips_a_millisecond)
{
    fake.look_us = 1500;
    TEST_ASSERT_EQUAL(0, receive(20));
    TEST_ASSERT_UINT32_WITHIN(2000, 20000, fake.now_us);
}

TEST(reopening_discards_a_partial_line)
{
    static const uint16_t ids[] = {0x0C1};

    feed("t0C1201");
    TEST_ASSERT_EQUAL(0, receive(20));
    TEST_ASSERT_EQUAL(0, link_open(&link_here, "", ids, 1));
    feed("t0C10\r");
    TEST_ASSERT_EQUAL(1, receive(20));
    TEST_ASSERT_EQUAL_UINT8(0, frame.len);
}

TEST(partial_line_waits_for_its_rest)
{
    feed("t0C1201");
    TEST_ASSERT_EQUAL(0, receive(20));
    feed("FE\r");
    TEST_ASSERT_EQUAL(1, receive(20));
}

TEST(damaged_byte_garbles_one_line)
{
    feed("t0C12\x80" "1FE\rt0C10\r");
    TEST_ASSERT_EQUAL(LINK_E_GARBLED, receive(20));
    TEST_ASSERT_EQUAL(1, receive(20));
    TEST_ASSERT_EQUAL(0, receive(20));
}

static void send_frames(unsigned count)
{
    static const struct frame some = {.id = 0x081, .len = 8, .data = {1, 2, 3, 4, 5, 6, 7, 8}};

    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(0, link_send(link_here, &some));
}

TEST(frame_is_sent_as_a_line)
{
    send_frames(1);
    TEST_ASSERT_EQUAL_STRING_LEN("t08180102030405060708\r", fake.out, fake.out_len);
}

TEST(bytes_received_while_sending_are_kept)
{
    feed("t0C1801020304050607FF\rt0C10\r");
    send_frames(3);
    TEST_ASSERT_EQUAL(1, receive(0));
    TEST_ASSERT_EQUAL_HEX8(0xFF, frame.data[7]);
    TEST_ASSERT_EQUAL(1, receive(0));
}

TEST(line_pump_loses_no_received_byte)
{
    feed("t0C10\r");
    for (unsigned i = 0; i < 100; i++) {
        line_pump();
        (void)machine_ms();
    }
    TEST_ASSERT_EQUAL(1, receive(0));
}

TEST(overrun_is_garbled_and_later_frames_arrive)
{
    unsigned garbled = 0, whole = 0;

    for (unsigned i = 0; i < 10; i++)
        feed("t0C1801020304050607FF\r");
    send_frames(10);
    feed("\rt0C11AA\r");
    for (int result = receive(20); result != 0; result = receive(20)) {
        garbled += result == LINK_E_GARBLED;
        whole += result == 1;
    }
    TEST_ASSERT_EQUAL_UINT(1, garbled);
    TEST_ASSERT_EQUAL_UINT(6, whole);   /* five that there was room for, and the one after */
    TEST_ASSERT_EQUAL_HEX8(0xAA, frame.data[0]);
}

TEST(lost_whole_lines_are_counted_as_garbled)
{
    unsigned garbled = 0;

    for (unsigned i = 0; i < 12; i++)
        feed("t0C15AABBCCDDEE\r");   /* 16 bytes: eight fill the room exactly */
    send_frames(13);
    TEST_ASSERT_EQUAL(1, receive(20));   /* there is room again */
    feed("\r");
    for (int result = receive(20); result != 0; result = receive(20))
        garbled += result == LINK_E_GARBLED;
    TEST_ASSERT_EQUAL_UINT(1, garbled);
}

TEST(serial_link_reads_a_full_fifo_in_one_call)
{
    fake.depth = FIFO_MAX;
    feed("t0C1801020304050607FF\r");
    fake.now_us += 100 * BYTE_US;
    TEST_ASSERT_EQUAL(1, receive(0));
    TEST_ASSERT_EQUAL_HEX8(0xFF, frame.data[7]);
}

/* As in QEMU, whose serial port has no bit rate. */
TEST(serial_link_loses_no_byte_of_a_continuous_stream)
{
    fake.byte_us = 0;
    for (unsigned i = 0; i < 10; i++)
        feed("t0C1801020304050607FF\r");
    for (unsigned i = 0; i < 10; i++)
        TEST_ASSERT_EQUAL(1, receive(0));
    TEST_ASSERT_EQUAL(0, receive(0));
}

static const struct frame SHORT = {.id = 0x123, .len = 1, .data = {0xAB}};

/* Sends a frame while the line is blocked from this byte on, and again when it is not. */
static void send_while_blocked(unsigned blocked_from)
{
    fake.blocked_from = blocked_from;
    TEST_ASSERT_EQUAL(LINK_E_FULL, link_send(link_here, &SHORT));
    fake.blocked_from = NEVER;
    TEST_ASSERT_EQUAL(0, link_send(link_here, &SHORT));
}

TEST(unsent_line_needs_no_terminator)
{
    send_while_blocked(1);
    TEST_ASSERT_EQUAL_STRING_LEN("t1231AB\r", fake.out, fake.out_len);
}

TEST(send_to_a_blocked_line_times_out)
{
    fake.blocked_from = 1;
    TEST_ASSERT_EQUAL(LINK_E_FULL, link_send(link_here, &frame));
    TEST_ASSERT_UINT32_WITHIN(100, 1000 * (LINK_SEND_MS + 1), fake.now_us);
}

TEST(cut_line_is_terminated_before_the_next)
{
    send_while_blocked(4);
    TEST_ASSERT_EQUAL(0, link_send(link_here, &SHORT));
    TEST_ASSERT_EQUAL_STRING_LEN("t12\rt1231AB\rt1231AB\r", fake.out, fake.out_len);
}

TEST(line_cut_after_its_first_byte_is_terminated)
{
    send_while_blocked(2);
    TEST_ASSERT_EQUAL_STRING_LEN("t\rt1231AB\r", fake.out, fake.out_len);
}

TEST(serial_link_reports_an_active_bus)
{
    static const struct link_health fine = {.state = BUS_ACTIVE};
    struct link_health health;

    memset(&health, 0xA5, sizeof health);
    link_health(link_here, &health);
    TEST_ASSERT_EQUAL(fine.state, health.state);
    TEST_ASSERT_EQUAL_UINT8(0, health.tx_errors | health.rx_errors | health.bus_offs | health.dropped);
}

TEST(link_close_stops_the_serial_port)
{
    link_close(NULL);
    TEST_ASSERT_TRUE(fake.on);
    link_close(link_here);
    TEST_ASSERT_FALSE(fake.on);
}
