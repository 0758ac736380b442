#include "firmware/motion/motion.h"

#include <math.h>

#include "tests/test.h"
#include "motion_rig.h"

static struct random dice;

void setUp(void)
{
    config_reset(&config);
    random_seed(&dice, 1);
    stand_at(0.0, 0.0);
}

TEST(turn_with_stuck_wheels_is_given_up)
{
    body.grip = 0.0;
    TEST_ASSERT_LESS_OR_EQUAL_UINT(2 * 59 + 25, act(210, 0));   /* 59 ticks at full speed */
}

TEST(step_with_stuck_wheels_is_given_up)
{
    body.grip = 0.0;
    TEST_ASSERT_LESS_OR_EQUAL_UINT(2 * 3 + 25, act(0, 12));
}

TEST(turn_given_up_is_not_corrected_later)
{
    body.grip = 0.0;
    act(90, 0);
    body.grip = 1.0;
    act(10, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 10000, heading_mdeg());
}

TEST(lifting_the_robot_clears_the_backlog)
{
    static const struct backlog nothing = {.counts = 0};

    body.grip = 0.5;
    act(90, 12);
    motion.apart.counts = motion.together.counts = 100;
    motion_lift(&motion);
    TEST_ASSERT_EQUAL_MEMORY(&nothing, &motion.apart, sizeof nothing);
    TEST_ASSERT_EQUAL_MEMORY(&nothing, &motion.together, sizeof nothing);
}

TEST(slow_wheels_are_not_given_up)
{
    body.grip = 0.6;
    act(210, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 210000, heading_mdeg());
}

/* Checks whether wheels at a share of their speed are denied, in turns of several angles. */
static void check_wheels_at_share(double share, bool are_denied)
{
    static const int paced[] = {-210, -150, -45, 45, 150, 210};

    for (unsigned i = 0; i < sizeof paced / sizeof *paced; i++) {
        stand_at(0.0, 0.0);
        body.grip = share;
        act(paced[i], 0);
        TEST_ASSERT_EQUAL(are_denied, motion_is_denied(&motion, &config));
    }
}

TEST(turns_at_up_to_half_speed_are_denied)
{
    check_wheels_at_share(0.3, true);
    check_wheels_at_share(0.4, true);
    check_wheels_at_share(0.5, true);
}

TEST(turns_at_60_to_120_percent_speed_are_not_denied)
{
    check_wheels_at_share(0.6, false);
    check_wheels_at_share(0.8, false);
    check_wheels_at_share(1.0, false);
    check_wheels_at_share(1.2, false);
}

/* At full speed each wheel makes 251 mm/s in a turn, 50 counts a tick. */
TEST(odometers_at_twice_the_speed_are_not_credible)
{
    struct senses senses = sensed();

    senses.odometer_left = (uint16_t)(senses.odometer_left + 60);
    TEST_ASSERT_TRUE(motion_is_credible(&motion, &config, &senses, 1));
    senses.odometer_left = (uint16_t)(senses.odometer_left + 40);
    TEST_ASSERT_FALSE(motion_is_credible(&motion, &config, &senses, 1));
    TEST_ASSERT_TRUE(motion_is_credible(&motion, &config, &senses, 2));
}

/* The faster of the two counts: here a step's 200 mm/s, 40 counts a tick. */
TEST(credible_distance_follows_the_step_speed_when_faster)
{
    struct senses senses = sensed();

    config.value[TURN_SPEED_DEG_S] = 30;
    senses.odometer_right = (uint16_t)(senses.odometer_right + 60);
    TEST_ASSERT_TRUE(motion_is_credible(&motion, &config, &senses, 1));
    senses.odometer_right = (uint16_t)(senses.odometer_right + 10);
    TEST_ASSERT_FALSE(motion_is_credible(&motion, &config, &senses, 1));
}

/* After a gap of two ticks, in which each wheel may have rolled 100 counts. */
static bool is_credible_from(uint16_t left, uint16_t right, uint16_t left_now, uint16_t right_now)
{
    const struct senses before = {.odometer_left = left, .odometer_right = right};
    const struct senses now = {.odometer_left = left_now, .odometer_right = right_now};

    motion_track(&motion, &before);
    return motion_is_credible(&motion, &config, &now, 2);
}

TEST(odometers_that_both_restart_at_0_are_not_credible)
{
    TEST_ASSERT_FALSE(is_credible_from(0, 90, 0, 0));
    TEST_ASSERT_FALSE(is_credible_from(90, 0, 0, 0));
}

TEST(single_odometer_at_0_is_credible)
{
    TEST_ASSERT_TRUE(is_credible_from(90, 90, 0, 40));
    TEST_ASSERT_TRUE(is_credible_from(90, 90, 40, 0));
}

TEST(missed_ticks_count_for_the_pace)
{
    begin(150, 0);
    for (unsigned senses = 0; !tick(); senses++) {
        body.tick += 2;   /* of three ticks, the senses of one come */
        TEST_ASSERT_LESS_THAN_UINT(100, senses);
    }
    TEST_ASSERT_TRUE(motion_is_denied(&motion, &config));
}

static void end_action(void)
{
    while (!tick())
        continue;
}

TEST(outage_counts_only_until_wheels_stop)
{
    begin(45, 0);
    (void)tick();
    body.tick += 100;
    end_action();
    TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
}

/* At each speed, down to the lowest that is not denied. */
TEST(rest_after_a_turn_does_not_use_its_time)
{
    const struct action trial = {.turn_deg = 45, .rest_ticks = 2};

    for (unsigned percent = 100; percent > 50; percent--) {
        stand_at(0.0, 0.0);
        body.grip = percent / 100.0;
        motion_begin(&motion, &config, &trial);
        end_action();
        if (motion_is_denied(&motion, &config))
            return;
        TEST_ASSERT_TRUE(motion_rest(&motion, &config));
        end_action();
        TEST_ASSERT_FALSE(motion_is_denied(&motion, &config));
    }
    TEST_FAIL_MESSAGE("all were believed");
}

TEST(rest_of_a_turn_ended_by_food_is_dropped)
{
    const struct action search = {.turn_deg = 90, .rest_ticks = 2, .until_food = true};
    struct senses senses;
    long found_at;

    motion_begin(&motion, &config, &search);
    for (unsigned i = 0; i < 5; i++)
        TEST_ASSERT_FALSE(tick());
    senses = sensed();
    senses.look = true;
    motion_track(&motion, &senses);
    TEST_ASSERT_TRUE(motion_ended(&motion, &config, &senses));
    TEST_ASSERT_TRUE(motion_rest(&motion, &config));
    end_action();
    found_at = heading_mdeg();
    act(10, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 10000, heading_mdeg() - found_at);
}

TEST(motion_ignores_odometers_while_lifted)
{
    struct senses senses;

    begin(90, 0);
    (void)tick();
    motion_lift(&motion);
    body.left_mm += 123.0;
    senses = sensed();
    motion_track(&motion, &senses);
    end_action();
    TEST_ASSERT_INT_WITHIN(HALF, lround(1000.0 * (90.0 + 123.0 / 160.0 * 180.0 / PI)), heading_mdeg());
}

TEST(stuck_wheels_are_given_up_at_the_limits_of_parameters)
{
    for (unsigned corner = 0; corner < 16; corner++) {
        set_corner(corner);
        stand_at(0.0, 0.0);
        body.grip = 0.0;
        TEST_ASSERT_GREATER_OR_EQUAL_UINT(20, act(TURN_MAX_DEG, 0));
        motion.left = motion.right = (struct standing){.ticks = 0};
        TEST_ASSERT_GREATER_OR_EQUAL_UINT(20, act(0, STEP_MAX_MM));
    }
}

/* Ticks of short actions, too short to be judged one by one, until one is given up; each wheel rolls to and fro. */
static unsigned ticks_until_given_up(double left_mm, double right_mm)
{
    for (unsigned ticks = 0; ticks < 300; ticks++) {
        struct senses senses;

        if (ticks % 4 == 0)
            begin(ticks % 8 ? 3 : -3, 0);
        if (ticks % 20 == 0)
            begin(0, 12);
        (void)commanded();
        if (motion_gave_up(&motion))
            return ticks;
        body.tick++;
        body.left_mm += ticks % 2 ? left_mm : -left_mm;
        body.right_mm += ticks % 2 ? right_mm : -right_mm;
        senses = sensed();
        motion_track(&motion, &senses);
    }
    return 0;
}

TEST(wheel_is_dead_after_two_seconds_at_rest_in_any_actions)
{
    static const uint8_t tick_ms[] = {10, 20, 100};

    for (unsigned i = 0; i < sizeof tick_ms; i++) {
        config.value[TICK_MS] = tick_ms[i];
        stand_at(100.0, 100.0);
        TEST_ASSERT_EQUAL_UINT(2000 / tick_ms[i], ticks_until_given_up(0.0, 20.0));
        stand_at(100.0, 100.0);
        TEST_ASSERT_EQUAL_UINT(2000 / tick_ms[i], ticks_until_given_up(20.0, 0.0));
    }
}

TEST(wheel_stays_dead_while_at_rest)
{
    for (unsigned ticks = 0; ticks < 300; ticks++) {
        begin(0, 12);
        body.grip = 0.0;
        (void)tick();
        TEST_ASSERT_EQUAL(ticks >= 100, motion_gave_up(&motion));
    }
}

TEST(dead_wheel_may_jitter_by_a_few_counts)
{
    stand_at(100.05, 100.05);
    TEST_ASSERT_EQUAL_UINT(100, ticks_until_given_up(0.3, 20.0));
    stand_at(100.05, 100.05);
    TEST_ASSERT_EQUAL_UINT(0, ticks_until_given_up(0.4, 20.0));
}

TEST(wheel_at_rest_counts_as_obeying)
{
    struct senses senses = sensed();

    for (unsigned ticks = 0; ticks < 300; ticks++) {
        begin(0, 0);
        (void)commanded();
        senses.tick++;
        motion_track(&motion, &senses);
    }
    begin(0, 12);
    (void)commanded();
    TEST_ASSERT_FALSE(motion_gave_up(&motion));
}

static uint16_t random_odometer(void)
{
    return (uint16_t)(random_next(&dice) & (ODOMETER_SPAN - 1));
}

/* Odometers gone mad: the sanitizers watch for overflow, this test for speeds that do not fit the wire. */
TEST(random_odometers_keep_wheel_speeds_within_limits)
{
    for (unsigned i = 0; i < 200000; i++) {
        const struct senses senses = {.odometer_left = random_odometer(), .odometer_right = random_odometer()};

        if (i % 1000 == 0)
            set_corner(i / 1000 % 16);
        motion_track(&motion, &senses);
        if (motion_ended(&motion, &config, &senses) || random_below(&dice, 50) == 0)
            begin(random_below(&dice, 2) ? TURN_MAX_DEG : -TURN_MAX_DEG, random_below(&dice, 2) * (unsigned)STEP_MAX_MM);
        TEST_ASSERT_INT16_WITHIN(1257, 0, commanded().left_mm_s);
        TEST_ASSERT_INT16_WITHIN(1257, 0, commanded().right_mm_s);
    }
}

TEST(jump_of_either_odometer_is_not_credible)
{
    struct senses senses = {.odometer_left = 0};

    config_reset(&config);
    motion = (struct motion){.referenced = true};
    TEST_ASSERT_TRUE(motion_is_credible(&motion, &config, &senses, 1));
    senses.odometer_left = 2000;
    TEST_ASSERT_FALSE(motion_is_credible(&motion, &config, &senses, 1));
    senses = (struct senses){.odometer_right = 2000};
    TEST_ASSERT_FALSE(motion_is_credible(&motion, &config, &senses, 1));
}

/* The same way each time, so that the error grows to its limit. */
TEST(spinning_body_does_not_overflow)
{
    uint16_t odometer = 0;

    for (unsigned i = 0; i < 10000; i++) {
        const struct senses senses = {.odometer_left = odometer, .odometer_right = (uint16_t)(4095 - odometer)};

        motion_track(&motion, &senses);
        begin(i < 5000 ? -TURN_MAX_DEG : TURN_MAX_DEG, 0);
        odometer = (uint16_t)((odometer + 2000) % ODOMETER_SPAN);
        TEST_ASSERT_INT16_WITHIN(2047, 0, commanded().left_mm_s);
    }
}
