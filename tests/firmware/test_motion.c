#include "firmware/motion.h"

#include <math.h>

#include <unity.h>

enum { FRONT = 4 };

static const double PI = 3.14159265358979323846;

/* Two wheels that do exactly as they are told, and count their way. */
static struct {
    double left_mm, right_mm;
    double grip;   /* wheels make this part of the wanted speed; more than 1 if they are faster, or count too much */
    uint8_t feel;
    uint8_t tick;
} body;

static struct config config;
static struct motion motion;
static struct random dice;

static uint16_t counted(double mm)
{
    return (uint16_t)((int64_t)floor(mm * ODOMETER_COUNTS_PER_MM) & (ODOMETER_SPAN - 1));
}

static struct senses sensed(void)
{
    return (struct senses){
        .tick = body.tick,
        .feel = body.feel,
        .odometer_left = counted(body.left_mm),
        .odometer_right = counted(body.right_mm),
    };
}

/* Half a degree and half a millimetre, in thousandths as below. */
enum { HALF = 500, HARDLY_ANY = 1 };

static long heading_mdeg(void)
{
    return lround(1000.0 * (body.left_mm - body.right_mm) / config.value[WHEEL_TRACK_MM] * 180.0 / PI);
}

static long way_um(void)
{
    return lround(1000.0 * (body.left_mm + body.right_mm) / 2.0);
}

static struct drive driven(void)
{
    struct drive drive;

    motion_drive(&motion, &config, &drive);
    return drive;
}

/* One tick: the wheels turn, and what they did is sensed. True if the action has ended. */
static bool tick(void)
{
    const struct drive drive = driven();
    struct senses senses;

    body.tick++;
    body.left_mm += body.grip * drive.left_mm_s * config.value[TICK_MS] / 1000.0;
    body.right_mm += body.grip * drive.right_mm_s * config.value[TICK_MS] / 1000.0;
    senses = sensed();
    motion_track(&motion, &senses);
    return motion_ended(&motion, &config, &senses);
}

static void begin(int turn_deg, unsigned forward_mm)
{
    const struct action action = {.turn_deg = (int16_t)turn_deg, .forward_mm = (uint8_t)forward_mm};

    motion_begin(&motion, &config, &action);
}

/* Carries one action through; returns how many ticks it took. */
static unsigned act(int turn_deg, unsigned forward_mm)
{
    enum { FAR_TOO_MANY = 100000 };
    unsigned ticks = 1;

    begin(turn_deg, forward_mm);
    while (!tick())
        TEST_ASSERT_LESS_THAN_UINT(FAR_TOO_MANY, ticks++);
    return ticks;
}

static void stand_at(double left_mm, double right_mm)
{
    struct senses senses;

    body.left_mm = left_mm;
    body.right_mm = right_mm;
    body.grip = 1.0;
    body.feel = 0;
    motion_start(&motion);
    senses = sensed();
    motion_track(&motion, &senses);
}

void setUp(void)
{
    config_reset(&config);
    random_seed(&dice, 1);
    stand_at(0.0, 0.0);
}

void tearDown(void) {}

static void test_a_positive_turn_is_to_the_right(void)
{
    begin(10, 0);
    TEST_ASSERT_GREATER_THAN_INT16(0, driven().left_mm_s);
    TEST_ASSERT_EQUAL_INT16(-driven().left_mm_s, driven().right_mm_s);
}

static void test_each_turn_ends_within_half_a_degree(void)
{
    for (int turn_deg = -210; turn_deg <= 210; turn_deg++) {
        stand_at(0.0, 0.0);
        if (turn_deg != 0)
            act(turn_deg, 0);
        TEST_ASSERT_INT_WITHIN(HALF, 1000 * turn_deg, heading_mdeg());
    }
}

static void test_errors_of_a_thousand_turns_do_not_add_up(void)
{
    int sum_deg = 0;

    for (unsigned i = 0; i < 1000; i++) {
        int turn_deg = (random_below(&dice, 2) ? 1 : -1) * (1 + random_below(&dice, 210));

        sum_deg += turn_deg;
        act(turn_deg, 0);
        TEST_ASSERT_INT_WITHIN(HALF, 1000 * sum_deg, heading_mdeg());
    }
}

/* A thousand turns all one way: an error that always has the same sign shows here. */
static void test_errors_of_equal_turns_do_not_add_up(void)
{
    for (unsigned i = 1; i <= 1000; i++)
        act(10, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 10000000, heading_mdeg());
}

static void test_steps_between_turns_do_not_spoil_the_heading(void)
{
    for (unsigned i = 0; i < 1000; i++) {
        act(7, 0);
        act(0, 12);
    }
    TEST_ASSERT_INT_WITHIN(HALF, 7000000, heading_mdeg());
}

static void test_a_turn_moves_nowhere(void)
{
    act(210, 0);
    TEST_ASSERT_INT_WITHIN(HARDLY_ANY, 0, way_um());
}

static void test_what_one_turn_misses_is_made_up_for_in_the_next(void)
{
    act(90, 0);
    body.left_mm += 8.0;   /* a knock turns the body by 2.9 degrees, and the wheels feel it */
    act(-90, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 0, heading_mdeg());
}

static void test_each_step_ends_within_half_a_millimetre(void)
{
    for (unsigned forward_mm = 1; forward_mm <= 250; forward_mm++) {
        stand_at(0.0, 0.0);
        act(0, forward_mm);
        TEST_ASSERT_INT_WITHIN(HALF, 1000 * (long)forward_mm, way_um());
    }
}

static void test_a_step_goes_straight(void)
{
    act(0, 500);
    TEST_ASSERT_INT_WITHIN(HARDLY_ANY, 0, heading_mdeg());
}

static void test_a_step_ends_in_the_tick_that_brings_an_obstacle(void)
{
    begin(0, 500);
    TEST_ASSERT_FALSE(tick());
    body.feel = FRONT;
    TEST_ASSERT_TRUE(tick());
}

static void test_an_obstacle_beside_the_body_does_not_end_a_step(void)
{
    begin(0, 500);
    body.feel = 1 | 16;
    TEST_ASSERT_FALSE(tick());
}

static void test_an_obstacle_does_not_end_a_turn(void)
{
    body.feel = FRONT;
    act(45, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 45000, heading_mdeg());
}

static void test_what_a_stopped_step_left_is_not_driven_later(void)
{
    begin(0, 500);
    body.feel = FRONT;
    TEST_ASSERT_TRUE(tick());
    body.feel = 0;
    stand_at(0.0, 0.0);
    act(0, 12);
    TEST_ASSERT_INT_WITHIN(HALF, 12000, way_um());
}

static void test_the_odometers_may_wrap_forward(void)
{
    stand_at(409.0, 409.0);   /* 6 counts before the wrap */
    act(0, 12);
    TEST_ASSERT_INT_WITHIN(HALF, 421000, way_um());
}

static void test_the_odometers_may_wrap_backward(void)
{
    stand_at(0.3, 0.3);
    act(180, 0);
    act(-180, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 0, heading_mdeg());
}

static void test_rest_lasts_one_tick(void)
{
    TEST_ASSERT_EQUAL_UINT(1, act(0, 0));
}

static void test_wheels_rest_between_actions(void)
{
    act(0, 0);
    TEST_ASSERT_EQUAL_INT16(0, driven().left_mm_s);
    TEST_ASSERT_EQUAL_INT16(0, driven().right_mm_s);
}

static void test_nothing_is_under_way_before_the_first_action(void)
{
    const struct senses senses = sensed();

    TEST_ASSERT_TRUE(motion_ended(&motion, &config, &senses));
}

static void test_a_step_keeps_to_its_speed(void)
{
    begin(0, 500);
    TEST_ASSERT_EQUAL_INT16(200, driven().left_mm_s);
}

/* 180 degrees/s with 160 mm between the wheels: each makes 80 mm * pi a second. */
static void test_a_turn_keeps_to_its_speed(void)
{
    begin(210, 0);
    TEST_ASSERT_INT16_WITHIN(1, 251, driven().left_mm_s);
}

static void test_a_turn_against_stuck_wheels_is_given_up(void)
{
    body.grip = 0.0;
    TEST_ASSERT_LESS_OR_EQUAL_UINT(2 * 59 + 25, act(210, 0));   /* 59 ticks at full speed */
}

static void test_a_step_against_stuck_wheels_is_given_up(void)
{
    body.grip = 0.0;
    TEST_ASSERT_LESS_OR_EQUAL_UINT(2 * 3 + 25, act(0, 12));
}

static void test_a_turn_that_was_given_up_is_not_made_up_for(void)
{
    body.grip = 0.0;
    act(210, 0);
    body.grip = 1.0;
    act(10, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 10000, heading_mdeg());
}

static void test_slow_wheels_are_not_given_up(void)
{
    body.grip = 0.6;
    act(210, 0);
    TEST_ASSERT_INT_WITHIN(HALF, 210000, heading_mdeg());
}

static const int PACED[] = {-210, -150, -45, 45, 150, 210};

static void test_wheels_that_turn_at_half_the_speed_are_denied(void)
{
    static const double factors[] = {0.3, 0.4, 0.5};

    for (unsigned i = 0; i < sizeof PACED / sizeof *PACED; i++)
        for (unsigned k = 0; k < sizeof factors / sizeof *factors; k++) {
            stand_at(0.0, 0.0);
            body.grip = factors[k];
            act(PACED[i], 0);
            TEST_ASSERT_TRUE(motion_is_denied(&motion));
        }
}

static void test_wheels_that_are_a_little_off_are_not_denied(void)
{
    static const double factors[] = {0.6, 0.8, 1.0, 1.2};

    for (unsigned i = 0; i < sizeof PACED / sizeof *PACED; i++)
        for (unsigned k = 0; k < sizeof factors / sizeof *factors; k++) {
            stand_at(0.0, 0.0);
            body.grip = factors[k];
            act(PACED[i], 0);
            TEST_ASSERT_FALSE(motion_is_denied(&motion));
        }
}

/* At full speed each wheel makes 251 mm/s in a turn, 50 counts a tick. */
static void test_odometers_that_count_twice_the_way_are_not_credible(void)
{
    struct senses senses = sensed();

    senses.odometer_left = (uint16_t)(senses.odometer_left + 60);
    TEST_ASSERT_TRUE(motion_is_credible(&motion, &config, &senses, 1));
    senses.odometer_left = (uint16_t)(senses.odometer_left + 40);
    TEST_ASSERT_FALSE(motion_is_credible(&motion, &config, &senses, 1));
    TEST_ASSERT_TRUE(motion_is_credible(&motion, &config, &senses, 2));
}

static void test_ticks_that_were_never_sensed_count_for_the_pace(void)
{
    begin(150, 0);
    for (unsigned senses = 0; !tick(); senses++) {
        body.tick += 2;   /* of three ticks, the senses of one come */
        TEST_ASSERT_LESS_THAN_UINT(100, senses);
    }
    TEST_ASSERT_TRUE(motion_is_denied(&motion));
}

static void test_an_outage_counts_as_long_as_wheels_are_held(void)
{
    begin(45, 0);
    (void)tick();
    body.tick += 100;
    while (!tick())
        continue;
    TEST_ASSERT_FALSE(motion_is_denied(&motion));
}

static void test_what_happens_while_lifted_is_not_the_robots_way(void)
{
    struct senses senses;

    begin(90, 0);
    (void)tick();
    motion_lift(&motion);
    body.left_mm += 123.0;
    senses = sensed();
    motion_track(&motion, &senses);
    while (!tick())
        ;
    TEST_ASSERT_INT_WITHIN(HALF, lround(1000.0 * (90.0 + 123.0 / 160.0 * 180.0 / PI)), heading_mdeg());
}

/* The four parameters that a motion depends on, each at an end of its range: 16 corners. */
static void set_corner(unsigned corner)
{
    config.value[SPEED_MM_S] = corner & 1u ? 250 : 20;
    config.value[TURN_SPEED_DEG_S] = corner & 2u ? 250 : 30;
    config.value[WHEEL_TRACK_MM] = corner & 4u ? 250 : 80;
    config.value[TICK_MS] = corner & 8u ? 100 : 10;
}

static void test_turns_are_exact_at_both_ends_of_every_range(void)
{
    static const int turns_deg[] = {1, 90, 180, 359};   /* 359: boredom at its greatest */

    for (unsigned corner = 0; corner < 16; corner++)
        for (unsigned i = 0; i < 4; i++) {
            set_corner(corner);
            stand_at(0.0, 0.0);
            act(turns_deg[i], 0);
            TEST_ASSERT_INT_WITHIN(HALF, 1000 * turns_deg[i], heading_mdeg());
        }
}

static void test_steps_are_exact_at_both_ends_of_every_range(void)
{
    static const unsigned steps_mm[] = {1, 250};

    for (unsigned corner = 0; corner < 16; corner++)
        for (unsigned i = 0; i < 2; i++) {
            set_corner(corner);
            stand_at(0.0, 0.0);
            act(0, steps_mm[i]);
            TEST_ASSERT_INT_WITHIN(HALF, 1000 * (long)steps_mm[i], way_um());
        }
}

static void test_stuck_wheels_are_given_up_at_both_ends_of_every_range(void)
{
    for (unsigned corner = 0; corner < 16; corner++) {
        set_corner(corner);
        stand_at(0.0, 0.0);
        body.grip = 0.0;
        TEST_ASSERT_GREATER_THAN_UINT(25, act(359, 0));
        TEST_ASSERT_GREATER_THAN_UINT(25, act(0, 500));
    }
}

static uint16_t random_odometer(void)
{
    return (uint16_t)(random_next(&dice) & (ODOMETER_SPAN - 1));
}

/* Odometers gone mad: the sanitizers watch for overflow, this test for speeds that do not fit the wire. */
static void test_wild_odometers_make_no_wild_speeds(void)
{
    for (unsigned i = 0; i < 200000; i++) {
        const struct senses senses = {.odometer_left = random_odometer(), .odometer_right = random_odometer()};

        if (i % 1000 == 0)
            set_corner(i / 1000 % 16);
        motion_track(&motion, &senses);
        if (motion_ended(&motion, &config, &senses) || random_below(&dice, 50) == 0)
            begin(random_below(&dice, 2) ? 359 : -359, random_below(&dice, 2) * 500u);
        TEST_ASSERT_INT16_WITHIN(1257, 0, driven().left_mm_s);
        TEST_ASSERT_INT16_WITHIN(1257, 0, driven().right_mm_s);
    }
}

static void test_either_wheel_that_jumps_is_not_credible(void)
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
static void test_a_body_that_spins_by_itself_overflows_nothing(void)
{
    uint16_t odometer = 0;

    for (unsigned i = 0; i < 10000; i++) {
        const struct senses senses = {.odometer_left = odometer, .odometer_right = (uint16_t)(4095 - odometer)};

        motion_track(&motion, &senses);
        begin(i < 5000 ? -359 : 359, 0);
        odometer = (uint16_t)((odometer + 2000) % ODOMETER_SPAN);
        TEST_ASSERT_INT16_WITHIN(2047, 0, driven().left_mm_s);
    }
}

static bool tick_seeing_food(bool look)
{
    struct senses senses = sensed();

    senses.look = look;
    return motion_ended(&motion, &config, &senses);
}

static void test_a_turn_for_food_ends_when_food_is_seen(void)
{
    const struct action around = {.turn_deg = 360, .until_food = true};

    motion_begin(&motion, &config, &around);
    for (unsigned i = 0; i < 10; i++)
        TEST_ASSERT_FALSE(tick());
    TEST_ASSERT_FALSE(tick_seeing_food(false));
    TEST_ASSERT_TRUE(tick_seeing_food(true));
}

static void test_any_other_turn_does_not(void)
{
    begin(180, 0);
    tick();
    TEST_ASSERT_FALSE(tick_seeing_food(true));
}

static void test_what_was_left_of_a_turn_for_food_is_forgotten(void)
{
    const struct action around = {.turn_deg = 360, .until_food = true};
    long before;

    motion_begin(&motion, &config, &around);
    for (unsigned i = 0; i < 10; i++)
        tick();
    TEST_ASSERT_TRUE(tick_seeing_food(true));
    before = heading_mdeg();
    act(-90, 0);
    TEST_ASSERT_INT_WITHIN(HALF, before - 90000, heading_mdeg());
}

static void test_the_rest_after_an_action_is_part_of_it(void)
{
    const struct action trial = {.turn_deg = 45, .rest_ticks = 2};

    motion_begin(&motion, &config, &trial);
    while (!tick())
        ;
    TEST_ASSERT_TRUE(motion_rest(&motion, &config));
    TEST_ASSERT_EQUAL(0, driven().left_mm_s);
    TEST_ASSERT_FALSE(tick());
    TEST_ASSERT_EQUAL(0, driven().left_mm_s);
    TEST_ASSERT_TRUE(tick());
    TEST_ASSERT_FALSE(motion_rest(&motion, &config));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_positive_turn_is_to_the_right);
    RUN_TEST(test_each_turn_ends_within_half_a_degree);
    RUN_TEST(test_errors_of_a_thousand_turns_do_not_add_up);
    RUN_TEST(test_errors_of_equal_turns_do_not_add_up);
    RUN_TEST(test_steps_between_turns_do_not_spoil_the_heading);
    RUN_TEST(test_a_turn_moves_nowhere);
    RUN_TEST(test_what_one_turn_misses_is_made_up_for_in_the_next);
    RUN_TEST(test_each_step_ends_within_half_a_millimetre);
    RUN_TEST(test_a_step_goes_straight);
    RUN_TEST(test_a_step_ends_in_the_tick_that_brings_an_obstacle);
    RUN_TEST(test_an_obstacle_beside_the_body_does_not_end_a_step);
    RUN_TEST(test_an_obstacle_does_not_end_a_turn);
    RUN_TEST(test_what_a_stopped_step_left_is_not_driven_later);
    RUN_TEST(test_the_odometers_may_wrap_forward);
    RUN_TEST(test_the_odometers_may_wrap_backward);
    RUN_TEST(test_rest_lasts_one_tick);
    RUN_TEST(test_wheels_rest_between_actions);
    RUN_TEST(test_nothing_is_under_way_before_the_first_action);
    RUN_TEST(test_a_step_keeps_to_its_speed);
    RUN_TEST(test_a_turn_keeps_to_its_speed);
    RUN_TEST(test_a_turn_against_stuck_wheels_is_given_up);
    RUN_TEST(test_a_step_against_stuck_wheels_is_given_up);
    RUN_TEST(test_a_turn_that_was_given_up_is_not_made_up_for);
    RUN_TEST(test_slow_wheels_are_not_given_up);
    RUN_TEST(test_wheels_that_turn_at_half_the_speed_are_denied);
    RUN_TEST(test_wheels_that_are_a_little_off_are_not_denied);
    RUN_TEST(test_odometers_that_count_twice_the_way_are_not_credible);
    RUN_TEST(test_ticks_that_were_never_sensed_count_for_the_pace);
    RUN_TEST(test_an_outage_counts_as_long_as_wheels_are_held);
    RUN_TEST(test_what_happens_while_lifted_is_not_the_robots_way);
    RUN_TEST(test_turns_are_exact_at_both_ends_of_every_range);
    RUN_TEST(test_steps_are_exact_at_both_ends_of_every_range);
    RUN_TEST(test_stuck_wheels_are_given_up_at_both_ends_of_every_range);
    RUN_TEST(test_wild_odometers_make_no_wild_speeds);
    RUN_TEST(test_either_wheel_that_jumps_is_not_credible);
    RUN_TEST(test_a_body_that_spins_by_itself_overflows_nothing);
    RUN_TEST(test_a_turn_for_food_ends_when_food_is_seen);
    RUN_TEST(test_any_other_turn_does_not);
    RUN_TEST(test_what_was_left_of_a_turn_for_food_is_forgotten);
    RUN_TEST(test_the_rest_after_an_action_is_part_of_it);
    return UNITY_END();
}
