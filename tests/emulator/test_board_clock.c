/* The clock of an emulated board: it counts cycles, and its alarms ring in the order of their times. */
#include "host_sim/emulator/models/board_clock.h"

#include "bxcan_model_rig.h"

enum { ALARMS = 2, RINGS_MAX = 16, FRAME_NS = (47 + 64) * WIRE_BIT_NS };

static const uint64_t PERIOD_168_MHZ_FS = 5952380, NS = 1000000;   /* in fs */
static const struct moment NEVER = {UINT64_MAX, 0};

static struct board_clock board;
static struct moment alarms[ALARMS];
static struct {
    unsigned alarm;
    struct moment at;
} rings[RINGS_MAX];
static unsigned ring_count, takes;
static struct moment period;   /* of an alarm; NEVER: it rings once */

static struct moment at_ns(uint64_t ns)
{
    return (struct moment){ns, 0};
}

static void ring(struct board_clock *clock, unsigned alarm)
{
    rings[ring_count].alarm = alarm;
    rings[ring_count++].at = clock->now;
    alarms[alarm] = period.ns == NEVER.ns ? NEVER : at_ns(alarms[alarm].ns + period.ns);
}

static void take_heard(struct board_clock *clock)
{
    clock->wire->heard.count = 0;
    takes++;
}

void setUp(void)
{
    alarms[0] = alarms[1] = period = NEVER;
    ring_count = takes = 0;
    board = (struct board_clock){.horizon = NEVER, .period_fs = PERIOD_168_MHZ_FS, .alarms = alarms,
        .alarm_count = ALARMS, .ring = ring, .take = take_heard};
}

static void assert_moment(uint64_t ns, uint64_t fs, struct moment moment)
{
    TEST_ASSERT_EQUAL_UINT64(ns, moment.ns);
    TEST_ASSERT_EQUAL_UINT64(fs, moment.fs);
}

static void assert_ring(unsigned n, unsigned alarm, uint64_t ns)
{
    TEST_ASSERT_LESS_THAN_UINT(ring_count, n);
    TEST_ASSERT_EQUAL_UINT(alarm, rings[n].alarm);
    TEST_ASSERT_EQUAL_UINT64(ns, rings[n].at.ns);
}

static void set_alarm(unsigned alarm, uint64_t ns)
{
    alarms[alarm] = at_ns(ns);
    clock_expect(&board, alarms[alarm]);
}

TEST(moments_compare_by_nanoseconds_then_femtoseconds)
{
    TEST_ASSERT_TRUE(moment_before((struct moment){1, 9}, (struct moment){2, 0}));
    TEST_ASSERT_TRUE(moment_before((struct moment){1, 2}, (struct moment){1, 3}));
    TEST_ASSERT_FALSE(moment_before((struct moment){1, 3}, (struct moment){1, 3}));
    TEST_ASSERT_FALSE(moment_before((struct moment){2, 0}, (struct moment){1, 9}));
}

TEST(clock_time_is_cycles_times_period)
{
    clock_execute(&board, 1000);
    assert_moment(5952, 380000, board.now);
    TEST_ASSERT_EQUAL_UINT64(1000, board.cycles);
}

TEST(clock_accumulates_fractions_of_a_nanosecond)
{
    for (unsigned n = 0; n < 1000; n++)
        clock_execute(&board, 1);
    assert_moment(5952, 380000, board.now);
}

TEST(alarm_fires_when_its_time_is_reached)
{
    board.period_fs = NS;
    set_alarm(1, 100);
    clock_execute(&board, 99);
    TEST_ASSERT_EQUAL_UINT(0, ring_count);
    clock_execute(&board, 1);
    assert_ring(0, 1, 100);
    clock_execute(&board, 100);
    TEST_ASSERT_EQUAL_UINT(1, ring_count);
}

TEST(alarm_set_again_fires_again)
{
    board.period_fs = NS;
    period = at_ns(50);
    set_alarm(0, 100);
    clock_execute(&board, 100);
    clock_execute(&board, 49);
    TEST_ASSERT_EQUAL_UINT(1, ring_count);
    clock_execute(&board, 1);
    TEST_ASSERT_EQUAL_UINT(2, ring_count);
}

TEST(skip_fires_alarms_in_order_of_time)
{
    period = at_ns(300);
    set_alarm(0, 100);
    set_alarm(1, 250);
    clock_skip_to(&board, at_ns(700));
    TEST_ASSERT_EQUAL_UINT(5, ring_count);
    assert_ring(0, 0, 100);
    assert_ring(1, 1, 250);
    assert_ring(2, 0, 400);
    assert_ring(3, 1, 550);
    assert_ring(4, 0, 700);
    assert_moment(700, 0, board.now);
}

TEST(skip_advances_the_cycle_count)
{
    clock_skip_to(&board, at_ns(1000000));
    TEST_ASSERT_EQUAL_UINT64(168000, board.cycles);
    clock_skip_to(&board, at_ns(999999));
    assert_moment(1000000, 0, board.now);
}

TEST(skip_to_event_ends_at_event_or_limit)
{
    set_alarm(0, 5000);
    clock_skip_to_event(&board, 4000);
    assert_moment(4000, 0, board.now);
    clock_skip_to_event(&board, 4000);
    assert_moment(5000, 0, board.now);
    TEST_ASSERT_EQUAL_UINT(1, ring_count);
}

static void fail(struct board_clock *clock, unsigned alarm)
{
    ring(clock, alarm);
    clock->failed = true;
}

TEST(clock_stops_after_a_failure)
{
    board.ring = fail;
    set_alarm(0, 100);
    set_alarm(1, 100);
    clock_skip_to(&board, at_ns(1000));
    assert_moment(100, 0, board.now);
    TEST_ASSERT_EQUAL_UINT(1, ring_count);
}

/* ---- the wire */

static void connect(void)
{
    join_alone(TXFP);
    board.wire = &wire;
    board.now = at_ns(wire.now_ns);
    clock_settle(&board);
}

TEST(frame_is_taken_after_its_time_on_the_wire)
{
    uint64_t start;

    connect();
    start = board.now.ns;
    request(0, 0x81);
    clock_expect(&board, board.now);
    clock_skip_to(&board, at_ns(start + FRAME_NS - 1));
    TEST_ASSERT_EQUAL_UINT(0, takes);
    clock_skip_to(&board, at_ns(start + FRAME_NS));
    TEST_ASSERT_EQUAL_UINT(1, takes);
    clock_skip_to(&board, at_ns(start + 1000000));
    TEST_ASSERT_EQUAL_UINT(1, takes);
}

TEST(skip_to_event_ends_at_end_of_frame)
{
    uint64_t start;

    connect();
    start = board.now.ns;
    request(0, 0x81);
    clock_settle(&board);
    clock_skip_to_event(&board, 1000000);
    assert_moment(start + FRAME_NS, 0, board.now);
}

TEST(refused_access_is_taken_when_the_clock_settles)
{
    connect();
    TEST_ASSERT_EQUAL_UINT(0, takes);
    (void)node_write(&can.node, 0x20, 0);
    clock_settle(&board);
    TEST_ASSERT_EQUAL_UINT(1, takes);
}
