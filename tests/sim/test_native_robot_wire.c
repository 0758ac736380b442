#include "host_sim/sim/native/robot_wire.h"

#include <unity.h>

#include "hal/protocol/e2e.h"
#include "octet.h"

enum { SENSES = 0x103, DRIVE = 0x043, HEARTBEAT = 0x6A3, FAULTS = 0x783 };

static struct loop_robot robot;

void setUp(void)
{
    robot = (struct loop_robot){.senses_id = SENSES, .drive_id = DRIVE, .heartbeat_id = HEARTBEAT};
}

void tearDown(void) {}

static struct octet_senses_t told(const struct senses *senses, struct frame *frame)
{
    struct octet_senses_t message;

    robot_wire_senses(&robot, senses, frame);
    TEST_ASSERT_EQUAL_INT(0, octet_senses_unpack(&message, frame->data, frame->len));
    return message;
}

static void test_senses_are_told_whole(void)
{
    struct senses senses = {.tick = 200, .feel = 21, .bump = true, .look = true, .beacon_mm = 5000,
        .odometer_left = 4095, .odometer_right = 1};
    struct frame frame;
    struct octet_senses_t message = told(&senses, &frame);

    TEST_ASSERT_EQUAL_HEX32(SENSES, frame.id);
    TEST_ASSERT_TRUE(e2e_is_whole(&frame, OCTET_SENSES_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(200, message.tick);
    TEST_ASSERT_EQUAL_UINT8(21, message.feel);
    TEST_ASSERT_EQUAL_UINT8(1, message.bump);
    TEST_ASSERT_EQUAL_UINT8(1, message.look);
    TEST_ASSERT_EQUAL_UINT16(5000, message.beacon);
    TEST_ASSERT_EQUAL_UINT16(4095, message.odometer_left);
    TEST_ASSERT_EQUAL_UINT16(1, message.odometer_right);
}

static void test_senses_count_themselves(void)
{
    struct senses senses = {.tick = 1};
    struct frame frame;

    robot.senses_counter = 13;
    TEST_ASSERT_EQUAL_UINT8(14, told(&senses, &frame).counter);
    TEST_ASSERT_EQUAL_UINT8(0, told(&senses, &frame).counter);
}

static bool drives(uint8_t tick, enum reason reason, struct drive *drive)
{
    struct octet_drive_t message = {.tick = tick, .reason = (uint8_t)reason, .left = -2047, .right = 2047,
        .repeat_count = 255, .eat = 1, .action = 127};
    struct frame frame = {.id = DRIVE, .len = OCTET_DRIVE_LENGTH};

    TEST_ASSERT_EQUAL_INT(OCTET_DRIVE_LENGTH, octet_drive_pack(frame.data, &message, sizeof frame.data));
    return robot_wire_drive(&frame, 7, drive);
}

static void test_a_drive_is_read_whole(void)
{
    struct drive drive;

    TEST_ASSERT_TRUE(drives(7, REASON_EAT, &drive));
    TEST_ASSERT_EQUAL_UINT8(7, drive.tick);
    TEST_ASSERT_EQUAL_INT(REASON_EAT, drive.reason);
    TEST_ASSERT_EQUAL_INT16(-2047, drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(2047, drive.right_mm_s);
    TEST_ASSERT_EQUAL_UINT8(255, drive.repeat_count);
    TEST_ASSERT_EQUAL_UINT8(127, drive.action);
    TEST_ASSERT_TRUE(drive.eat);
}

static void test_a_drive_of_another_tick_or_at_rest_is_no_answer(void)
{
    struct drive drive;

    TEST_ASSERT_FALSE(drives(6, REASON_WANDER, &drive));
    TEST_ASSERT_FALSE(drives(7, REASON_STOP, &drive));
    TEST_ASSERT_FALSE(drives(7, REASON_SILENCE, &drive));
}

static bool is_news(uint32_t id, uint8_t page, uint8_t counter, uint8_t content)
{
    struct frame frame = {.id = id, .len = 8, .data = {counter, (uint8_t)(page << 4 | counter), content}};

    robot.has_news = false;
    robot_wire_report(&robot, &frame);
    return robot.has_news;
}

static void test_a_report_is_news_when_it_says_something_else(void)
{
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 1, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 2, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 3, 1));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 4, 1));
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 5, 0));
    TEST_ASSERT_EQUAL_size_t(5, robot.report_count);
}

static void test_each_page_is_a_report_of_its_own(void)
{
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 1, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS, 1, 1, 1));
    TEST_ASSERT_TRUE(is_news(FAULTS + 1, 0, 1, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 2, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 1, 2, 1));
}

static void test_a_heartbeat_is_no_news(void)
{
    TEST_ASSERT_FALSE(is_news(HEARTBEAT, 1, 1, 1));
    TEST_ASSERT_FALSE(is_news(HEARTBEAT, 1, 2, 2));
    TEST_ASSERT_EQUAL_size_t(2, robot.report_count);
}

static void test_when_there_are_too_many_kinds_all_are_news(void)
{
    for (unsigned i = 0; i < LOOP_KINDS_MAX; i++)
        TEST_ASSERT_TRUE(is_news(FAULTS + i, 0, 1, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS + LOOP_KINDS_MAX, 0, 1, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS + LOOP_KINDS_MAX, 0, 1, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 1, 0));
    TEST_ASSERT_EQUAL_size_t(LOOP_FRAMES_MAX, robot.report_count);
}

static void test_of_too_many_reports_the_last_are_kept(void)
{
    for (unsigned i = 0; i < LOOP_FRAMES_MAX + 3; i++)
        (void)is_news(FAULTS, 0, 1, (uint8_t)i);
    TEST_ASSERT_EQUAL_size_t(LOOP_FRAMES_MAX, robot.report_count);
    TEST_ASSERT_EQUAL_UINT8(3, robot.reports[0].data[2]);
    TEST_ASSERT_EQUAL_UINT8(LOOP_FRAMES_MAX + 2, robot.reports[LOOP_FRAMES_MAX - 1].data[2]);
}

/* A report as the robot protects it. */
static struct frame report_of(uint32_t id, uint8_t page, uint8_t counter, uint8_t content)
{
    struct frame frame = {.id = id, .len = 8, .data = {0, (uint8_t)(page << 4 | counter), content}};

    e2e_protect(&frame);
    return frame;
}

static bool goes_on(uint32_t id, uint8_t page, uint8_t counter, uint8_t content)
{
    struct frame frame = report_of(id, page, counter, content);

    return robot_wire_goes_on(&robot, &frame);
}

static void know(struct frame frame)
{
    robot.known[robot.known_count++] = frame;
}

static void test_a_report_goes_on_when_it_says_the_same_with_the_next_counter(void)
{
    know(report_of(FAULTS, 1, 13, 7));
    robot.received = 4;
    TEST_ASSERT_TRUE(goes_on(FAULTS, 1, 14, 7));
    TEST_ASSERT_EQUAL_UINT32(5, robot.told[0]);
    TEST_ASSERT_TRUE(goes_on(FAULTS, 1, 0, 7));
}

static void test_what_came_before_or_says_something_new_does_not_go_on(void)
{
    know(report_of(FAULTS, 1, 3, 7));
    TEST_ASSERT_FALSE(goes_on(FAULTS, 1, 3, 7));
    TEST_ASSERT_FALSE(goes_on(FAULTS, 1, 5, 7));
    TEST_ASSERT_FALSE(goes_on(FAULTS, 1, 4, 8));
    TEST_ASSERT_FALSE(goes_on(FAULTS, 0, 4, 7));
    TEST_ASSERT_FALSE(goes_on(FAULTS + 1, 1, 4, 7));
    TEST_ASSERT_EQUAL_UINT32(0, robot.told[0]);
    TEST_ASSERT_TRUE(goes_on(FAULTS, 1, 4, 7));
}

static void test_what_is_damaged_does_not_go_on(void)
{
    struct frame damaged = report_of(FAULTS, 0, 2, 0), shorter = damaged;

    know(report_of(FAULTS, 0, 1, 0));
    damaged.data[0] ^= 1;
    shorter.len = 7;
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &damaged));
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &shorter));
}

static struct frame heartbeat(uint8_t counter, uint8_t owner, uint16_t uptime)
{
    struct octet_heartbeat_t message = {.counter = counter, .state = 1, .owner = owner, .uptime = uptime, .layout = 9};
    struct frame frame = {.id = HEARTBEAT, .len = OCTET_HEARTBEAT_LENGTH};

    TEST_ASSERT_EQUAL_INT(OCTET_HEARTBEAT_LENGTH, octet_heartbeat_pack(frame.data, &message, sizeof frame.data));
    e2e_protect(&frame);
    return frame;
}

static void test_a_heartbeat_goes_on_with_the_time(void)
{
    struct frame next = heartbeat(2, 1, 501), taken = heartbeat(3, 2, 502);

    know(heartbeat(1, 1, 500));
    TEST_ASSERT_TRUE(robot_wire_goes_on(&robot, &next));
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &taken));
}

static void test_a_heartbeat_of_another_state_does_not_go_on(void)
{
    struct frame stopped = heartbeat(2, 1, 501);

    know(heartbeat(1, 1, 500));
    stopped.data[1] = 2;
    e2e_protect(&stopped);
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &stopped));
}

static void test_a_heartbeat_of_no_length_does_not_go_on(void)
{
    struct frame nothing = {.id = HEARTBEAT, .len = 2, .data = {0, 0x12}};

    e2e_protect(&nothing);
    know((struct frame){.id = HEARTBEAT, .len = 2, .data = {0, 0x11}});
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &nothing));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_report_goes_on_when_it_says_the_same_with_the_next_counter);
    RUN_TEST(test_what_came_before_or_says_something_new_does_not_go_on);
    RUN_TEST(test_what_is_damaged_does_not_go_on);
    RUN_TEST(test_a_heartbeat_goes_on_with_the_time);
    RUN_TEST(test_a_heartbeat_of_another_state_does_not_go_on);
    RUN_TEST(test_a_heartbeat_of_no_length_does_not_go_on);
    RUN_TEST(test_senses_are_told_whole);
    RUN_TEST(test_senses_count_themselves);
    RUN_TEST(test_a_drive_is_read_whole);
    RUN_TEST(test_a_drive_of_another_tick_or_at_rest_is_no_answer);
    RUN_TEST(test_a_report_is_news_when_it_says_something_else);
    RUN_TEST(test_each_page_is_a_report_of_its_own);
    RUN_TEST(test_a_heartbeat_is_no_news);
    RUN_TEST(test_when_there_are_too_many_kinds_all_are_news);
    RUN_TEST(test_of_too_many_reports_the_last_are_kept);
    return UNITY_END();
}
