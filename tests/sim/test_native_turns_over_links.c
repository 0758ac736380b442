#include <string.h>

#include "tests/test.h"
#include "hal/protocol/e2e.h"
#include "host_sim/sim/native/loop.h"
#include "host_sim/sim/native/turn.h"
#include "logged_lines.h"
#include "octet.h"

enum { ROBOTS = 2, SENSES = 0x101, DRIVE = 0x041, FAULTS = 0x781, TICK = 9, COUNTER = 4, WAIT_MS = 3, FASTEST = 500 };

/* A fake link, whose frames a test sets. */
struct link {
    int sent;                  /* what link_send is to return */
    struct frame out;          /* the last that was sent */
    struct frame in[LOOP_FRAMES_MAX + 2];
    int results[LOOP_FRAMES_MAX + 2];   /* what link_receive returns with each; 0 after the last */
    size_t taken;
    uint32_t wait_ms;
};

static struct link links[ROBOTS];
static struct loop_robot robots[ROBOTS];
static struct loop loop;
static struct world world = {.params = {.max_wheel_speed_mm_s = FASTEST}};
static struct turn turns[ROBOTS];
static char text[64 * LOG_LINE_MAX];

int link_send(struct link *link, const struct frame *frame)
{
    link->out = *frame;
    return link->sent;
}

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    link->wait_ms = wait_ms;
    *out = link->in[link->taken];
    return link->results[link->taken++];
}

static struct frame drive(size_t robot, uint8_t tick, uint8_t counter, enum reason reason)
{
    struct octet_drive_t message = {.counter = counter, .tick = tick, .reason = (uint8_t)reason, .left = 150, .action = 3};
    struct frame frame = {.id = DRIVE + (uint32_t)robot, .len = OCTET_DRIVE_LENGTH};

    (void)octet_drive_pack(frame.data, &message, sizeof frame.data);
    e2e_protect(&frame);
    return frame;
}

static struct frame valid_drive(size_t robot)
{
    return drive(robot, TICK, COUNTER + 1, REASON_WANDER);
}

static struct frame faults(uint8_t counter)
{
    struct frame frame = {.id = FAULTS, .len = 8, .data = {0, counter}};

    e2e_protect(&frame);
    return frame;
}

static void queue_frame(size_t robot, size_t place, struct frame frame)
{
    links[robot].in[place] = frame;
    links[robot].results[place] = 1;
}

void setUp(void)
{
    memset(links, 0, sizeof links);
    memset(robots, 0, sizeof robots);
    memset(turns, 0, sizeof turns);
    loop = (struct loop){.robot_count = ROBOTS, .robots = robots, .wait_ms = WAIT_MS, .world = &world, .log = {.text = text},
        .log_size = sizeof text};
    for (unsigned i = 0; i < ROBOTS; i++) {
        robots[i] = (struct loop_robot){.link = &links[i], .senses_id = SENSES + i, .drive_id = DRIVE + i,
            .senses_counter = COUNTER};
        turns[i].senses.tick = TICK;
        queue_frame(i, 0, valid_drive(i));
    }
}

TEST(valid_answers_are_taken_in_c)
{
    TEST_ASSERT_TRUE(turns_over_links(&loop, turns));
    TEST_ASSERT_EQUAL_size_t(ROBOTS, loop.sent);
    TEST_ASSERT_EQUAL_size_t(ROBOTS, loop.answered);
    TEST_ASSERT_EQUAL_INT16(150, turns[1].drive.left_mm_s);
    TEST_ASSERT_EQUAL_HEX32(SENSES + 1, links[1].out.id);
    TEST_ASSERT_TRUE(e2e_is_whole(&links[1].out, OCTET_SENSES_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(COUNTER + 1, e2e_counter(&links[1].out));
    TEST_ASSERT_EQUAL_UINT32(WAIT_MS, links[0].wait_ms);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].received);
    TEST_ASSERT_EQUAL_INT(4, logged_lines(&loop.log));
}

TEST(continuing_report_is_taken_in_c)
{
    robots[0].known[0] = faults(1);
    robots[0].known_count = 1;
    queue_frame(0, 0, faults(2));
    queue_frame(0, 1, valid_drive(0));
    TEST_ASSERT_TRUE(turns_over_links(&loop, turns));
    TEST_ASSERT_EQUAL_UINT32(2, robots[0].received);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].told[0]);
    TEST_ASSERT_EQUAL_INT(5, logged_lines(&loop.log));
}

static void assert_handed_over(size_t sent, size_t answered, int received)
{
    TEST_ASSERT_FALSE(turns_over_links(&loop, turns));
    TEST_ASSERT_EQUAL_size_t(sent, loop.sent);
    TEST_ASSERT_EQUAL_size_t(answered, loop.answered);
    TEST_ASSERT_EQUAL_INT(received, loop.received);
}

TEST(failed_send_is_handed_over)
{
    links[1].sent = LINK_E_FULL;
    assert_handed_over(1, 0, 0);
    TEST_ASSERT_EQUAL_INT(1, logged_lines(&loop.log));
}

TEST(silence_and_errors_are_handed_over)
{
    links[1].results[0] = 0;
    assert_handed_over(ROBOTS, 1, 0);
    setUp();
    links[0].results[0] = LINK_E_CLOSED;
    assert_handed_over(ROBOTS, 0, LINK_E_CLOSED);
    TEST_ASSERT_EQUAL_INT(ROBOTS, logged_lines(&loop.log));
}

static void assert_frame_handed_over(struct frame frame)
{
    setUp();
    queue_frame(1, 0, frame);
    assert_handed_over(ROBOTS, 1, 1);
    TEST_ASSERT_EQUAL_HEX32(frame.id, loop.in_hand.id);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(frame.data, loop.in_hand.data, sizeof frame.data);
    TEST_ASSERT_EQUAL_UINT32(0, robots[1].received);
    TEST_ASSERT_EQUAL_INT(3, logged_lines(&loop.log));
}

TEST(unexpected_answer_is_handed_over)
{
    struct frame damaged = valid_drive(1), shorter = valid_drive(1), extended = valid_drive(1);

    damaged.data[5] ^= 0x10;
    shorter.len = 7;
    extended.id |= FRAME_EXTENDED;
    assert_frame_handed_over(damaged);
    assert_frame_handed_over(shorter);
    assert_frame_handed_over(extended);
    assert_frame_handed_over(valid_drive(0));
    assert_frame_handed_over(faults(1));
    assert_frame_handed_over(drive(1, TICK - 1, COUNTER + 1, REASON_WANDER));
    assert_frame_handed_over(drive(1, TICK, COUNTER, REASON_WANDER));
    assert_frame_handed_over(drive(1, TICK, COUNTER + 1, REASON_STOP));
    assert_frame_handed_over(drive(1, TICK, COUNTER + 1, REASON_SILENCE));
}

static struct frame drive_at_speed(int16_t left, int16_t right)
{
    struct octet_drive_t message = {.counter = COUNTER + 1, .tick = TICK, .reason = REASON_WANDER, .left = left, .right = right};
    struct frame frame = {.id = DRIVE + 1, .len = OCTET_DRIVE_LENGTH};

    (void)octet_drive_pack(frame.data, &message, sizeof frame.data);
    e2e_protect(&frame);
    return frame;
}

TEST(drive_beyond_the_fastest_speed_is_handed_over)
{
    assert_frame_handed_over(drive_at_speed(FASTEST + 1, 0));
    assert_frame_handed_over(drive_at_speed(0, -FASTEST - 1));
    setUp();
    queue_frame(1, 0, drive_at_speed(FASTEST, -FASTEST));
    TEST_ASSERT_TRUE(turns_over_links(&loop, turns));
}

TEST(too_many_reports_are_handed_over)
{
    robots[0].known[0] = faults(0);
    robots[0].known_count = 1;
    for (unsigned i = 0; i < LOOP_FRAMES_MAX; i++)
        queue_frame(0, i, faults((uint8_t)((i + 1) % E2E_COUNTERS)));
    queue_frame(0, LOOP_FRAMES_MAX, valid_drive(0));
    assert_handed_over(ROBOTS, 0, 0);
    TEST_ASSERT_EQUAL_size_t(LOOP_FRAMES_MAX, links[0].taken);
}
