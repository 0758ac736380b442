#include "firmware/robot.h"
#include "tests/test.h"
#include "robot_rig.h"

TEST(obeying_wheels_are_not_denied)
{
    for (unsigned i = 0; i < MANY; i++) {
        obey(i / 100 % 2 ? FRONT : CLEAR);
        TEST_ASSERT_FALSE(out.denied);
        TEST_ASSERT_FALSE(out.contradiction);
    }
}

/* As against a wall, or with a motor that is dead. */
TEST(wheels_that_do_not_obey_stop_the_robot)
{
    unsigned denials = 0, ticks = 0;

    while (robot.running && ticks++ < MANY) {
        sense((struct senses){.tick = (uint8_t)ticks, .feel = FRONT, .bump = true});
        denials += out.denied;
    }
    TEST_ASSERT_EQUAL_UINT(3, denials);
    assert_at_rest();
    TEST_ASSERT_EQUAL(REASON_STOP, out.drive.reason);
}

TEST(robot_learns_nothing_from_stuck_wheels)
{
    static const uint8_t nothing[CELL_COUNT] = {0};
    unsigned ticks = 0;

    while (!out.denied && ticks++ < MANY)
        sense((struct senses){.tick = (uint8_t)ticks, .feel = ticks < 10 ? FRONT : CLEAR});
    TEST_ASSERT_TRUE(out.denied);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(nothing, robot.brain.memory.cell, CELL_COUNT);
}

/* A trial with wheels or odometers that make a multiple, or a part, of what they are told. */
static void assert_denied_with(unsigned times, unsigned of)
{
    static const uint8_t nothing[CELL_COUNT] = {0};

    for (unsigned ticks = 0; !out.denied && ticks < MANY; ticks++) {
        out.drive.left_mm_s = (int16_t)(out.drive.left_mm_s * (int)times / (int)of);
        out.drive.right_mm_s = (int16_t)(out.drive.right_mm_s * (int)times / (int)of);
        obey(ticks < 3 ? FRONT : CLEAR);
    }
    TEST_ASSERT_TRUE(out.denied);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(nothing, robot.brain.memory.cell, CELL_COUNT);
}

TEST(robot_learns_nothing_from_wheels_at_half_speed)
{
    assert_denied_with(1, 2);
}

TEST(robot_learns_nothing_from_odometers_that_count_a_multiple)
{
    for (unsigned times = 2; times <= 4; times++) {
        setUp();
        assert_denied_with(times, 1);
    }
}

/* With food ahead a searcher only steps, and makes no turn that could be judged. */
TEST(dead_motor_stops_a_robot_that_only_steps)
{
    unsigned denials = 0, ticks = 0;

    command(OPCODE_START, PROFILE_SEARCHER, 1);
    wheels.look = true;
    wheels.beacon_mm = 700;
    while (robot.running && ticks++ < MANY) {
        out.drive.left_mm_s = 0;
        obey(CLEAR);
        denials += out.denied;
    }
    TEST_ASSERT_EQUAL_UINT(3, denials);
    TEST_ASSERT_LESS_THAN_UINT(4 * TICKS_PER_SECOND, ticks);
    assert_at_rest();
}

TEST(steps_do_not_clear_the_denial_of_a_turn)
{
    command(OPCODE_START, PROFILE_SEARCHER, 1);
    obey(FRONT);
    while (!out.denied)
        sense((struct senses){.tick = wheels.tick++, .feel = CLEAR, .look = true, .beacon_mm = 700});
    wheels.look = true;
    wheels.beacon_mm = 700;
    for (unsigned i = 0; i < 100; i++)
        obey(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(1, robot.denials);
}

TEST(steps_clear_the_denial_of_a_step)
{
    command(OPCODE_START, PROFILE_SEARCHER, 1);
    wheels.look = true;
    wheels.beacon_mm = 700;
    while (!out.denied) {
        out.drive.left_mm_s = 0;
        obey(CLEAR);
    }
    for (unsigned i = 0; i < 100; i++)
        obey(CLEAR);
    TEST_ASSERT_EQUAL_UINT8(0, robot.denials);
}

TEST(obeying_wheels_clear_denials)
{
    while (!out.denied)
        sense((struct senses){.tick = wheels.tick++, .feel = FRONT});
    for (unsigned i = 0; i < 100; i++)
        obey(FRONT);
    TEST_ASSERT_EQUAL_UINT8(0, robot.denials);
    TEST_ASSERT_TRUE(robot.running);
}

TEST(food_at_distance_0_is_a_contradiction_and_not_eaten)
{
    sense((struct senses){.tick = 0, .look = true, .beacon_mm = 0});
    TEST_ASSERT_TRUE(out.contradiction);
    TEST_ASSERT_EQUAL(REASON_WANDER, out.drive.reason);
    for (unsigned i = 0; i < 100; i++) {
        wheels.look = true;
        obey(CLEAR);
        TEST_ASSERT_FALSE(out.drive.eat);
    }
}

TEST(distance_without_food_is_a_contradiction)
{
    sense((struct senses){.beacon_mm = 100});
    TEST_ASSERT_TRUE(out.contradiction);
}

/* A restarted body counts from 0. */
TEST(odometer_jump_does_not_change_the_turn)
{
    int32_t before;

    wheels.odometer_left = wheels.odometer_right = 2000;
    teach(SIDE_LEFT);
    for (unsigned i = 0; i < 3; i++)
        obey(FRONT);
    before = robot.motion.turn_left;
    wheels.odometer_left = wheels.odometer_right = 0;
    wheels.tick++;
    sense(wheels);
    TEST_ASSERT_TRUE(out.contradiction);
    TEST_ASSERT_EQUAL_INT32(before, robot.motion.turn_left);
}

/* Returns how many actions were denied until then. */
static unsigned stand_until_it_stops(void)
{
    unsigned denials = 0;

    for (unsigned ticks = 0; robot.running && ticks < MANY; ticks++) {
        sense((struct senses){.tick = wheels.tick++, .feel = FRONT});
        denials += out.denied;
    }
    TEST_ASSERT_FALSE(robot.running);
    return denials;
}

TEST(start_allows_three_denied_actions)
{
    for (unsigned starts = 0; starts < 3; starts++) {
        command(OPCODE_START, PROFILE_ARTICLE, 1);
        TEST_ASSERT_EQUAL_UINT(3, stand_until_it_stops());
    }
}

/* However often: a count that wrapped would allow three more denials. */
TEST(resumed_robot_stops_after_one_more_denial)
{
    (void)stand_until_it_stops();
    for (unsigned resumed = 0; resumed < 300; resumed++) {
        command(OPCODE_RESUME, 0, 0);
        TEST_ASSERT_EQUAL_UINT(1, stand_until_it_stops());
    }
}

/* A trial is denied; from then on the robot knows a turn for what is in front. */
static void deny_a_trial(void)
{
    sense((struct senses){.tick = wheels.tick++, .feel = FRONT});
    teach(SIDE_LEFT);
    while (!out.denied)
        sense((struct senses){.tick = wheels.tick++, .feel = FRONT});
    TEST_ASSERT_EQUAL_UINT8(1, robot.denials);
}

/* Remembered turns are too short to make up for a trial. */
TEST(boredom_after_a_denial_empties_no_cell)
{
    unsigned ticks = 0;

    command(OPCODE_START, PROFILE_FORGETFUL, 1);
    deny_a_trial();
    while (out.drive.reason != REASON_BOREDOM && ticks++ < MANY)
        obey(FRONT);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, out.drive.reason);
    TEST_ASSERT_EQUAL_UINT8(SIDE_LEFT, robot.brain.memory.cell[PATTERN_FRONT]);
}

TEST(food_is_eaten_after_a_denial)
{
    unsigned ticks = 0;

    deny_a_trial();
    wheels.look = true;
    wheels.beacon_mm = 100;
    while (!out.drive.eat && ticks++ < MANY)
        obey(CLEAR);
    TEST_ASSERT_TRUE(out.drive.eat);
    TEST_ASSERT_EQUAL_UINT8(1, robot.denials);
}

TEST(resumed_robot_continues_when_wheels_obey)
{
    (void)stand_until_it_stops();
    wheels.odometer_left = 2000;   /* somebody has turned them meanwhile */
    command(OPCODE_RESUME, 0, 0);
    for (unsigned i = 0; i < 100; i++) {
        obey(FRONT);
        TEST_ASSERT_FALSE(out.denied || out.contradiction);
    }
    TEST_ASSERT_TRUE(robot.running);
    TEST_ASSERT_EQUAL_UINT8(0, robot.denials);
}

TEST(resume_before_any_start_trusts_the_wheels)
{
    robot_init(&robot, 1);
    command(OPCODE_RESUME, 0, 0);
    for (unsigned i = 0; i < MANY; i++) {
        obey(CLEAR);
        TEST_ASSERT_FALSE(out.denied);
    }
}

/* 45 degrees take 12.5 ticks: half as many more, and 25. */
TEST(trial_given_up_skips_the_rest_for_the_filter)
{
    unsigned ticks = 0;

    command(OPCODE_SET, FILTER, 1);
    while (out.drive.reason != REASON_TRIAL)
        sense((struct senses){.tick = wheels.tick++, .feel = FRONT});
    do {
        sense((struct senses){.tick = wheels.tick++, .feel = FRONT});
        ticks++;
    } while (!out.denied && ticks < MANY);
    TEST_ASSERT_EQUAL_UINT(43, ticks);
}

/* In one tick no wheel makes 200 counts, whatever the number of the tick. */
TEST(odometer_jump_is_detected_at_any_tick_number)
{
    for (unsigned tick = 1; tick < 250; tick += 31) {
        setUp();
        sense((struct senses){.tick = (uint8_t)tick});
        sense((struct senses){.tick = (uint8_t)(tick + 1), .odometer_left = 200});
        TEST_ASSERT_TRUE(out.contradiction);
    }
}

TEST(distrust_applies_in_the_decision_that_reaches_the_limit)
{
    command(OPCODE_SET, DISTRUST, 1);
    feel(FRONT);
    TEST_ASSERT_EQUAL(REASON_WANDER, out.drive.reason);
}

/* Whether a robot that distrusts this stuck sensor ever looks aside. */
static bool looks_aside(uint8_t stuck)
{
    bool looked = false;

    setUp();
    command(OPCODE_SET, DISTRUST, 1);
    for (unsigned ticks = 0; ticks < MANY; ticks++) {
        obey(stuck);
        looked = looked || out.drive.reason == REASON_AVOID;
    }
    return looked;
}

TEST(only_a_distrusted_front_sensor_causes_looks_aside)
{
    for (uint8_t stuck = 1; stuck < 1u << FEEL_COUNT; stuck = (uint8_t)(stuck << 1))
        TEST_ASSERT_EQUAL(stuck == FRONT, looks_aside(stuck));
}

TEST(odometers_after_one_silence_are_credible)
{
    for (unsigned ticks = 0; ticks < 3; ticks++)
        obey(CLEAR);
    silence();
    wheels.tick++;
    wheels.odometer_left = (uint16_t)(wheels.odometer_left + 200);
    wheels.odometer_right = (uint16_t)(wheels.odometer_right + 200);
    sense(wheels);
    TEST_ASSERT_FALSE(out.contradiction);
}
