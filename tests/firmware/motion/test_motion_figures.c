/* What motion makes of its figures, to the last count: 160 mm between the wheels, 200 mm/s, 180 degrees/s, ticks of 20 ms. */
#include "firmware/motion/motion.h"
#include "tests/test.h"
#include "motion_rig.h"

enum {
    DEGREE = 457528,                    /* of turn_left: 160 mm * pi / 180, of which a count of both wheels is COUNT */
    COUNT = 16384,
    PRECISION = DEGREE / 8,
    TURN_MAX = 1000000000,
    WAY_MAX = 16000,
    FASTEST_COUNTS = 50                 /* of a wheel in a tick, turning */
};

void setUp(void)
{
    config_reset(&config);
    stand_at(0.0, 0.0);
}

static bool has_ended(void)
{
    const struct senses senses = {.tick = body.tick};

    return motion_ended(&motion, &config, &senses);
}

static bool is_credible(int left_counts, int right_counts, unsigned ticks)
{
    const struct senses senses = {
        .odometer_left = (uint16_t)(left_counts & (ODOMETER_SPAN - 1)),
        .odometer_right = (uint16_t)(right_counts & (ODOMETER_SPAN - 1)),
    };

    return motion_is_credible(&motion, &config, &senses, ticks);
}

static void assert_farthest(int counts, unsigned ticks)
{
    TEST_ASSERT_TRUE(is_credible(counts, -counts, ticks));
    TEST_ASSERT_FALSE(is_credible(counts + 1, 0, ticks));
    TEST_ASSERT_FALSE(is_credible(0, -counts - 1, ticks));
}

TEST(degree_in_counts_is_rounded_to_nearest)
{
    begin(1, 0);
    TEST_ASSERT_EQUAL_INT32(DEGREE, motion.turn_left);
}

TEST(credible_distance_is_13_eighths_of_full_speed_plus_2)
{
    assert_farthest(83, 1);
    assert_farthest(409, 5);
}

TEST(credible_distance_follows_the_faster_parameter)
{
    config.value[SPEED_MM_S] = 250;
    config.value[TURN_SPEED_DEG_S] = 30;
    assert_farthest(83, 1);
    config.value[SPEED_MM_S] = 20;
    config.value[TURN_SPEED_DEG_S] = 180;
    assert_farthest(83, 1);
}

TEST(odometers_of_a_lifted_robot_are_credible)
{
    motion_lift(&motion);
    TEST_ASSERT_TRUE(is_credible(2000, -2000, 1));
}

TEST(half_the_span_counts_as_backward)
{
    roll(ODOMETER_SPAN / 2 - 1, ODOMETER_SPAN / 2 - 1);
    TEST_ASSERT_EQUAL_INT16(-(ODOMETER_SPAN - 2), motion.way_left);
    motion.way_left = 0;
    roll(ODOMETER_SPAN / 2, ODOMETER_SPAN / 2);
    TEST_ASSERT_EQUAL_INT16(ODOMETER_SPAN, motion.way_left);
}

TEST(turn_error_is_limited)
{
    for (unsigned i = 0; i < 20; i++)
        roll(2000, -2000);
    TEST_ASSERT_EQUAL_INT32(-TURN_MAX, motion.turn_left);
    begin(-TURN_MAX_DEG, 0);
    TEST_ASSERT_EQUAL_INT32(-TURN_MAX, motion.turn_left);
    for (unsigned i = 0; i < 40; i++)
        roll(-2000, 2000);
    TEST_ASSERT_EQUAL_INT32(TURN_MAX, motion.turn_left);
}

TEST(turn_plus_error_is_limited)
{
    for (unsigned i = 0; i < 20; i++)
        roll(-2000, 2000);
    begin(TURN_MAX_DEG, 0);
    TEST_ASSERT_EQUAL_INT32(TURN_MAX, motion.turn_left);
}

TEST(distance_left_is_limited)
{
    for (unsigned i = 0; i < 5; i++)
        roll(2000, 2000);
    TEST_ASSERT_EQUAL_INT16(-WAY_MAX, motion.way_left);
    for (unsigned i = 0; i < 10; i++)
        roll(-2000, -2000);
    TEST_ASSERT_EQUAL_INT16(WAY_MAX, motion.way_left);
}

TEST(turn_ends_an_eighth_of_a_degree_early)
{
    begin(1, 0);
    motion.apart.rolled = 2 * FASTEST_COUNTS;
    motion.turn_left = PRECISION + 1;
    TEST_ASSERT_FALSE(has_ended());
    motion.turn_left = PRECISION;
    TEST_ASSERT_TRUE(has_ended());
}

TEST(step_ends_five_counts_early)
{
    begin(0, 12);
    motion.way_left = 6;
    TEST_ASSERT_FALSE(has_ended());
    motion.way_left = 5;
    TEST_ASSERT_TRUE(has_ended());
}

TEST(last_speed_of_a_step_covers_the_rest_in_one_tick)
{
    static const struct {
        uint8_t tick_ms;
        int16_t way_left;
        int16_t speed_mm_s;
    } cases[] = {{20, 1, 3}, {20, -1, -3}, {20, 79, 198}, {30, 119, 198}, {20, 0, 0}};

    for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
        config.value[TICK_MS] = cases[i].tick_ms;
        begin(0, 12);
        motion.way_left = cases[i].way_left;
        TEST_ASSERT_EQUAL_INT16(cases[i].speed_mm_s, commanded().left_mm_s);
    }
}

TEST(last_speed_of_a_turn_covers_the_rest_in_one_tick)
{
    begin(1, 0);
    motion.turn_left = FASTEST_COUNTS * COUNT;
    TEST_ASSERT_EQUAL_INT16(125, commanded().left_mm_s);
    TEST_ASSERT_EQUAL_INT16(-125, commanded().right_mm_s);
}

/* 120 mm take 30 ticks: twice as many, and 25. */
TEST(step_time_limit_is_twice_its_time_plus_25_ticks)
{
    body.grip = 0.0;
    TEST_ASSERT_EQUAL_UINT(85, act(0, 120));
}

TEST(step_without_grip_is_denied_at_its_time_limit)
{
    body.grip = 0.0;
    begin(0, 120);
    for (unsigned i = 1; i < 85; i++) {
        (void)tick();
        TEST_ASSERT_FALSE(motion_gave_up(&motion) || motion_is_denied(&motion, &config));
    }
    (void)tick();
    TEST_ASSERT_TRUE(motion_gave_up(&motion));
    TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
}

TEST(rest_is_never_given_up)
{
    act(0, 0);
    TEST_ASSERT_FALSE(motion_gave_up(&motion));
}

/* In a turn at full speed each wheel makes 251 mm/s: both make 1004 counts in 0.2 s. */
TEST(straying_limit_is_200_ms_of_rolling)
{
    motion.astray = 1003;
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
    motion.astray = 1004;
    TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
}

/* A step of 12 mm is 240 counts. */
TEST(correct_rolling_reduces_straying_to_0_at_least)
{
    motion.astray = 181;
    act(0, 12);
    TEST_ASSERT_EQUAL_UINT16(1, motion.astray);
    act(0, 12);
    TEST_ASSERT_EQUAL_UINT16(0, motion.astray);
}

/* 210 degrees are 5864 counts, and a tick at full speed 100. */
TEST(turn_pace_is_seven_quarters_plus_2_ticks)
{
    begin(210, 0);
    TEST_ASSERT_EQUAL_UINT16(10462, motion.pace_left);
}

TEST(step_and_turn_for_food_have_no_pace)
{
    const struct action around = {.turn_deg = 360, .until_food = true};

    begin(0, 250);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, motion.pace_left);
    motion_begin(&motion, &config, &around);
    TEST_ASSERT_EQUAL_UINT16(UINT16_MAX, motion.pace_left);
}

TEST(outage_costs_five_ticks_of_the_pace)
{
    static const uint8_t ticks[] = {5, 6, 7, 100};

    for (unsigned i = 0; i < sizeof ticks; i++) {
        stand_at(0.0, 0.0);
        begin(210, 0);
        (void)commanded();
        body.tick = (uint8_t)(body.tick + ticks[i] - 1);
        roll(0, 0);
        TEST_ASSERT_EQUAL_UINT16(10462 - 500, motion.pace_left);
    }
}

TEST(rest_commands_no_speed_when_wheels_move)
{
    begin(0, 0);
    roll(80, 20);
    TEST_ASSERT_EQUAL_INT16(0, commanded().left_mm_s);
    TEST_ASSERT_EQUAL_INT16(0, commanded().right_mm_s);
}

/* A knock by 180 counts is 6.4 degrees. */
TEST(turn_corrects_for_motion_since_the_last_turn)
{
    roll(90, -90);
    begin(0, 12);
    begin(10, 0);
    TEST_ASSERT_EQUAL_INT32(10 * DEGREE - 180 * COUNT, motion.turn_left);
}

TEST(turn_given_up_leaves_no_error)
{
    begin(90, 0);
    begin(0, 12);
    TEST_ASSERT_EQUAL_INT32(0, motion.turn_left);
}
