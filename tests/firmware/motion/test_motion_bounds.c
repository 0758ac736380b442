/* Where each rule of motion begins and ends, to the last count: a turn makes 100 counts in a tick, a step 80. */
#include "firmware/motion/motion.h"
#include "tests/test.h"
#include "motion_rig.h"

enum { COUNT = 16384, DEGREE = 457528, LEAST = -1, MOST = 1 };

static const struct action GLANCE = {.reason = REASON_LOOK_AROUND, .turn_deg = 90};
static const struct action BACK = {.reason = REASON_TRIAL, .forward_mm = -12};
static const struct action FOOD_TURN = {.turn_deg = 210, .until_food = true};

void setUp(void)
{
    config_reset(&config);
    stand_at(0.0, 0.0);
}

static bool has_ended(uint8_t feel)
{
    const struct senses senses = {.tick = body.tick, .feel = feel};

    return motion_ended(&motion, &config, &senses);
}

/* Some ticks in which each wheel rolls so many counts. */
static void roll_for(unsigned ticks, int left, int right)
{
    for (unsigned i = 0; i < ticks; i++) {
        (void)driven();
        roll(left, right);
    }
}

/* Whether these odometers are credible after both wheels stood at another count. */
static bool is_credible(int from, int left, int right, unsigned ticks)
{
    const struct senses senses = {
        .odometer_left = (uint16_t)(left & (ODOMETER_SPAN - 1)),
        .odometer_right = (uint16_t)(right & (ODOMETER_SPAN - 1)),
    };

    motion.odometer_left = motion.odometer_right = (uint16_t)(from & (ODOMETER_SPAN - 1));
    return motion_is_credible(&motion, &config, &senses, ticks);
}

TEST(a_restarted_body_has_rolled_up_to_8_counts)
{
    TEST_ASSERT_FALSE(is_credible(90, 8, 8, 2));
    TEST_ASSERT_FALSE(is_credible(90, -8, -8, 2));
    TEST_ASSERT_TRUE(is_credible(90, 9, 8, 2));
    TEST_ASSERT_TRUE(is_credible(90, 8, 9, 2));
    TEST_ASSERT_TRUE(is_credible(-90, -9, -8, 2));
}

TEST(a_body_that_stood_at_0_may_still_stand_there)
{
    TEST_ASSERT_TRUE(is_credible(0, 0, 0, 2));
    TEST_ASSERT_TRUE(is_credible(8, 0, 0, 2));
    TEST_ASSERT_FALSE(is_credible(9, 0, 0, 2));
}

TEST(without_a_gap_wheels_may_roll_to_0)
{
    TEST_ASSERT_TRUE(is_credible(50, 0, 0, 1));
}

TEST(wheels_roll_no_farther_in_a_longer_gap_than_in_five_ticks)
{
    static const unsigned ticks[] = {5, 6, 100};

    for (unsigned i = 0; i < sizeof ticks / sizeof *ticks; i++) {
        TEST_ASSERT_TRUE(is_credible(1000, 1409, 591, ticks[i]));
        TEST_ASSERT_FALSE(is_credible(1000, 1410, 1000, ticks[i]));
        TEST_ASSERT_FALSE(is_credible(1000, 1000, 590, ticks[i]));
    }
}

/* How far wheels that still had to roll a distance apart have gone astray after a tick of a step. */
static unsigned astray_in_a_step(int16_t to_come, int left, int right)
{
    stand_at(0.0, 0.0);
    begin(0, 12);
    motion.apart.counts = to_come;
    roll(left, right);
    return motion.astray;
}

static unsigned astray_in_a_turn(int16_t to_come, int left, int right)
{
    stand_at(0.0, 0.0);
    begin(90, 0);
    motion.together.counts = to_come;
    roll(left, right);
    return motion.astray;
}

TEST(what_was_still_to_be_rolled_of_a_turn_is_not_astray_in_a_step)
{
    TEST_ASSERT_EQUAL_UINT(30, astray_in_a_step(0, 15, -15));
    TEST_ASSERT_EQUAL_UINT(0, astray_in_a_step(30, 15, -15));
    TEST_ASSERT_EQUAL_UINT(10, astray_in_a_step(30, 20, -20));
    TEST_ASSERT_EQUAL_UINT(0, astray_in_a_step(-30, -15, 15));
    TEST_ASSERT_EQUAL_UINT(10, astray_in_a_step(-30, -20, 20));
    TEST_ASSERT_EQUAL_UINT(0, astray_in_a_step(-1, 0, 1));
    TEST_ASSERT_EQUAL_UINT(0, astray_in_a_step(1, 1, 0));
}

TEST(what_rolls_against_what_was_to_come_is_astray)
{
    TEST_ASSERT_EQUAL_UINT(30, astray_in_a_step(30, -15, 15));
    TEST_ASSERT_EQUAL_UINT(30, astray_in_a_step(-30, 15, -15));
    TEST_ASSERT_EQUAL_UINT(1, astray_in_a_step(-1, 1, 0));
}

TEST(what_was_still_to_be_rolled_of_a_step_is_not_astray_in_a_turn)
{
    TEST_ASSERT_EQUAL_UINT(40, astray_in_a_turn(0, 20, 20));
    TEST_ASSERT_EQUAL_UINT(10, astray_in_a_turn(30, 20, 20));
    TEST_ASSERT_EQUAL_UINT(10, astray_in_a_turn(-30, -20, -20));
}

TEST(a_tick_of_correct_rolling_offsets_three_quarters_of_it)
{
    begin(0, 12);
    motion.astray = 10;
    roll(2, 2);
    TEST_ASSERT_EQUAL_UINT16(7, motion.astray);
    roll(-2, -2);
    TEST_ASSERT_EQUAL_UINT16(4, motion.astray);
}

TEST(wheels_go_astray_up_to_a_limit_and_the_next_action_starts_from_what_denies_one)
{
    begin(0, 250);
    for (unsigned i = 0; i < 20; i++)
        roll(1500, -1500);
    TEST_ASSERT_EQUAL_UINT16(16000, motion.astray);
    begin(0, 12);
    TEST_ASSERT_EQUAL_UINT16(1004, motion.astray);
    TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
}

TEST(a_turn_is_denied_with_its_last_command_and_not_before)
{
    begin(210, 0);
    motion.pace_left = 101;
    (void)driven();
    roll(50, -50);
    TEST_ASSERT_EQUAL_UINT16(1, motion.pace_left);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
    motion.pace_left = 100;
    roll(50, -50);
    TEST_ASSERT_EQUAL_UINT16(0, motion.pace_left);
    TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
    motion.pace_left = 99;
    roll(50, -50);
    TEST_ASSERT_EQUAL_UINT16(0, motion.pace_left);
}

TEST(wheels_slower_than_half_are_denied_after_ten_ticks)
{
    for (int side = LEAST; side <= MOST; side += 2) {
        stand_at(0.0, 0.0);
        begin(side * 210, 0);
        for (unsigned i = 1; i <= 10; i++) {
            (void)driven();
            roll(side * 25, side * -24);
            TEST_ASSERT_EQUAL(i == 10, motion_is_denied(&motion, &config));
        }
    }
}

TEST(wheels_that_grow_slow_in_a_turn_are_denied)
{
    begin(210, 0);
    roll_for(20, 50, -50);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
    roll_for(1, 24, -24);
    TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
}

TEST(wheels_at_half_their_speed_are_not_too_slow)
{
    begin(210, 0);
    roll_for(30, 25, -25);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
}

TEST(a_turn_for_food_is_not_judged_by_its_pace)
{
    motion_begin(&motion, &config, &FOOD_TURN);
    roll_for(30, 10, -10);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
}

/* 28 degrees are 781 counts, 29 are 809: 800 are judged. */
TEST(turns_of_eight_ticks_and_more_are_judged)
{
    begin(28, 0);
    TEST_ASSERT_FALSE(motion_tells(&motion));
    begin(-29, 0);
    TEST_ASSERT_TRUE(motion_tells(&motion));
    motion_begin(&motion, &config, &GLANCE);
    TEST_ASSERT_FALSE(motion_tells(&motion));
    begin(0, 250);
    TEST_ASSERT_FALSE(motion_tells(&motion));
}

TEST(a_turn_too_far_to_count_is_not_judged)
{
    for (unsigned i = 0; i < 20; i++)
        roll(-2000, 2000);
    begin(210, 0);
    TEST_ASSERT_FALSE(motion_tells(&motion));
}

TEST(a_turn_has_one_and_a_half_times_its_time_and_25_ticks)
{
    begin(210, 0);
    TEST_ASSERT_EQUAL_UINT16(5864 * 3 / 2 / 100 + 25, motion.ticks_left);
    begin(0, 0);
    TEST_ASSERT_EQUAL_UINT16(1, motion.ticks_left);
    motion_begin(&motion, &config, &BACK);
    TEST_ASSERT_EQUAL_UINT16(240 * 2 / 80 + 25, motion.ticks_left);
}

TEST(wheels_that_stop_within_half_a_degree_have_turned)
{
    for (int side = LEAST; side <= MOST; side += 2) {
        begin(90, 0);
        motion.apart.rolled = (int16_t)(side * 5);
        motion.turn_left = side * DEGREE / 2;
        TEST_ASSERT_TRUE(has_ended(0));
        motion.turn_left += side;
        TEST_ASSERT_FALSE(has_ended(0));
        motion.apart.rolled = (int16_t)(side * 6);
        motion.turn_left = side * DEGREE / 2;
        TEST_ASSERT_FALSE(has_ended(0));
    }
}

/* 10 counts are less than 3/8 degree, 11 are more. */
TEST(a_turn_ends_with_up_to_three_eighths_of_a_degree_to_come_and_a_glance_with_any)
{
    for (int side = LEAST; side <= MOST; side += 2) {
        begin(90, 0);
        motion.apart.rolled = 100;
        motion.apart.counts = (int16_t)(side * 10);
        motion.turn_left = side * (10 * COUNT + DEGREE / 8);
        TEST_ASSERT_TRUE(has_ended(0));
        motion.turn_left += side;
        TEST_ASSERT_FALSE(has_ended(0));
        motion.apart.counts = (int16_t)(side * 11);
        motion.turn_left = side * 11 * COUNT;
        TEST_ASSERT_FALSE(has_ended(0));
        motion_begin(&motion, &config, &GLANCE);
        motion.turn_left = side * 11 * COUNT;
        TEST_ASSERT_TRUE(has_ended(0));
    }
}

TEST(a_way_back_ends_five_counts_before_its_end_and_at_no_obstacle)
{
    motion_begin(&motion, &config, &BACK);
    motion.way_left = -6;
    TEST_ASSERT_FALSE(has_ended(FEEL_FRONT));
    motion.way_left = -5;
    TEST_ASSERT_TRUE(has_ended(0));
    motion.way_left = 0;
    TEST_ASSERT_TRUE(has_ended(0));
}

TEST(what_wheels_will_still_roll_ends_a_step_earlier)
{
    begin(0, 12);
    motion.way_left = 26;
    motion.together.counts = 20;
    TEST_ASSERT_FALSE(has_ended(0));
    motion.way_left = 25;
    TEST_ASSERT_TRUE(has_ended(0));
}

TEST(what_wheels_will_still_roll_is_part_of_the_next_step)
{
    motion.together.counts = 20;
    begin(0, 12);
    TEST_ASSERT_EQUAL_INT16(240 + 20, motion.way_left);
}

/* What is left of a turn that ended with this rest, and what wheels have still to roll of it. */
static int32_t left_after_a_turn(int32_t turn_left, int16_t to_come)
{
    stand_at(0.0, 0.0);
    begin(90, 0);
    motion.turn_left = turn_left;
    motion.apart.counts = to_come;
    begin(0, 0);
    return motion.turn_left;
}

TEST(the_rest_of_a_turn_is_made_up_for_up_to_half_a_degree)
{
    for (int side = LEAST; side <= MOST; side += 2) {
        TEST_ASSERT_EQUAL_INT32(side * DEGREE / 2, left_after_a_turn(side * DEGREE / 2, 0));
        TEST_ASSERT_EQUAL_INT32(0, left_after_a_turn(side * (DEGREE / 2 + 1), 0));
        TEST_ASSERT_EQUAL_INT32(side * 50 * COUNT, left_after_a_turn(side * 50 * COUNT, (int16_t)(side * 50)));
    }
}

TEST(a_turn_that_was_given_up_is_dropped_before_its_rest)
{
    const struct action trial = {.turn_deg = 45, .rest_ticks = 2};

    motion_begin(&motion, &config, &trial);
    TEST_ASSERT_TRUE(motion_rest(&motion, &config));
    TEST_ASSERT_EQUAL_INT32(0, motion.turn_left);
    TEST_ASSERT_EQUAL_UINT16(2, motion.ticks_left);
}

static void assert_told(const struct action *action, int left_mm_s, int right_mm_s, int apart, int together)
{
    struct drive drive;

    stand_at(0.0, 0.0);
    motion_begin(&motion, &config, action);
    drive = driven();
    TEST_ASSERT_EQUAL_INT16(left_mm_s, drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(right_mm_s, drive.right_mm_s);
    TEST_ASSERT_EQUAL_INT16(apart, motion.apart.commanded[0]);
    TEST_ASSERT_EQUAL_INT16(together, motion.together.commanded[0]);
}

TEST(what_wheels_are_told_is_what_they_have_to_roll)
{
    static const struct action right = {.turn_deg = 90}, left = {.turn_deg = -90}, step = {.forward_mm = 12};

    assert_told(&right, 251, -251, 100, 0);
    assert_told(&left, -251, 251, -100, 0);
    assert_told(&step, 200, 200, 0, 80);
    assert_told(&BACK, -200, -200, 0, -80);
}

TEST(a_glance_goes_on_when_food_is_seen)
{
    const struct senses senses = {.look = true, .tick = 1};

    motion_begin(&motion, &config, &GLANCE);
    motion_track(&motion, &senses);
    TEST_ASSERT_EQUAL_INT32(90 * DEGREE, motion.turn_left);
}

TEST(food_turns_the_robot_back_to_where_it_was_seen)
{
    struct senses senses = {.look = true, .tick = 1, .odometer_left = 30, .odometer_right = ODOMETER_SPAN - 30};

    motion_begin(&motion, &config, &FOOD_TURN);
    motion_track(&motion, &senses);
    TEST_ASSERT_EQUAL_INT32(0, motion.turn_left);
    senses = (struct senses){.look = true, .tick = 2, .odometer_left = 40, .odometer_right = ODOMETER_SPAN - 40};
    motion_track(&motion, &senses);
    TEST_ASSERT_EQUAL_INT32(-20 * COUNT, motion.turn_left);
    TEST_ASSERT_LESS_THAN_INT16(0, driven().left_mm_s);
}

TEST(a_wheel_that_has_rolled_and_stops_is_dead_after_two_seconds)
{
    unsigned ticks = 0;

    begin(90, 0);
    roll(50, -50);
    for ((void)driven(); !motion_gave_up(&motion); (void)driven()) {
        TEST_ASSERT_LESS_THAN_UINT(200, ++ticks);
        roll(ticks % 2 ? 20 : -20, 0);
        begin(ticks % 2 ? 3 : -3, 0);
    }
    TEST_ASSERT_EQUAL_UINT(100, ticks);
}
