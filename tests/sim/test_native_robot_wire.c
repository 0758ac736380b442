#include "host_sim/sim/native/robot_wire.h"
#include "tests/test.h"
#include "hal/flash_store/crc32.h"
#include "hal/protocol/e2e.h"
#include "octet.h"

enum { SENSES = 0x103, DRIVE = 0x043, HEARTBEAT = 0x6A3, FAULTS = 0x783, HEALTH = 0x7C3 };

static struct loop_robot robot;

void setUp(void)
{
    robot = (struct loop_robot){.senses_id = SENSES, .drive_id = DRIVE, .heartbeat_id = HEARTBEAT,
        .health_id = HEALTH};
}

static struct octet_senses_t told(const struct senses *senses, struct frame *frame)
{
    struct octet_senses_t message;

    robot_wire_senses(&robot, senses, frame);
    TEST_ASSERT_EQUAL_INT(0, octet_senses_unpack(&message, frame->data, frame->len));
    return message;
}

TEST(senses_are_told_whole)
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

TEST(senses_count_themselves)
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

TEST(a_drive_is_read_whole)
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

TEST(a_drive_of_another_tick_or_at_rest_is_no_answer)
{
    struct drive drive;

    TEST_ASSERT_FALSE(drives(6, REASON_WANDER, &drive));
    TEST_ASSERT_FALSE(drives(7, REASON_STOP, &drive));
    TEST_ASSERT_FALSE(drives(7, REASON_SILENCE, &drive));
}

TEST(a_drive_for_a_reason_that_there_is_not_is_no_answer)
{
    struct drive drive;

    TEST_ASSERT_FALSE(drives(7, (enum reason)(REASON_PROGRAM + 1), &drive));
}

static bool is_news(uint32_t id, uint8_t page, uint8_t counter, uint8_t content)
{
    struct frame frame = {.id = id, .len = 8, .data = {counter, (uint8_t)(page << 4 | counter), content}};

    robot.has_news = false;
    robot_wire_report(&robot, &frame);
    return robot.has_news;
}

TEST(a_report_is_news_when_it_says_something_else)
{
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 1, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 2, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 3, 1));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 4, 1));
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 5, 0));
    TEST_ASSERT_EQUAL_size_t(5, robot.report_count);
}

TEST(each_page_is_a_report_of_its_own)
{
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 1, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS, 1, 1, 1));
    TEST_ASSERT_TRUE(is_news(FAULTS + 1, 0, 1, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 2, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 1, 2, 1));
}

TEST(a_heartbeat_is_no_news)
{
    TEST_ASSERT_FALSE(is_news(HEARTBEAT, 1, 1, 1));
    TEST_ASSERT_FALSE(is_news(HEARTBEAT, 1, 2, 2));
    TEST_ASSERT_EQUAL_size_t(2, robot.report_count);
}

TEST(when_there_are_too_many_kinds_all_are_news)
{
    for (unsigned i = 0; i < LOOP_KINDS_MAX; i++)
        TEST_ASSERT_TRUE(is_news(FAULTS + i, 0, 1, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS + LOOP_KINDS_MAX, 0, 1, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS + LOOP_KINDS_MAX, 0, 1, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 1, 0));
    TEST_ASSERT_EQUAL_size_t(LOOP_FRAMES_MAX, robot.report_count);
}

TEST(of_too_many_reports_the_last_are_kept)
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

TEST(a_report_goes_on_when_it_says_the_same_with_the_next_counter)
{
    know(report_of(FAULTS, 1, 13, 7));
    robot.received = 4;
    TEST_ASSERT_TRUE(goes_on(FAULTS, 1, 14, 7));
    TEST_ASSERT_EQUAL_UINT32(5, robot.told[0]);
    TEST_ASSERT_TRUE(goes_on(FAULTS, 1, 0, 7));
}

TEST(what_came_before_or_says_something_new_does_not_go_on)
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

TEST(what_is_damaged_does_not_go_on)
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

TEST(a_heartbeat_goes_on_with_the_time)
{
    struct frame next = heartbeat(2, 1, 501), taken = heartbeat(3, 2, 502);

    know(heartbeat(1, 1, 500));
    TEST_ASSERT_TRUE(robot_wire_goes_on(&robot, &next));
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &taken));
}

TEST(a_heartbeat_of_another_state_does_not_go_on)
{
    struct frame stopped = heartbeat(2, 1, 501);

    know(heartbeat(1, 1, 500));
    stopped.data[1] = 2;
    e2e_protect(&stopped);
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &stopped));
}

static struct frame health(uint8_t counter, uint8_t rx_errors, uint32_t held)
{
    struct octet_health_t message = {.counter = counter, .rx_errors = rx_errors, .held = (uint16_t)held};
    struct frame frame = {.id = HEALTH, .len = OCTET_HEALTH_LENGTH};

    TEST_ASSERT_EQUAL_INT(OCTET_HEALTH_LENGTH, octet_health_pack(frame.data, &message, sizeof frame.data));
    e2e_protect(&frame);
    return frame;
}

TEST(a_health_is_no_news_only_because_of_what_it_holds)
{
    const struct frame reports[] = {health(1, 0, 5), health(2, 0, 6), health(3, 1, 6)};
    const bool news[] = {true, false, true};

    for (unsigned i = 0; i < 3; i++) {
        robot.has_news = false;
        robot_wire_report(&robot, &reports[i]);
        TEST_ASSERT_EQUAL_INT(news[i], robot.has_news);
    }
}

static const struct frame answer = {.id = DRIVE, .len = 8, .data = {0x11, 2, 3, 4, 0xA0, 0xB0, 0xC0, 0xD0}};

/* CRC-32 is linear: to combine the first four bytes is to combine the register. */
static uint32_t with_answer(uint32_t heard, const struct frame *senses)
{
    const uint8_t tail[] = {senses->data[5] ^ 0xB0, senses->data[6] ^ 0xC0, senses->data[7] ^ 0xD0};

    return crc32_more(crc32_more(heard ^ 0xA0040302u, senses->data + 1, 4), tail, 3);
}

/* CRC-32 over the senses that a robot has answered, and over its answers: each of them, in order. */
TEST(a_health_goes_on_when_it_holds_the_commands_all_senses_and_all_drives_before)
{
    const struct senses first = {.tick = 1, .feel = 3}, second = {.tick = 2};
    struct frame one, two, held, wrong, before;
    uint32_t heard;

    robot.commands = 0xABCD1234;
    (void)told(&first, &one);
    robot.senses = one;
    robot_wire_hear_answer(&robot, &answer);
    (void)told(&second, &two);
    robot.senses = two;
    heard = with_answer(crc32_more(0, one.data + 1, 7), &two);
    held = health(2, 0, robot.commands ^ heard);
    wrong = health(2, 0, robot.commands ^ heard ^ 0x8000u);
    before = health(2, 0, robot.commands);
    know(health(1, 0, robot.commands));
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &wrong));
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &before));
    TEST_ASSERT_TRUE(robot_wire_goes_on(&robot, &held));
}

TEST(the_last_checks_over_senses_are_kept)
{
    const struct senses senses = {.tick = 1};
    uint32_t heard = 0;
    struct frame frame;

    for (unsigned i = 0; i < 3 * LOOP_HEARD; i++) {
        (void)told(&senses, &frame);
        robot.senses = frame;
        heard = i == 0 ? crc32_more(0, frame.data + 1, 7) : with_answer(heard, &frame);
        robot_wire_hear_answer(&robot, &answer);
    }
    TEST_ASSERT_EQUAL_HEX32(heard, robot.heard[(robot.heard_count - 1) % LOOP_HEARD]);
}

TEST(a_heartbeat_of_no_length_does_not_go_on)
{
    struct frame nothing = {.id = HEARTBEAT, .len = 2, .data = {0, 0x12}};

    e2e_protect(&nothing);
    know((struct frame){.id = HEARTBEAT, .len = 2, .data = {0, 0x11}});
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &nothing));
}
