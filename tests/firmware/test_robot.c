/* What it drives, tick by tick. */
#include "firmware/robot.h"
#include "tests/test.h"
#include "robot_rig.h"

TEST(after_power_up_it_rests)
{
    robot_init(&robot, 1);
    feel(CLEAR);
    assert_at_rest();
}

TEST(after_power_up_it_knows_nothing)
{
    static const uint8_t nothing[CELL_COUNT] = {0};

    robot_init(&robot, 1);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(nothing, robot.brain.memory.cell, CELL_COUNT);
}

TEST(a_drive_answers_the_tick_of_its_senses)
{
    sense((struct senses){.tick = 255});
    TEST_ASSERT_EQUAL_UINT8(255, out.drive.tick);
}

TEST(a_clear_way_is_driven)
{
    feel(CLEAR);
    TEST_ASSERT_EQUAL(REASON_WANDER, out.drive.reason);
    TEST_ASSERT_GREATER_THAN_INT16(0, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(out.drive.left_mm_s, out.drive.right_mm_s);
}

TEST(a_remembered_left_turns_the_left_wheel_back)
{
    learned(SIDE_LEFT);
    feel(FRONT);
    TEST_ASSERT_LESS_THAN_INT16(0, out.drive.left_mm_s);
    TEST_ASSERT_GREATER_THAN_INT16(0, out.drive.right_mm_s);
}

TEST(the_wheels_stop_in_the_tick_that_brings_an_obstacle)
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

TEST(trials_eat_nothing)
{
    for (unsigned i = 0; i < MANY; i++) {
        feel(FRONT);
        TEST_ASSERT_FALSE(out.drive.eat);
    }
}

TEST(the_drive_tells_the_repeat_count)
{
    learned(SIDE_LEFT);
    feel(FRONT);
    TEST_ASSERT_EQUAL_UINT8(1, out.drive.repeat_count);
}

TEST(an_action_keeps_its_number_while_it_lasts)
{
    uint8_t number;

    feel(CLEAR);
    number = out.drive.action;
    feel(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(number, out.drive.action);
}

TEST(actions_are_numbered_0_to_127_round_and_round)
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

/* Half a minute of robot time with others to hear, but for what counts since power-up. */
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

TEST(a_robot_that_ran_before_runs_as_a_new_one)
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
