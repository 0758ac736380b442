/* The limits of each rule of motion, exact to a count: a turn makes 100 counts in a tick, a step 80. */
#include "firmware/motion/motion.h"
#include "tests/test.h"
#include "motion_rig.h"

enum { COUNT = 16384, DEGREE = 457528, TO_THE_LEFT = -1, TO_THE_RIGHT = 1 };

static const struct action LOOK_AROUND = {.reason = REASON_LOOK_AROUND, .turn_deg = 90};
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
        (void)commanded();
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

TEST(restart_is_assumed_up_to_8_counts)
{
    TEST_ASSERT_FALSE(is_credible(90, 8, 8, 2));
    TEST_ASSERT_FALSE(is_credible(90, -8, -8, 2));
    TEST_ASSERT_TRUE(is_credible(90, 9, 8, 2));
    TEST_ASSERT_TRUE(is_credible(90, 8, 9, 2));
    TEST_ASSERT_TRUE(is_credible(-90, -9, -8, 2));
}

TEST(odometers_that_stay_near_0_are_credible)
{
    TEST_ASSERT_TRUE(is_credible(0, 0, 0, 2));
    TEST_ASSERT_TRUE(is_credible(8, 0, 0, 2));
    TEST_ASSERT_FALSE(is_credible(9, 0, 0, 2));
}

TEST(odometers_at_0_without_a_gap_are_credible)
{
    TEST_ASSERT_TRUE(is_credible(50, 0, 0, 1));
}

TEST(credible_distance_is_limited_to_five_ticks)
{
    static const unsigned ticks[] = {5, 6, 100};

    for (unsigned i = 0; i < sizeof ticks / sizeof *ticks; i++) {
        TEST_ASSERT_TRUE(is_credible(1000, 1409, 591, ticks[i]));
        TEST_ASSERT_FALSE(is_credible(1000, 1410, 1000, ticks[i]));
        TEST_ASSERT_FALSE(is_credible(1000, 1000, 590, ticks[i]));
    }
}

/* The counts astray after a tick of a step, with a backlog of wheels apart. */
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

TEST(backlog_of_a_turn_is_not_straying_in_a_step)
{
    TEST_ASSERT_EQUAL_UINT(30, astray_in_a_step(0, 15, -15));
    TEST_ASSERT_EQUAL_UINT(0, astray_in_a_step(30, 15, -15));
    TEST_ASSERT_EQUAL_UINT(10, astray_in_a_step(30, 20, -20));
    TEST_ASSERT_EQUAL_UINT(0, astray_in_a_step(-30, -15, 15));
    TEST_ASSERT_EQUAL_UINT(10, astray_in_a_step(-30, -20, 20));
    TEST_ASSERT_EQUAL_UINT(0, astray_in_a_step(-1, 0, 1));
    TEST_ASSERT_EQUAL_UINT(0, astray_in_a_step(1, 1, 0));
}

TEST(rolling_against_the_backlog_counts_as_straying)
{
    TEST_ASSERT_EQUAL_UINT(30, astray_in_a_step(30, -15, 15));
    TEST_ASSERT_EQUAL_UINT(30, astray_in_a_step(-30, 15, -15));
    TEST_ASSERT_EQUAL_UINT(1, astray_in_a_step(-1, 1, 0));
}

TEST(backlog_of_a_step_is_not_straying_in_a_turn)
{
    TEST_ASSERT_EQUAL_UINT(40, astray_in_a_turn(0, 20, 20));
    TEST_ASSERT_EQUAL_UINT(10, astray_in_a_turn(30, 20, 20));
    TEST_ASSERT_EQUAL_UINT(10, astray_in_a_turn(-30, -20, -20));
}

TEST(correct_rolling_offsets_straying_by_three_quarters)
{
    begin(0, 12);
    motion.astray = 10;
    roll(2, 2);
    TEST_ASSERT_EQUAL_UINT16(7, motion.astray);
    roll(-2, -2);
    TEST_ASSERT_EQUAL_UINT16(4, motion.astray);
}

TEST(straying_is_limited_in_and_between_actions)
{
    begin(0, 250);
    for (unsigned i = 0; i < 20; i++)
        roll(1500, -1500);
    TEST_ASSERT_EQUAL_UINT16(16000, motion.astray);
    begin(0, 12);
    TEST_ASSERT_EQUAL_UINT16(1004, motion.astray);
    TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
}

TEST(turn_is_denied_when_its_pace_is_used_up)
{
    begin(210, 0);
    motion.pace_left = 101;
    (void)commanded();
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
    for (int side = TO_THE_LEFT; side <= TO_THE_RIGHT; side += 2) {
        stand_at(0.0, 0.0);
        begin(side * 210, 0);
        for (unsigned i = 1; i <= 10; i++) {
            (void)commanded();
            roll(side * 25, side * -24);
            TEST_ASSERT_EQUAL(i == 10, motion_is_denied(&motion, &config));
        }
    }
}

TEST(wheels_that_slow_down_in_a_turn_are_denied)
{
    begin(210, 0);
    roll_for(20, 50, -50);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
    roll_for(1, 24, -24);
    TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
}

TEST(wheels_at_half_speed_are_not_denied)
{
    begin(210, 0);
    roll_for(30, 25, -25);
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
}

TEST(turn_for_food_is_not_judged_by_its_pace)
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
    motion_begin(&motion, &config, &LOOK_AROUND);
    TEST_ASSERT_FALSE(motion_tells(&motion));
    begin(0, 250);
    TEST_ASSERT_FALSE(motion_tells(&motion));
}

TEST(turn_beyond_the_counting_limit_is_not_judged)
{
    for (unsigned i = 0; i < 20; i++)
        roll(-2000, 2000);
    begin(210, 0);
    TEST_ASSERT_FALSE(motion_tells(&motion));
}

TEST(time_limit_depends_on_the_kind_of_action)
{
    begin(210, 0);
    TEST_ASSERT_EQUAL_UINT16(5864 * 3 / 2 / 100 + 25, motion.ticks_left);
    begin(0, 0);
    TEST_ASSERT_EQUAL_UINT16(1, motion.ticks_left);
    motion_begin(&motion, &config, &BACK);
    TEST_ASSERT_EQUAL_UINT16(240 * 2 / 80 + 25, motion.ticks_left);
}

TEST(turn_ends_when_wheels_stop_within_half_a_degree)
{
    for (int side = TO_THE_LEFT; side <= TO_THE_RIGHT; side += 2) {
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
TEST(turn_end_allows_a_backlog_of_three_eighths_degree)
{
    for (int side = TO_THE_LEFT; side <= TO_THE_RIGHT; side += 2) {
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
        motion_begin(&motion, &config, &LOOK_AROUND);
        motion.turn_left = side * 11 * COUNT;
        TEST_ASSERT_TRUE(has_ended(0));
    }
}

TEST(backward_step_ends_five_counts_early_despite_obstacles)
{
    motion_begin(&motion, &config, &BACK);
    motion.way_left = -6;
    TEST_ASSERT_FALSE(has_ended(FEEL_FRONT));
    motion.way_left = -5;
    TEST_ASSERT_TRUE(has_ended(0));
    motion.way_left = 0;
    TEST_ASSERT_TRUE(has_ended(0));
}

TEST(backlog_ends_a_step_earlier)
{
    begin(0, 12);
    motion.way_left = 26;
    motion.together.counts = 20;
    TEST_ASSERT_FALSE(has_ended(0));
    motion.way_left = 25;
    TEST_ASSERT_TRUE(has_ended(0));
}

TEST(backlog_is_added_to_the_next_step)
{
    motion.together.counts = 20;
    begin(0, 12);
    TEST_ASSERT_EQUAL_INT16(240 + 20, motion.way_left);
}

/* The turn left after a turn that ended with this error and this backlog. */
static int32_t left_after_a_turn(int32_t turn_left, int16_t to_come)
{
    stand_at(0.0, 0.0);
    begin(90, 0);
    motion.turn_left = turn_left;
    motion.apart.counts = to_come;
    begin(0, 0);
    return motion.turn_left;
}

TEST(turn_error_is_carried_over_up_to_half_a_degree)
{
    for (int side = TO_THE_LEFT; side <= TO_THE_RIGHT; side += 2) {
        TEST_ASSERT_EQUAL_INT32(side * DEGREE / 2, left_after_a_turn(side * DEGREE / 2, 0));
        TEST_ASSERT_EQUAL_INT32(0, left_after_a_turn(side * (DEGREE / 2 + 1), 0));
        TEST_ASSERT_EQUAL_INT32(side * 50 * COUNT, left_after_a_turn(side * 50 * COUNT, (int16_t)(side * 50)));
    }
}

TEST(turn_given_up_is_dropped_before_its_rest)
{
    const struct action trial = {.turn_deg = 45, .rest_ticks = 2};

    motion_begin(&motion, &config, &trial);
    TEST_ASSERT_TRUE(motion_rest(&motion, &config));
    TEST_ASSERT_EQUAL_INT32(0, motion.turn_left);
    TEST_ASSERT_EQUAL_UINT16(2, motion.ticks_left);
}

static void assert_commanded(const struct action *action, int left_mm_s, int right_mm_s, int apart, int together)
{
    struct drive drive;

    stand_at(0.0, 0.0);
    motion_begin(&motion, &config, action);
    drive = commanded();
    TEST_ASSERT_EQUAL_INT16(left_mm_s, drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(right_mm_s, drive.right_mm_s);
    TEST_ASSERT_EQUAL_INT16(apart, motion.apart.commanded[0]);
    TEST_ASSERT_EQUAL_INT16(together, motion.together.commanded[0]);
}

TEST(commanded_counts_match_the_wheel_speeds)
{
    static const struct action right = {.turn_deg = 90}, left = {.turn_deg = -90}, step = {.forward_mm = 12};

    assert_commanded(&right, 251, -251, 100, 0);
    assert_commanded(&left, -251, 251, -100, 0);
    assert_commanded(&step, 200, 200, 0, 80);
    assert_commanded(&BACK, -200, -200, 0, -80);
}

TEST(look_around_continues_when_food_is_seen)
{
    const struct senses senses = {.look = true, .tick = 1};

    motion_begin(&motion, &config, &LOOK_AROUND);
    motion_track(&motion, &senses);
    TEST_ASSERT_EQUAL_INT32(90 * DEGREE, motion.turn_left);
}

TEST(turn_for_food_returns_to_the_sighting)
{
    struct senses senses = {.look = true, .tick = 1, .odometer_left = 30, .odometer_right = ODOMETER_SPAN - 30};

    motion_begin(&motion, &config, &FOOD_TURN);
    motion_track(&motion, &senses);
    TEST_ASSERT_EQUAL_INT32(0, motion.turn_left);
    senses = (struct senses){.look = true, .tick = 2, .odometer_left = 40, .odometer_right = ODOMETER_SPAN - 40};
    motion_track(&motion, &senses);
    TEST_ASSERT_EQUAL_INT32(-20 * COUNT, motion.turn_left);
    TEST_ASSERT_LESS_THAN_INT16(0, commanded().left_mm_s);
}

TEST(wheel_that_stops_rolling_is_dead_after_two_seconds)
{
    unsigned ticks = 0;

    begin(90, 0);
    roll(50, -50);
    for ((void)commanded(); !motion_gave_up(&motion); (void)commanded()) {
        TEST_ASSERT_LESS_THAN_UINT(200, ++ticks);
        roll(ticks % 2 ? 20 : -20, 0);
        begin(ticks % 2 ? 3 : -3, 0);
    }
    TEST_ASSERT_EQUAL_UINT(100, ticks);
}
