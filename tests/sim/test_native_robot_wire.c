#include "octet.h"

#include "tests/test.h"
#include "hal/flash_store/crc32.h"
#include "hal/protocol/e2e.h"
#include "host_sim/sim/native/log_lines.h"
#include "host_sim/sim/native/robot_wire.h"

#include <string.h>

static char text[4 * LOG_LINE_MAX];
static struct log_lines lines;

BEFORE_EACH(log_lines)
{
    memset(text, 0, sizeof text);
    lines = (struct log_lines){.text = text};
}

TEST(log_line_has_the_format_of_candump)
{
    struct frame frame = {0x101, 8, {0x00, 0x12, 0xAB, 0xCD, 0xEF, 0xFF, 0x09, 0x90}};

    log_lines_stamp(&lines, 1020000);
    log_lines_add(&lines, &frame);
    TEST_ASSERT_EQUAL_STRING("(0000000001.020000) octet 101#0012ABCDEFFF0990\n", text);
    TEST_ASSERT_EQUAL_size_t(strlen(text), lines.used);
    TEST_ASSERT_TRUE(strlen(text) <= LOG_LINE_MAX);
}

TEST(log_line_pads_identifiers_and_has_short_data)
{
    struct frame frames[2] = {{0x021, 2, {0x12, 0x34}}, {0x001, 0, {0}}};

    log_lines_stamp(&lines, 0);
    log_lines_add(&lines, &frames[0]);
    log_lines_add(&lines, &frames[1]);
    TEST_ASSERT_EQUAL_STRING("(0000000000.000000) octet 021#1234\n(0000000000.000000) octet 001#\n", text);
}

TEST(log_line_has_every_digit_of_the_time)
{
    struct frame frame = {0x7C1, 0, {0}};

    log_lines_stamp(&lines, 1234567890987654u);
    log_lines_add(&lines, &frame);
    TEST_ASSERT_EQUAL_STRING("(1234567890.987654) octet 7C1#\n", text);
}

enum { SENSES = 0x103, DRIVE = 0x043, HEARTBEAT = 0x6A3, FAULTS = 0x783, HEALTH = 0x7C3 };

static struct loop_robot robot;

BEFORE_EACH(robot_wire)
{
    robot = (struct loop_robot){.senses_id = SENSES, .drive_id = DRIVE, .heartbeat_id = HEARTBEAT,
        .health_id = HEALTH};
}

static struct octet_senses_t sensed(const struct senses *senses, struct frame *frame)
{
    struct octet_senses_t message;

    robot_wire_senses(&robot, senses, frame);
    TEST_ASSERT_EQUAL_INT(0, octet_senses_unpack(&message, frame->data, frame->len));
    return message;
}

TEST(senses_frame_has_every_signal)
{
    struct senses senses = {.tick = 200, .feel = 21, .bump = true, .look = true, .beacon_mm = 5000,
        .odometer_left = 4095, .odometer_right = 1};
    struct frame frame;
    struct octet_senses_t message = sensed(&senses, &frame);

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

TEST(senses_counter_advances_with_each_frame)
{
    struct senses senses = {.tick = 1};
    struct frame frame;

    robot.senses_counter = 13;
    TEST_ASSERT_EQUAL_UINT8(14, sensed(&senses, &frame).counter);
    TEST_ASSERT_EQUAL_UINT8(0, sensed(&senses, &frame).counter);
}

static bool decode_drive(uint8_t tick, enum reason reason, struct drive *drive)
{
    struct octet_drive_t message = {.tick = tick, .reason = (uint8_t)reason, .left = -2047, .right = 2047,
        .repeat_count = 255, .eat = 1, .action = 127};
    struct frame frame = {.id = DRIVE, .len = OCTET_DRIVE_LENGTH};

    TEST_ASSERT_EQUAL_INT(OCTET_DRIVE_LENGTH, octet_drive_pack(frame.data, &message, sizeof frame.data));
    return robot_wire_drive(&frame, 7, drive);
}

TEST(drive_frame_is_decoded_completely)
{
    struct drive drive;

    TEST_ASSERT_TRUE(decode_drive(7, REASON_EAT, &drive));
    TEST_ASSERT_EQUAL_UINT8(7, drive.tick);
    TEST_ASSERT_EQUAL_INT(REASON_EAT, drive.reason);
    TEST_ASSERT_EQUAL_INT16(-2047, drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(2047, drive.right_mm_s);
    TEST_ASSERT_EQUAL_UINT8(255, drive.repeat_count);
    TEST_ASSERT_EQUAL_UINT8(127, drive.action);
    TEST_ASSERT_TRUE(drive.eat);
}

TEST(drive_of_another_tick_or_at_rest_is_no_answer)
{
    struct drive drive;

    TEST_ASSERT_FALSE(decode_drive(6, REASON_WANDER, &drive));
    TEST_ASSERT_FALSE(decode_drive(7, REASON_STOP, &drive));
    TEST_ASSERT_FALSE(decode_drive(7, REASON_SILENCE, &drive));
}

TEST(drive_with_an_unknown_reason_is_no_answer)
{
    struct drive drive;

    TEST_ASSERT_FALSE(decode_drive(7, (enum reason)(REASON_PROGRAM + 1), &drive));
}

static bool is_news(uint32_t id, uint8_t page, uint8_t counter, uint8_t content)
{
    struct frame frame = {.id = id, .len = 8, .data = {counter, (uint8_t)(page << 4 | counter), content}};

    robot.has_news = false;
    robot_wire_report(&robot, &frame);
    return robot.has_news;
}

TEST(report_counts_as_a_change_when_its_content_differs)
{
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 1, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 2, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 3, 1));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 4, 1));
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 5, 0));
    TEST_ASSERT_EQUAL_size_t(5, robot.report_count);
}

TEST(pages_are_tracked_separately)
{
    TEST_ASSERT_TRUE(is_news(FAULTS, 0, 1, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS, 1, 1, 1));
    TEST_ASSERT_TRUE(is_news(FAULTS + 1, 0, 1, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 2, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 1, 2, 1));
}

TEST(heartbeat_counts_as_no_change)
{
    TEST_ASSERT_FALSE(is_news(HEARTBEAT, 1, 1, 1));
    TEST_ASSERT_FALSE(is_news(HEARTBEAT, 1, 2, 2));
    TEST_ASSERT_EQUAL_size_t(2, robot.report_count);
}

TEST(report_of_an_untracked_kind_always_counts_as_a_change)
{
    for (unsigned i = 0; i < LOOP_KINDS_MAX; i++)
        TEST_ASSERT_TRUE(is_news(FAULTS + i, 0, 1, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS + LOOP_KINDS_MAX, 0, 1, 0));
    TEST_ASSERT_TRUE(is_news(FAULTS + LOOP_KINDS_MAX, 0, 1, 0));
    TEST_ASSERT_FALSE(is_news(FAULTS, 0, 1, 0));
    TEST_ASSERT_EQUAL_size_t(LOOP_FRAMES_MAX, robot.report_count);
}

TEST(report_list_keeps_the_last_reports)
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

static void add_known(struct frame frame)
{
    robot.known[robot.known_count++] = frame;
}

TEST(report_continues_with_same_content_and_next_counter)
{
    add_known(report_of(FAULTS, 1, 13, 7));
    robot.received = 4;
    TEST_ASSERT_TRUE(goes_on(FAULTS, 1, 14, 7));
    TEST_ASSERT_EQUAL_UINT32(5, robot.told[0]);
    TEST_ASSERT_TRUE(goes_on(FAULTS, 1, 0, 7));
}

TEST(repeated_skipped_or_changed_report_does_not_continue)
{
    add_known(report_of(FAULTS, 1, 3, 7));
    TEST_ASSERT_FALSE(goes_on(FAULTS, 1, 3, 7));
    TEST_ASSERT_FALSE(goes_on(FAULTS, 1, 5, 7));
    TEST_ASSERT_FALSE(goes_on(FAULTS, 1, 4, 8));
    TEST_ASSERT_FALSE(goes_on(FAULTS, 0, 4, 7));
    TEST_ASSERT_FALSE(goes_on(FAULTS + 1, 1, 4, 7));
    TEST_ASSERT_EQUAL_UINT32(0, robot.told[0]);
    TEST_ASSERT_TRUE(goes_on(FAULTS, 1, 4, 7));
}

TEST(damaged_report_does_not_continue)
{
    struct frame damaged = report_of(FAULTS, 0, 2, 0), shorter = damaged;

    add_known(report_of(FAULTS, 0, 1, 0));
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

TEST(heartbeat_continues_with_advancing_uptime)
{
    struct frame next = heartbeat(2, 1, 501), taken = heartbeat(3, 2, 502);

    add_known(heartbeat(1, 1, 500));
    TEST_ASSERT_TRUE(robot_wire_goes_on(&robot, &next));
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &taken));
}

TEST(heartbeat_with_another_state_does_not_continue)
{
    struct frame stopped = heartbeat(2, 1, 501);

    add_known(heartbeat(1, 1, 500));
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

TEST(health_that_differs_only_in_its_check_value_is_no_change)
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

/* The CRC-32 is over all senses that a robot has answered and over its answers, in order. */
TEST(health_continues_with_the_crc_of_all_frames_before)
{
    const struct senses first = {.tick = 1, .feel = 3}, second = {.tick = 2};
    struct frame one, two, held, wrong, before;
    uint32_t heard;

    robot.commands = 0xABCD1234;
    (void)sensed(&first, &one);
    robot.senses = one;
    robot_wire_hear_answer(&robot, &answer);
    (void)sensed(&second, &two);
    robot.senses = two;
    heard = with_answer(crc32_more(0, one.data + 1, 7), &two);
    held = health(2, 0, robot.commands ^ heard);
    wrong = health(2, 0, robot.commands ^ heard ^ 0x8000u);
    before = health(2, 0, robot.commands);
    add_known(health(1, 0, robot.commands));
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &wrong));
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &before));
    TEST_ASSERT_TRUE(robot_wire_goes_on(&robot, &held));
}

TEST(recent_crcs_over_senses_are_kept)
{
    const struct senses senses = {.tick = 1};
    uint32_t heard = 0;
    struct frame frame;

    for (unsigned i = 0; i < 3 * LOOP_HEARD; i++) {
        (void)sensed(&senses, &frame);
        robot.senses = frame;
        heard = i == 0 ? crc32_more(0, frame.data + 1, 7) : with_answer(heard, &frame);
        robot_wire_hear_answer(&robot, &answer);
    }
    TEST_ASSERT_EQUAL_HEX32(heard, robot.heard[(robot.heard_count - 1) % LOOP_HEARD]);
}

TEST(heartbeat_that_is_too_short_does_not_continue)
{
    struct frame nothing = {.id = HEARTBEAT, .len = 2, .data = {0, 0x12}};

    e2e_protect(&nothing);
    add_known((struct frame){.id = HEARTBEAT, .len = 2, .data = {0, 0x11}});
    TEST_ASSERT_FALSE(robot_wire_goes_on(&robot, &nothing));
}
