#include "firmware/motion/speed_control.h"
#include "robot_words.h"
#include "tests/test.h"

#include <math.h>

enum { PERIODS = 400, SETTLED = 100, PARTS = 50 };

/* A motor, and its response to a step from rest to a speed. */
struct motor {
    double volts, strength, dead, lag_s, ripple_v;
};

struct response {
    double overshoot, rise_ms, lag_mm, deviation_mm_s;
    int32_t duty;
};

static const struct motor NOMINAL = {.volts = 7.2, .strength = 1, .dead = 0.08, .lag_s = 0.06};

static double steady_mm_s(const struct motor *motor, double volts, int32_t duty)
{
    double push = fabs(duty / 65536.0) * volts / 7.2;

    return push < motor->dead ? 0 : copysign((push - motor->dead) * 674 * motor->strength, duty);
}

static struct response step_to(int16_t commanded_mm_s, const struct motor *motor)
{
    struct wheel wheel = {.known = false};
    struct response response = {.rise_ms = -1};
    double v = 0, x = 0;

    for (int k = 0; k < PERIODS; k++) {
        double volts = motor->volts + motor->ripple_v * (k % 2 ? 1 : -1);

        response.duty = wheel_run(&wheel, (uint16_t)(int32_t)floor(x * 256000 / WHEEL_COUNT_256),
            commanded_mm_s, (uint32_t)(motor->volts * 1000));
        for (int i = 0; i < PARTS; i++) {
            v += (steady_mm_s(motor, volts, response.duty) - v) * 1e-4 / motor->lag_s;
            x += v * 1e-4;
        }
        response.overshoot = fmax(response.overshoot, v / commanded_mm_s - 1);
        if (response.rise_ms < 0 && v / commanded_mm_s > 0.63)
            response.rise_ms = (k + 1) * WHEEL_PERIOD_MS;
        if (k > SETTLED)
            response.deviation_mm_s = fmax(response.deviation_mm_s, fabs(v - commanded_mm_s));
    }
    response.lag_mm = fabs((double)commanded_mm_s) * PERIODS * WHEEL_PERIOD_MS / 1000.0 - fabs(x);
    return response;
}

static void assert_controlled(const struct motor *motor)
{
    static const int16_t speeds_mm_s[] = {200, -200, 251, 120};

    for (unsigned i = 0; i < sizeof speeds_mm_s / sizeof *speeds_mm_s; i++) {
        struct response response = step_to(speeds_mm_s[i], motor);

        TEST_ASSERT_LESS_THAN_DOUBLE(0.10, response.overshoot);
        TEST_ASSERT_LESS_THAN_DOUBLE(80, response.rise_ms);
        TEST_ASSERT_GREATER_THAN_DOUBLE(0, response.rise_ms);
        TEST_ASSERT_LESS_THAN_DOUBLE(30, response.deviation_mm_s);
    }
}

TEST(wheel_reaches_its_speed_with_the_lag_of_the_model)
{
    struct response response = step_to(200, &NOMINAL);

    TEST_ASSERT_DOUBLE_WITHIN(15, 37, response.rise_ms);
    TEST_ASSERT_DOUBLE_WITHIN(1.0, 200 * 0.037, response.lag_mm);
}

TEST(speed_control_overshoots_under_10_percent_at_any_voltage)
{
    struct motor motor = NOMINAL;

    for (motor.volts = 6.0; motor.volts < 8.45; motor.volts += 0.2)
        assert_controlled(&motor);
}

TEST(speed_control_tolerates_motor_variation)
{
    struct motor motor = NOMINAL;

    motor.strength = 0.7;
    assert_controlled(&motor);
    motor.strength = 1.2;
    assert_controlled(&motor);
    motor = NOMINAL;
    motor.dead = 0.14;
    assert_controlled(&motor);
    motor = NOMINAL;
    motor.lag_s = 0.045;
    assert_controlled(&motor);
    motor.lag_s = 0.075;
    assert_controlled(&motor);
}

TEST(speed_control_tolerates_supply_ripple)
{
    struct motor motor = NOMINAL;

    motor.ripple_v = 0.5;
    assert_controlled(&motor);
}

TEST(speed_control_limits_its_integral_against_a_stuck_wheel)
{
    struct motor motor = NOMINAL;
    struct response response;

    motor.strength = 0;
    response = step_to(500, &motor);
    TEST_ASSERT_EQUAL_INT32(WHEEL_DUTY_MAX, response.duty);
    response = step_to(-500, &motor);
    TEST_ASSERT_EQUAL_INT32(-WHEEL_DUTY_MAX, response.duty);
}

TEST(duty_is_zero_at_rest)
{
    struct wheel wheel = {.known = false};

    TEST_ASSERT_EQUAL_INT32(0, wheel_run(&wheel, 7, 0, WHEEL_NOMINAL_MV));
    TEST_ASSERT_EQUAL_INT32(0, wheel_run(&wheel, 7, 0, 0));
    wheel = (struct wheel){.known = false};
    TEST_ASSERT_EQUAL_INT32(0, wheel_run(&wheel, 7, 0, 0));
}

/* The wheel's duty in the next period on a nominal battery, after so many counts. */
static int32_t duty_after(struct wheel *wheel, int counts, int16_t commanded_mm_s)
{
    wheel->known = true;
    return wheel_run(wheel, (uint16_t)(wheel->count + counts), commanded_mm_s, WHEEL_NOMINAL_MV);
}

TEST(feed_forward_leads_the_model_by_the_lag)
{
    struct wheel wheel = {.known = false};

    /* Of 1000 um in a period, a lag of 60 ms and a model of 40 make 1500. */
    TEST_ASSERT_EQUAL_INT32(1500 * 97 / 5 + 5243, duty_after(&wheel, 0, 200));
    TEST_ASSERT_EQUAL_INT32(1000 * 256 / 8, wheel.model_256);
}

TEST(calibration_offsets_are_added_to_the_duty)
{
    struct wheel wheel = {.forward_more = 10, .dead_more = 100, .lag_more_ms = 4};

    TEST_ASSERT_EQUAL_INT32(1600 * 107 / 5 + 5343, duty_after(&wheel, 0, 200));
}

TEST(duty_has_proportional_and_integral_terms)
{
    struct wheel wheel = {.known = false};

    /* 10 counts of 91.6 um: 916, and 4/256. */
    TEST_ASSERT_EQUAL_INT32(916 * 23 + 916 * 31 / 16 + 5243, duty_after(&wheel, -10, 0));
    TEST_ASSERT_EQUAL_INT32(916, wheel.behind_um);
    TEST_ASSERT_EQUAL_INT32(-4, wheel.rest_256);
    TEST_ASSERT_EQUAL_INT32(-10 * WHEEL_COUNT_256, wheel.way_256);
    (void)duty_after(&wheel, -1, 0);
    TEST_ASSERT_EQUAL_INT32(-4 - WHEEL_COUNT_256 + 91 * 256, wheel.rest_256);
}

TEST(integral_is_limited_to_four_millimetres)
{
    struct wheel wheel = {.behind_um = 3990};

    TEST_ASSERT_EQUAL_INT32(916 * 23 + 4000 * 31 / 16 + 5243, duty_after(&wheel, -10, 0));
    TEST_ASSERT_EQUAL_INT32(4000, wheel.behind_um);
}

TEST(duty_above_1000_jumps_over_the_dead_band)
{
    static const struct { int counts, behind_um, duty; } CASES[] = {
        {2, 2872, 0}, {0, 517, 1001 + 5243},   /* of 1000 and 1001, */
        {-2, -2872, 0}, {0, -517, -1001 - 5243},   /* and as much backward */
    };

    for (unsigned i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        struct wheel wheel = {.behind_um = CASES[i].behind_um};

        TEST_ASSERT_EQUAL_INT32(CASES[i].duty, duty_after(&wheel, CASES[i].counts, 0));
    }
}

TEST(duty_scales_with_the_battery_voltage_if_plausible)
{
    static const struct { uint32_t battery_mv; int16_t commanded_mm_s; int32_t duty; } CASES[] = {
        {7200, 200, 34343}, {7201, 200, 34343 * 4095 / 4096}, {8400, 450, 70718 * 3510 / 4096},
        {2999, 200, 34343}, {3000, 200, WHEEL_DUTY_MAX}, {16000, 2000, 2 * WHEEL_DUTY_MAX * 1843 / 4096},
    };

    for (unsigned i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        struct wheel wheel = {.known = false};

        TEST_ASSERT_EQUAL_INT32(CASES[i].duty, wheel_run(&wheel, 0, CASES[i].commanded_mm_s, CASES[i].battery_mv));
    }
}

TEST(integral_stays_unchanged_at_full_duty)
{
    struct wheel wheel = {.known = false};

    TEST_ASSERT_EQUAL_INT32(WHEEL_DUTY_MAX, duty_after(&wheel, -1, 500));
    TEST_ASSERT_EQUAL_INT32(0, wheel.behind_um);
    wheel = (struct wheel){.known = false};
    TEST_ASSERT_EQUAL_INT32(-WHEEL_DUTY_MAX, duty_after(&wheel, 1, -500));
    TEST_ASSERT_EQUAL_INT32(0, wheel.behind_um);
}

TEST(wheel_distance_wraps_with_the_odometer_and_keeps_fractions)
{
    const int32_t unit_256 = 25600, last_256 = ODOMETER_SPAN * unit_256 - 1;
    struct wheel wheel = {.way_256 = unit_256 - 1};

    TEST_ASSERT_EQUAL_UINT16(0, wheel_odometer(&wheel));
    wheel.way_256 = last_256;
    (void)duty_after(&wheel, 1, 0);
    TEST_ASSERT_EQUAL_INT32(WHEEL_COUNT_256 - 1, wheel.way_256);
    wheel.way_256 = -last_256;
    (void)duty_after(&wheel, -1, 0);
    TEST_ASSERT_EQUAL_INT32(1 - WHEEL_COUNT_256, wheel.way_256);
}

TEST(odometer_counts_tenths_of_a_millimetre_and_wraps)
{
    struct wheel wheel = {.known = false};

    (void)wheel_run(&wheel, 65000, 0, 7200);
    TEST_ASSERT_EQUAL_UINT16(0, wheel_odometer(&wheel));
    (void)wheel_run(&wheel, (uint16_t)(65000 + 1000), 0, 7200);   /* 91.6 mm */
    TEST_ASSERT_EQUAL_UINT16(916, wheel_odometer(&wheel));
    (void)wheel_run(&wheel, 65000 - 1000, 0, 7200);
    TEST_ASSERT_EQUAL_UINT16(4096 - 916 - 1, wheel_odometer(&wheel));   /* rounded down */
    for (unsigned i = 1; i <= 10; i++)
        (void)wheel_run(&wheel, (uint16_t)(64000 + 1000 * i), 0, 7200);
    TEST_ASSERT_EQUAL_UINT16((9160 - 916) % 4096, wheel_odometer(&wheel));
    for (int32_t count = 74000; count >= 45000; count -= 1000)   /* beyond a span, and back to where it began */
        (void)wheel_run(&wheel, (uint16_t)count, 0, 7200);
    for (int32_t count = 45000; count <= 65000; count += 1000)
        (void)wheel_run(&wheel, (uint16_t)count, 0, 7200);
    TEST_ASSERT_EQUAL_UINT16(0, wheel_odometer(&wheel));
}
