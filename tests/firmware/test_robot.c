/* The robot's drives, tick by tick. */
#include "robot_rig.h"

#include "tests/test.h"
#include "firmware/robot.h"

#include <string.h>

TEST(robot_rests_after_power_up)
{
    robot_init(&robot, 1);
    feel(CLEAR);
    assert_at_rest();
}

TEST(memory_is_empty_after_power_up)
{
    static const uint8_t nothing[CELL_COUNT] = {0};

    robot_init(&robot, 1);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(nothing, robot.brain.memory.cell, CELL_COUNT);
}

TEST(drive_echoes_the_tick_of_its_senses)
{
    sense((struct senses){.tick = 255});
    TEST_ASSERT_EQUAL_UINT8(255, out.drive.tick);
}

TEST(clear_way_drives_both_wheels_forward)
{
    feel(CLEAR);
    TEST_ASSERT_EQUAL(REASON_WANDER, out.drive.reason);
    TEST_ASSERT_GREATER_THAN_INT16(0, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(out.drive.left_mm_s, out.drive.right_mm_s);
}

TEST(remembered_left_turns_the_left_wheel_backward)
{
    teach(SIDE_LEFT);
    feel(FRONT);
    TEST_ASSERT_LESS_THAN_INT16(0, out.drive.left_mm_s);
    TEST_ASSERT_GREATER_THAN_INT16(0, out.drive.right_mm_s);
}

TEST(wheels_stop_in_the_tick_that_senses_an_obstacle)
{
    feel(CLEAR);
    sense((struct senses){.feel = FRONT, .look = true, .beacon_mm = 100});   /* the step ends, and it eats */
    TEST_ASSERT_EQUAL_INT16(0, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(0, out.drive.right_mm_s);
}

TEST(food_is_eaten_for_exactly_one_tick)
{
    const struct senses near_food = {.look = true, .beacon_mm = 100};
    const struct senses at_the_end = {
        .tick = 10, .look = true, .beacon_mm = 100, .odometer_left = 120, .odometer_right = 120};

    sense(near_food);
    TEST_ASSERT_FALSE(out.drive.eat);
    sense(at_the_end);
    TEST_ASSERT_TRUE(out.drive.eat);
    sense(at_the_end);
    TEST_ASSERT_FALSE(out.drive.eat);
}

TEST(trials_do_not_eat)
{
    for (unsigned i = 0; i < MANY; i++) {
        feel(FRONT);
        TEST_ASSERT_FALSE(out.drive.eat);
    }
}

TEST(drive_reports_the_repeat_count)
{
    teach(SIDE_LEFT);
    feel(FRONT);
    TEST_ASSERT_EQUAL_UINT8(1, out.drive.repeat_count);
}

TEST(action_number_is_constant_during_an_action)
{
    uint8_t number;

    feel(CLEAR);
    number = out.drive.action;
    feel(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(number, out.drive.action);
}

TEST(action_number_wraps_from_127_to_0)
{
    uint8_t last = out.drive.action;
    unsigned changes = 0;

    for (unsigned i = 0; i < 100 * MANY && changes < 300; i++) {
        obey(FRONT);
        if (out.drive.action == last)
            continue;
        TEST_ASSERT_EQUAL_UINT8((last + 1) % 128, out.drive.action);
        last = out.drive.action;
        changes++;
    }
    TEST_ASSERT_EQUAL_UINT(300, changes);
}

enum { RUN_TICKS = 300 };

/* Outputs of 30 s with another robot's frames, without the uptime. */
static void run(struct output told[RUN_TICKS])
{
    static const struct input peer = {.peer = {.cell = {0, 1, 2, 1}}};

    wheels = (struct senses){.tick = 0};
    command(OPCODE_START, PROFILE_ADAPTIVE, 7);
    command(OPCODE_SET, SHARE, 1);
    command(OPCODE_SET, TICK_MS, 100);
    for (unsigned tick = 0; tick < RUN_TICKS; tick++) {
        respond_to(INPUT_PEER, &peer);
        obey(tick % 11 == 0 ? FRONT : CLEAR);
        told[tick] = out;
        told[tick].report.uptime_s = 0;
    }
}

TEST(restarted_robot_runs_like_a_new_one)
{
    struct output fresh[RUN_TICKS], again[RUN_TICKS];

    run(fresh);
    for (unsigned before = 1; before < 2 * TICKS_PER_SECOND; before += 9) {
        command(OPCODE_STOP, 0, 0);
        command(OPCODE_ERASE, 0, 0);
        for (unsigned tick = 0; tick < before; tick++)
            feel(FRONT);
        run(again);
        TEST_ASSERT_EQUAL_MEMORY(fresh, again, sizeof fresh);
    }
}

/* Answers to commands, and when the memory is sent and stored. */

TEST(command_yields_an_answer_and_no_drive)
{
    command(OPCODE_RESUME, 0, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_EQUAL(RESULT_DONE, out.answer);
    TEST_ASSERT_FALSE(out.has_drive);
}

TEST(rejected_command_is_answered)
{
    command(OPCODE_SET, PARAMETER_COUNT, 0);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_EQUAL(RESULT_UNKNOWN_PARAMETER, out.answer);
}

TEST(senses_yield_a_drive_and_no_answer)
{
    feel(CLEAR);
    TEST_ASSERT_TRUE(out.has_drive);
    TEST_ASSERT_FALSE(out.has_answer);
}

TEST(written_memory_is_sent_and_stored_once)
{
    command(OPCODE_WRITE, 1u << PATTERN_FRONT, SIDE_LEFT << 8 * PATTERN_FRONT);
    TEST_ASSERT_TRUE(out.has_memory);
    TEST_ASSERT_TRUE(out.store);
    TEST_ASSERT_EQUAL_UINT8(SIDE_LEFT, out.memory[PATTERN_FRONT]);
    feel(CLEAR);
    TEST_ASSERT_FALSE(out.has_memory);
    TEST_ASSERT_FALSE(out.store);
}

/* A trial of 45 degrees is 1257 counts of difference between the wheels. */
TEST(lesson_is_sent_and_stored_when_learned)
{
    feel(FRONT);
    for (uint8_t tick = 5; tick <= 10; tick += 5) {
        uint16_t rolled = (uint16_t)(tick == 5 ? 314 : 628);
        uint16_t back = (uint16_t)(ODOMETER_SPAN - rolled);
        bool left = out.drive.left_mm_s < 0;

        sense((struct senses){.tick = tick, .odometer_left = left ? back : rolled, .odometer_right = left ? rolled : back});
    }
    TEST_ASSERT_TRUE(out.has_memory);
    TEST_ASSERT_TRUE(out.store);
    TEST_ASSERT_NOT_EQUAL_UINT8(SIDE_NOTHING, out.memory[PATTERN_FRONT]);
}

TEST(fixed_memory_is_sent_but_not_stored)
{
    command(OPCODE_START, PROFILE_FIXED, 1);
    TEST_ASSERT_TRUE(out.has_answer);
    TEST_ASSERT_TRUE(out.has_memory);
    TEST_ASSERT_FALSE(out.store);
    TEST_ASSERT_EQUAL_UINT8(SIDE_LEFT, out.memory[PATTERN_FRONT]);
}

TEST(write_to_a_fixed_robot_is_not_stored)
{
    command(OPCODE_START, PROFILE_FIXED, 1);
    command(OPCODE_WRITE, 1u << PATTERN_FRONT, SIDE_RIGHT << 8 * PATTERN_FRONT);
    TEST_ASSERT_EQUAL_UINT8(SIDE_RIGHT, out.memory[PATTERN_FRONT]);
    TEST_ASSERT_FALSE(out.store);
}

TEST(report_stores_no_memory)
{
    command(OPCODE_STOP, 0, 0);
    TEST_ASSERT_FALSE(out.store);
}

/* Silence and stop: the wheels rest, and the action continues afterwards. */

TEST(silence_rests_the_wheels_and_is_reported)
{
    feel(CLEAR);
    silence();
    assert_at_rest();
    TEST_ASSERT_EQUAL(REASON_SILENCE, out.drive.reason);
    TEST_ASSERT_TRUE(out.silent);
}

TEST(drive_in_silence_repeats_tick_and_action)
{
    uint8_t number;

    sense((struct senses){.tick = 255});
    number = out.drive.action;
    silence();
    TEST_ASSERT_EQUAL_UINT8(255, out.drive.tick);
    TEST_ASSERT_EQUAL_UINT8(number, out.drive.action);
}

TEST(silence_changes_only_its_count)
{
    struct robot before;

    feel(CLEAR);
    before = robot;
    silence();
    TEST_ASSERT_EQUAL_UINT8(before.silences + 1, robot.silences);
    before.silences = robot.silences;
    TEST_ASSERT_EQUAL_MEMORY(&before, &robot, sizeof robot);
}

TEST(action_continues_after_silence)
{
    struct drive expected;
    struct robot before;

    feel(CLEAR);
    before = robot;
    feel(CLEAR);
    expected = out.drive;
    robot = before;
    silence();
    feel(CLEAR);
    TEST_ASSERT_EQUAL_INT16(expected.left_mm_s, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL_UINT8(expected.action, out.drive.action);
    TEST_ASSERT_EQUAL(expected.reason, out.drive.reason);
}

TEST(stopped_robot_reports_rest_in_silence)
{
    command(OPCODE_STOP, 0, 0);
    silence();
    assert_at_rest();
}

TEST(stop_rests_the_wheels_at_once)
{
    feel(CLEAR);
    command(OPCODE_STOP, 0, 0);
    assert_at_rest();
    TEST_ASSERT_EQUAL(REASON_STOP, out.drive.reason);
}

TEST(drive_after_stop_repeats_tick_and_action)
{
    sense((struct senses){.tick = 77});
    command(OPCODE_STOP, 0, 0);
    assert_at_rest();
    TEST_ASSERT_EQUAL(REASON_STOP, out.drive.reason);
    TEST_ASSERT_EQUAL_UINT8(77, out.drive.tick);
    TEST_ASSERT_EQUAL_UINT8(1, out.drive.action);
}
