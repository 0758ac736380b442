/* Robots of a page: commands, answers and the log. */
#include "page_rig.h"

#include <string.h>

#include "hal/protocol/e2e.h"
#include "tests/test.h"

TEST(page_opens_the_given_number_of_robots)
{
    TEST_ASSERT_EQUAL_size_t(ROBOTS, page_state()->loop.robot_count);
    for (unsigned i = 0; i < ROBOTS; i++) {
        TEST_ASSERT_EQUAL_UINT8(i + 1, page_state()->robots[i].octet->wire.node);
        TEST_ASSERT_EQUAL_HEX32(0x101 + i, page_state()->robots[i].senses_id);
        TEST_ASSERT_EQUAL_HEX32(0x041 + i, page_state()->robots[i].drive_id);
    }
    TEST_ASSERT_EQUAL_size_t(0, page_log_used());
}

TEST(command_and_answer_are_logged)
{
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(1, OPCODE_START, PROFILE_NEVER, SEED));
    TEST_ASSERT_EQUAL_UINT(1, logged("022"));
    TEST_ASSERT_EQUAL_UINT(1, logged("142"));
    TEST_ASSERT_EQUAL_UINT(0, logged("021"));
    TEST_ASSERT_EQUAL_UINT8(PROFILE_NEVER, page_state()->robots[1].octet->robot.brain.profile);
    TEST_ASSERT_FALSE(page_state()->robots[0].octet->robot.running);
}

TEST(forty_commands_in_a_row_succeed)
{
    for (unsigned i = 0; i < 40; i++)
        TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_START, PROFILE_ARTICLE, i));
}

TEST(rejected_command_returns_its_result)
{
    start(0, PROFILE_ARTICLE);
    TEST_ASSERT_EQUAL_INT32(RESULT_UNKNOWN_PARAMETER, page_command(0, OPCODE_SET, PARAMETER_COUNT, 1));
    TEST_ASSERT_EQUAL_INT32(RESULT_OUT_OF_RANGE, page_command(0, OPCODE_SET, TURN_DEG, 181));
}

TEST(parameter_is_set_and_read_back)
{
    start(0, PROFILE_ARTICLE);
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_SET, SPEED_MM_S, 133));
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_GET, SPEED_MM_S, 0));
    TEST_ASSERT_EQUAL_UINT32(133, page_answer_value());
}

TEST(freeze_is_switched_on_and_off)
{
    start(0, PROFILE_ARTICLE);
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_FREEZE, 1, 0));
    TEST_ASSERT_TRUE(page_state()->robots[0].octet->robot.brain.frozen);
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_FREEZE, 0, 0));
    TEST_ASSERT_FALSE(page_state()->robots[0].octet->robot.brain.frozen);
}

TEST(reports_after_an_answer_are_logged_when_taken)
{
    start(0, PROFILE_ARTICLE);
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_REPORT, 0, 0));
    TEST_ASSERT_EQUAL_UINT(0, logged("6A1"));
    page_take_reports(0);
    TEST_ASSERT_EQUAL_UINT(1, logged("6A1"));   /* HEARTBEAT */
    page_take_reports(0);
    TEST_ASSERT_EQUAL_UINT(1, logged("6A1"));
}

TEST(log_lines_have_the_time_set)
{
    static const char stamp[] = "(0000000012.340000) octet ";

    page_set_time(12340000.0);
    (void)page_command(0, OPCODE_STOP, 0, 0);
    TEST_ASSERT_EQUAL_STRING_LEN(stamp, page_log(), LOG_STAMP);
    page_clear_log();
    TEST_ASSERT_EQUAL_size_t(0, page_log_used());
}

static void put_senses(uint8_t tick)
{
    const struct octet_senses_t message = {.counter = 1, .tick = tick};
    struct frame frame = {.id = 0x101, .len = OCTET_SENSES_LENGTH};

    (void)octet_senses_pack(frame.data, &message, sizeof frame.data);
    e2e_protect(&frame);
    put_bytes(frame.data);
}

TEST(exchanged_frame_is_not_logged)
{
    start(0, PROFILE_ARTICLE);
    put_senses(0);
    TEST_ASSERT_EQUAL_size_t(1, page_exchange(0, 0x101, OCTET_SENSES_LENGTH));
    TEST_ASSERT_EQUAL_HEX32(0x041, page_answers(0)[0].id);
    TEST_ASSERT_EQUAL_size_t(0, page_log_used());
}

TEST(ranges_frame_is_logged_in_order_of_the_sensors)
{
    char data[17];

    start(0, PROFILE_DISTANCE);
    page_state()->robots[0].senses_counter = 3;
    page_state()->world.bodies[0].faults.stuck_on = FEEL_FRONT;
    page_send_ranges(0, TICK_SPAN + 9);
    TEST_ASSERT_EQUAL_UINT(1, logged("121"));
    memcpy(data, page_log() + LOG_STAMP + 4, 16);
    data[16] = '\0';
    TEST_ASSERT_EQUAL_STRING("9400FFFF00FFFF", data + 2);   /* counter 4, tick 9, and the five */
}

/* ---- commands as frames, from a log */

static void read_command(struct octet_command_t message)
{
    struct frame frame = {.id = OCTET_COMMAND_FRAME_ID + 1, .len = OCTET_COMMAND_LENGTH};

    (void)octet_command_pack(frame.data, &message, sizeof frame.data);
    e2e_protect(&frame);
    put_bytes(frame.data);
    TEST_ASSERT_EQUAL_UINT32(message.opcode, page_read_command(1));
}

static void assert_read(uint32_t which, uint32_t value)
{
    TEST_ASSERT_EQUAL_UINT32(which, page_command_which());
    TEST_ASSERT_EQUAL_UINT32(value, page_command_value());
}

TEST(command_is_decoded_from_its_frame)
{
    read_command((struct octet_command_t){.opcode = OPCODE_START, .profile = PROFILE_FIVE, .seed = 0x89ABCDEF});
    assert_read(PROFILE_FIVE, 0x89ABCDEF);
    read_command((struct octet_command_t){.opcode = OPCODE_SET, .parameter = SPEED_MM_S, .value = 250});
    assert_read(SPEED_MM_S, 250);
    read_command((struct octet_command_t){.opcode = OPCODE_WRITE, .mask = 9, .half = 1, .byte_0 = 1, .byte_1 = 2, .byte_2 = 3,
                                          .byte_3 = 0x84});
    assert_read(1 << 4 | 9, 0x84030201);
    read_command((struct octet_command_t){.opcode = OPCODE_FREEZE, .freeze = 1});
    assert_read(1, 0);
    read_command((struct octet_command_t){.opcode = OPCODE_GET, .wanted = SPEED_MM_S});
    assert_read(SPEED_MM_S, 0);
    read_command((struct octet_command_t){.opcode = OPCODE_ERASE});
    assert_read(0, 0);
}

/* Layouts that a page draws, and worlds written in it. */

static void set_numbers(void)
{
    static const double numbers[PAGE_DRAW_NUMBERS] = {
        [PAGE_DRAW_STYLE] = LAYOUT_BARS, [PAGE_DRAW_WIDTH_MM] = 4000.0, [PAGE_DRAW_HEIGHT_MM] = 3000.0,
        [PAGE_DRAW_BODY_MM] = 100.0, [PAGE_DRAW_REACH_MM] = 60.0, [PAGE_DRAW_THICKNESS_MM] = 40.0,
        [PAGE_DRAW_BAR_COUNT] = 6, [PAGE_DRAW_BAR_MIN_MM] = 300.0, [PAGE_DRAW_BAR_MAX_MM] = 1000.0,
        [PAGE_DRAW_FOOD_COUNT] = 3, [PAGE_DRAW_FOOD] = 0.0, 1000.0, 1150.0, 2750.0, 2750.0, 4000.0,
    };

    for (unsigned i = 0; i < PAGE_DRAW_NUMBERS; i++)
        page_drawing()[i] = numbers[i];
    page_write_nothing();
}

static void write_food(double x_mm, double y_mm)
{
    double *numbers = page_write_entry(WRITTEN_FOOD, 0, 2);

    page_write_list(WRITTEN_FOOD, 1);
    numbers[0] = x_mm;
    numbers[1] = y_mm;
}

static void expect_counts(const double *out, double first, double second, double third)
{
    TEST_ASSERT_EQUAL_DOUBLE(first, out[0]);
    TEST_ASSERT_EQUAL_DOUBLE(second, out[1]);
    TEST_ASSERT_EQUAL_DOUBLE(third, out[2]);
}

TEST(drawn_environment_has_bars_food_and_starts)
{
    const double *out;

    set_numbers();
    out = page_draw(1, 1, PAGE_ROBOTS_MAX);
    expect_counts(out, 6.0, 3.0, 4.0);
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_DOUBLE_WITHIN(2000.0, 2000.0, out[3 + 4 * 6 + 2 * i]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 314.651908, out[3 + 4 * 6 + 2 * 3]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, 385.035638, out[3 + 4 * 6 + 2 * 3 + 1]);
    TEST_ASSERT_DOUBLE_WITHIN(1e-6, -2.400630, out[3 + 4 * 6 + 2 * 3 + 2]);
}

TEST(page_draws_the_requested_style_and_food)
{
    const double *out;

    set_numbers();
    page_drawing()[PAGE_DRAW_STYLE] = LAYOUT_DEAD_ENDS;
    page_drawing()[PAGE_DRAW_FOOD_COUNT] = 1;
    out = page_draw(1, 1, 1);
    expect_counts(out, 12.0, 1.0, 1.0);
    TEST_ASSERT_DOUBLE_WITHIN(500.0, 500.0, out[3 + 4 * 12]);
}

TEST(written_world_replaces_the_style)
{
    double *bar;
    const double *out;

    set_numbers();
    write_food(3500.0, 400.0);
    bar = page_write_entry(WRITTEN_BARS, 0, 4);
    page_write_list(WRITTEN_BARS, 1);
    bar[0] = bar[1] = bar[2] = 1000.0;
    bar[3] = 2000.0;
    TEST_ASSERT_NULL(page_check());
    out = page_draw(1, 1, 2);
    expect_counts(out, 1.0, 1.0, 2.0);
    TEST_ASSERT_EQUAL_DOUBLE(2000.0, out[3 + 3]);
    TEST_ASSERT_EQUAL_DOUBLE(3500.0, out[3 + 4]);
    page_write_nothing();
    expect_counts(page_draw(1, 1, 1), 6.0, 3.0, 1.0);
}

TEST(page_reports_the_mistake_of_a_written_world)
{
    const double *out;

    set_numbers();
    write_food(100.0, 400.0);
    out = page_check();
    expect_counts(out, WRITTEN_FOOD, 0.0, 3.0);
    TEST_ASSERT_EQUAL_STRING("food %g is only %g mm away from an obstacle or a wall; %g mm are needed", page_fault_text());
    TEST_ASSERT_EQUAL_DOUBLE(1.0, out[3]);
    TEST_ASSERT_EQUAL_DOUBLE(100.0, out[4]);
    TEST_ASSERT_EQUAL_DOUBLE(160.0, out[5]);
    TEST_ASSERT_NULL(page_write_entry(WRITTEN_FOOD, WRITTEN_FOOD_MAX, 2));
}

TEST(world_without_room_has_no_starts)
{
    set_numbers();
    page_drawing()[PAGE_DRAW_WIDTH_MM] = page_drawing()[PAGE_DRAW_HEIGHT_MM] = 300.0;
    page_drawing()[PAGE_DRAW_BAR_COUNT] = 0;
    TEST_ASSERT_EQUAL_DOUBLE(0.0, page_draw(1, 1, 1)[2]);
}
