#include "firmware/robot.h"
#include "tests/test.h"
#include "robot_rig.h"

TEST(wheels_that_obey_are_no_fault)
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

TEST(from_wheels_that_do_not_obey_nothing_is_learned)
{
    static const uint8_t nothing[CELL_COUNT] = {0};
    unsigned ticks = 0;

    while (!out.denied && ticks++ < MANY)
        sense((struct senses){.tick = (uint8_t)ticks, .feel = ticks < 10 ? FRONT : CLEAR});
    TEST_ASSERT_TRUE(out.denied);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(nothing, robot.brain.memory.cell, CELL_COUNT);
}

/* A trial with wheels or odometers that make a multiple, or a part, of what they are told. */
static void try_with(unsigned times, unsigned of)
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

TEST(from_wheels_that_turn_at_half_the_speed_nothing_is_learned)
{
    try_with(1, 2);
}

TEST(from_odometers_that_count_a_multiple_nothing_is_learned)
{
    for (unsigned times = 2; times <= 4; times++) {
        setUp();
        try_with(times, 1);
    }
}

/* With food ahead a searcher takes step after step, and never the turn that would tell. */
TEST(a_dead_motor_stops_a_robot_that_only_takes_steps)
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

TEST(a_turn_that_was_denied_is_not_forgiven_for_steps)
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

TEST(a_step_that_was_denied_is_forgiven_for_steps)
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

TEST(wheels_that_obey_again_are_forgiven)
{
    while (!out.denied)
        sense((struct senses){.tick = wheels.tick++, .feel = FRONT});
    for (unsigned i = 0; i < 100; i++)
        obey(FRONT);
    TEST_ASSERT_EQUAL_UINT8(0, robot.denials);
    TEST_ASSERT_TRUE(robot.running);
}

TEST(food_at_no_distance_is_not_eaten)
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

TEST(a_distance_to_no_food_is_a_contradiction)
{
    sense((struct senses){.beacon_mm = 100});
    TEST_ASSERT_TRUE(out.contradiction);
}

/* A body that has begun anew counts from 0. */
TEST(odometers_that_jump_turn_nothing)
{
    int32_t before;

    wheels.odometer_left = wheels.odometer_right = 2000;
    learned(SIDE_LEFT);
    for (unsigned i = 0; i < 3; i++)
        obey(FRONT);
    before = robot.motion.turn_left;
    wheels.odometer_left = wheels.odometer_right = 0;
    wheels.tick++;
    sense(wheels);
    TEST_ASSERT_TRUE(out.contradiction);
    TEST_ASSERT_EQUAL_INT32(before, robot.motion.turn_left);
}

/* Returns how many of its actions were denied before. */
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

TEST(each_start_gives_its_wheels_three_actions)
{
    for (unsigned starts = 0; starts < 3; starts++) {
        command(OPCODE_START, PROFILE_ARTICLE, 1);
        TEST_ASSERT_EQUAL_UINT(3, stand_until_it_stops());
    }
}

/* However often it is: a count that went round would trust them three times more. */
TEST(resumed_with_wheels_that_still_do_not_obey_it_stops_at_once)
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
    learned(SIDE_LEFT);
    while (!out.denied)
        sense((struct senses){.tick = wheels.tick++, .feel = FRONT});
    TEST_ASSERT_EQUAL_UINT8(1, robot.denials);
}

/* Remembered turns are too short to make up for a trial. */
TEST(boredom_strikes_a_robot_whose_wheels_once_did_not_obey_and_teaches_it_nothing)
{
    unsigned ticks = 0;

    command(OPCODE_START, PROFILE_FORGETFUL, 1);
    deny_a_trial();
    while (out.drive.reason != REASON_BOREDOM && ticks++ < MANY)
        obey(FRONT);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, out.drive.reason);
    TEST_ASSERT_EQUAL_UINT8(SIDE_LEFT, robot.brain.memory.cell[PATTERN_FRONT]);
}

TEST(food_is_eaten_by_a_robot_whose_wheels_once_did_not_obey)
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

TEST(resumed_with_wheels_that_obey_again_it_goes_on)
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

TEST(resumed_without_ever_having_been_started_it_trusts_its_wheels)
{
    robot_init(&robot, 1);
    command(OPCODE_RESUME, 0, 0);
    for (unsigned i = 0; i < MANY; i++) {
        obey(CLEAR);
        TEST_ASSERT_FALSE(out.denied);
    }
}

/* 45 degrees take 12.5 ticks: half as many more, and 25. */
TEST(after_a_trial_that_was_given_up_it_does_not_wait_for_the_filter)
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
TEST(wheels_that_jump_within_a_tick_are_seen_at_any_tick)
{
    for (unsigned tick = 1; tick < 250; tick += 31) {
        setUp();
        sense((struct senses){.tick = (uint8_t)tick});
        sense((struct senses){.tick = (uint8_t)(tick + 1), .odometer_left = 200});
        TEST_ASSERT_TRUE(out.contradiction);
    }
}

TEST(a_sensor_is_distrusted_in_the_very_decision_that_is_one_too_many)
{
    command(OPCODE_SET, DISTRUST, 1);
    feel(FRONT);
    TEST_ASSERT_EQUAL(REASON_WANDER, out.drive.reason);
}

/* Whether a robot that believes no sensor that is stuck ever looks aside. */
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

TEST(a_robot_looks_aside_for_a_front_sensor_that_it_does_not_believe_and_for_no_other)
{
    for (uint8_t stuck = 1; stuck < 1u << FEEL_COUNT; stuck = (uint8_t)(stuck << 1))
        TEST_ASSERT_EQUAL(stuck == FRONT, looks_aside(stuck));
}

TEST(in_a_single_silence_too_wheels_may_have_rolled_on)
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
