#include "hal/can_body/port.h"
#include "hal/pins_body/calibrate.h"
#include "tests/test.h"

int port_load_more(unsigned which, uint8_t bytes[CELL_COUNT]) { (void)which; (void)bytes; return 0; }
int port_store_more(unsigned which, const uint8_t bytes[CELL_COUNT]) { (void)which; (void)bytes; return 0; }

enum { STAIR = 100, STAIRS = 5, TICK = 4, NOMINAL_MV = 7200, MOST_MV = 9897, KEPT = 77 };

static struct calibration calibration;
static struct calibrate_look look;
static struct calibration_values values;
static uint16_t back[FEEL_COUNT];

void setUp(void)
{
    look = (struct calibrate_look){.battery_mv = NOMINAL_MV, .back = back, .has = 31};
    for (unsigned i = 0; i < CALIBRATION_VALUES; i++)
        values.value[i] = KEPT;
}

static uint8_t value(unsigned number)
{
    return values.value[number - CALIBRATION_FIRST];
}

static void assert_refused(unsigned number, int32_t found)
{
    TEST_ASSERT_EQUAL_UINT8(number, calibration.refused);
    TEST_ASSERT_EQUAL_INT32(found, calibration.found);
    for (unsigned i = 0; i < CALIBRATION_VALUES; i++)
        TEST_ASSERT_EQUAL_UINT8(KEPT, values.value[i]);
}

/* Returns the number of ticks. */
static unsigned measure_light(void)
{
    unsigned beats = 1;

    calibrate_begin(&calibration, MEASURE_LIGHT);
    for (; look.senses = beats % TICK == 0, !calibrate_beat(&calibration, &look, &values); beats++)
        TEST_ASSERT_TRUE(beats < 1000);
    TEST_ASSERT_EQUAL_UINT8(MEASURE_NOTHING, calibration.measures);
    return beats / TICK;
}

TEST(light_is_the_mean_of_16_ticks_after_10)
{
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        back[i] = (uint16_t)(1000 + 24 * i);
    back[4] = 1048;
    TEST_ASSERT_EQUAL_UINT(26, measure_light());
    TEST_ASSERT_EQUAL_UINT8(63, value(BODY_NEAR_RIGHT));          /* 62.5 */
    TEST_ASSERT_EQUAL_UINT8(64, value(BODY_NEAR_FRONT_RIGHT));    /* 64 */
    TEST_ASSERT_EQUAL_UINT8(66, value(BODY_NEAR_FRONT));          /* 65.5 */
    TEST_ASSERT_EQUAL_UINT8(66, value(BODY_NEAR_LEFT));           /* 65.5 */
    TEST_ASSERT_EQUAL_UINT8(KEPT, value(BODY_TRACK_MM));
    TEST_ASSERT_EQUAL_UINT8(0, calibration.refused);
}

TEST(implausible_light_is_refused_and_keeps_all_values)
{
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        back[i] = 1200;
    back[3] = 0;
    (void)measure_light();
    assert_refused(BODY_NEAR_FRONT_LEFT, 0);
    back[3] = 1200;
    back[0] = 4080;
    (void)measure_light();
    assert_refused(BODY_NEAR_RIGHT, 255);
}

TEST(absent_sensor_is_not_measured)
{
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        back[i] = i == 0 || i == 4 ? 0 : 1200;
    look.has = 14;
    (void)measure_light();
    TEST_ASSERT_EQUAL_UINT8(0, calibration.refused);
    TEST_ASSERT_EQUAL_UINT8(KEPT, value(BODY_NEAR_RIGHT));
    TEST_ASSERT_EQUAL_UINT8(75, value(BODY_NEAR_FRONT));
    TEST_ASSERT_EQUAL_UINT8(KEPT, value(BODY_NEAR_LEFT));
}

TEST(single_dark_tick_lowers_the_mean_light)
{
    unsigned ticks = 0;

    for (unsigned i = 0; i < FEEL_COUNT; i++)
        back[i] = 1600;
    calibrate_begin(&calibration, MEASURE_LIGHT);
    look.senses = true;
    do
        back[2] = ++ticks == 11 ? 0 : 1600;
    while (!calibrate_beat(&calibration, &look, &values));
    TEST_ASSERT_EQUAL_UINT8(94, value(BODY_NEAR_FRONT));   /* 93.75 */
}

/* Two motors: counts per beat at low and at high duty, counts that lag after the step, and the percentage backward. */
struct motors {
    int low[PINS_SIDES], high[PINS_SIDES], lack[PINS_SIDES], back[PINS_SIDES];
    uint32_t low_mv, high_mv;
};

static void run_beat(const struct motors *motors, unsigned beat)
{
    static const int DUTIES[] = {0, 16384, 16384, 49152, 49152};
    unsigned stair = beat / STAIR % STAIRS;
    int32_t duty = DUTIES[stair] * (beat < STAIRS * STAIR ? 1 : -1);

    TEST_ASSERT_EQUAL_INT32(duty, calibrate_duty(&calibration));
    for (unsigned side = 0; side < PINS_SIDES && duty != 0; side++) {
        int counts = stair > 2 ? motors->high[side] : motors->low[side];

        counts -= beat % (STAIRS * STAIR) == 3 * STAIR + 5 ? motors->lack[side] : 0;
        look.counts[side] = (uint16_t)(look.counts[side] + (duty > 0 ? counts : -counts * motors->back[side] / 100));
    }
    look.battery_mv = stair > 2 ? motors->high_mv : motors->low_mv;
}

static bool measure(const struct motors *motors)
{
    unsigned beat = 0;

    look.counts[0] = 65500;
    look.counts[1] = 30;
    calibrate_begin(&calibration, MEASURE_MOTORS);
    for (; !calibrate_beat(&calibration, &look, &values); beat++) {
        run_beat(motors, beat);
        TEST_ASSERT_EQUAL_INT16(0, calibrate_mm_s(&calibration));
    }
    TEST_ASSERT_EQUAL_INT32(0, calibrate_duty(&calibration));
    TEST_ASSERT_EQUAL_UINT(2 * STAIRS * STAIR, beat);
    return calibration.refused == 0;
}

static bool measure_motors(const int low[PINS_SIDES], const int high[PINS_SIDES], const int lack[PINS_SIDES], uint32_t sagged_mv)
{
    return measure(&(struct motors){
        {low[0], low[1]}, {high[0], high[1]}, {lack[0], lack[1]}, {100, 100}, NOMINAL_MV, sagged_mv,
    });
}

TEST(motor_values_follow_from_two_duty_steps)
{
    TEST_ASSERT_TRUE(measure_motors((int[]){6, 7}, (int[]){24, 28}, (int[]){200, 280}, NOMINAL_MV));
    TEST_ASSERT_EQUAL_UINT8(99, value(BODY_FORWARD_LEFT));     /* 65536 / 7.2 V x 5 ms / 91.6 um .. = 99.4 */
    TEST_ASSERT_EQUAL_UINT8(85, value(BODY_FORWARD_RIGHT));    /* 85.2 */
    TEST_ASSERT_EQUAL_UINT8(83, value(BODY_DEAD_LEFT));        /* 0.25 - 0.5 x 6 / 18, in 0.1 %: 83.3 */
    TEST_ASSERT_EQUAL_UINT8(83, value(BODY_DEAD_RIGHT));
    TEST_ASSERT_EQUAL_UINT8(62, value(BODY_LAG_MS));           /* 200 / 18 and 280 / 21 periods: 56 and 67 ms */
    TEST_ASSERT_EQUAL_UINT8(KEPT, value(BODY_TRACK_MM));
}

TEST(motor_values_are_the_mean_of_both_directions)
{
    const struct motors motors = {{10, 10}, {40, 40}, {400, 400}, {60, 60}, NOMINAL_MV, NOMINAL_MV};

    TEST_ASSERT_TRUE(measure(&motors));
    TEST_ASSERT_EQUAL_UINT8(75, value(BODY_FORWARD_LEFT));     /* 99.4 x 18 / 24 */
    TEST_ASSERT_EQUAL_UINT8(83, value(BODY_DEAD_LEFT));
    TEST_ASSERT_EQUAL_UINT8(67, value(BODY_LAG_MS));           /* 320 / 24 periods */
}

TEST(motor_with_unequal_directions_is_refused)
{
    TEST_ASSERT_FALSE(measure(&(struct motors){{6, 6}, {24, 24}, {200, 200}, {100, 0}, NOMINAL_MV, NOMINAL_MV}));
    assert_refused(BODY_FORWARD_RIGHT, 0);
    TEST_ASSERT_FALSE(measure(&(struct motors){{2, 6}, {8, 24}, {70, 200}, {400, 100}, NOMINAL_MV, NOMINAL_MV}));
    assert_refused(BODY_FORWARD_LEFT, 0);
}

TEST(sagging_battery_is_compensated)
{
    TEST_ASSERT_TRUE(measure_motors((int[]){6, 6}, (int[]){24, 24}, (int[]){200, 200}, NOMINAL_MV * 15 / 16));
    TEST_ASSERT_EQUAL_UINT8(90, value(BODY_FORWARD_LEFT));     /* (0.75 x 15 / 16 - 0.25) / 0.5 of 99.4: 90.05 */
    TEST_ASSERT_EQUAL_UINT8(99, value(BODY_DEAD_LEFT));        /* 250 - 453.1 x 6 / 18 = 98.96 */
}

TEST(motor_values_are_rounded_to_nearest)
{
    TEST_ASSERT_TRUE(measure_motors((int[]){8, 8}, (int[]){24, 24}, (int[]){480, 480}, 7056));
    TEST_ASSERT_EQUAL_UINT8(108, value(BODY_FORWARD_LEFT));    /* 108.44 */
    TEST_ASSERT_EQUAL_UINT8(8, value(BODY_DEAD_LEFT));         /* 7.50 */
    TEST_ASSERT_EQUAL_UINT8(150, value(BODY_LAG_MS));          /* 480 / 16 periods */
    TEST_ASSERT_TRUE(measure_motors((int[]){2, 2}, (int[]){12, 12}, (int[]){200, 200}, 5929));
    TEST_ASSERT_EQUAL_UINT8(132, value(BODY_FORWARD_LEFT));    /* 131.50 */
}

/* An encoder with loose wires counts anything. */
TEST(implausible_encoder_counts_are_refused)
{
    static const int wild[][2] = {{40, 41}, {300, 327}, {-300, 300}, {60, 80}, {-300, -280}};

    for (unsigned i = 0; i < sizeof wild / sizeof *wild; i++)
        TEST_ASSERT_FALSE(measure_motors((int[]){6, wild[i][0]}, (int[]){24, wild[i][1]}, (int[]){200, 200},
                                         NOMINAL_MV));
    /* Backward on each stair, but for a jump between them. */
    TEST_ASSERT_FALSE(measure_motors((int[]){6, -24}, (int[]){24, -6}, (int[]){200, -60 * STAIR - 500}, NOMINAL_MV));
}

TEST(still_constant_or_backward_motors_are_refused)
{
    TEST_ASSERT_FALSE(measure_motors((int[]){0, 0}, (int[]){0, 0}, (int[]){0, 0}, NOMINAL_MV));
    assert_refused(BODY_FORWARD_LEFT, 0);
    TEST_ASSERT_FALSE(measure_motors((int[]){6, 6}, (int[]){24, 6}, (int[]){200, 0}, NOMINAL_MV));
    assert_refused(BODY_FORWARD_RIGHT, 0);
    TEST_ASSERT_FALSE(measure_motors((int[]){6, -6}, (int[]){24, -24}, (int[]){200, 0}, NOMINAL_MV));
    assert_refused(BODY_FORWARD_RIGHT, 0);
}

TEST(impossible_dead_band_or_lag_is_refused_by_name)
{
    TEST_ASSERT_FALSE(measure_motors((int[]){9, 9}, (int[]){27, 27}, (int[]){200, 200}, NOMINAL_MV));
    assert_refused(BODY_DEAD_LEFT, 0);
    TEST_ASSERT_FALSE(measure_motors((int[]){6, 6}, (int[]){24, 24}, (int[]){0, 0}, NOMINAL_MV));
    assert_refused(BODY_LAG_MS, 0);
}

enum { TURN_COUNTS = 11000 };   /* of both wheels together, by turn: 160.4 mm */

/* Turns on the spot; the wall is seen through a tenth of the turn. Returns after how many beats it has ended. */
static unsigned measure_track(unsigned counts_each, unsigned begins_at)
{
    unsigned turned = begins_at, beat = 0;
    bool ended = false;

    look.counts[0] = 65000;
    look.counts[1] = 200;
    calibrate_begin(&calibration, MEASURE_TRACK);
    for (; !ended; beat++) {
        look.senses = beat % TICK == 0;
        look.wall = turned % TURN_COUNTS < TURN_COUNTS / 10;
        ended = calibrate_beat(&calibration, &look, &values);
        TEST_ASSERT_EQUAL_INT16(ended ? 0 : 150, calibrate_mm_s(&calibration));
        TEST_ASSERT_EQUAL_INT32(0, calibrate_duty(&calibration));
        look.counts[0] = (uint16_t)(look.counts[0] + counts_each);
        look.counts[1] = (uint16_t)(look.counts[1] - counts_each);
        turned += 2 * counts_each;
        TEST_ASSERT_TRUE(beat < 10000);
    }
    return beat;
}

TEST(track_is_measured_over_four_turns)
{
    (void)measure_track(5, TURN_COUNTS / 2);
    TEST_ASSERT_EQUAL_UINT8(160, value(BODY_TRACK_MM));
    TEST_ASSERT_EQUAL_UINT8(KEPT, value(BODY_NEAR_LEFT));
    TEST_ASSERT_EQUAL_UINT8(0, calibration.refused);
}

TEST(wall_seen_at_the_start_is_not_counted)
{
    unsigned beats = measure_track(5, 0);

    TEST_ASSERT_EQUAL_UINT8(160, value(BODY_TRACK_MM));
    TEST_ASSERT_EQUAL_UINT(5 * TURN_COUNTS / 10, beats / 10 * 10);
}

TEST(two_walls_per_turn_are_refused)
{
    bool ended = false;

    calibrate_begin(&calibration, MEASURE_TRACK);
    look.senses = true;
    for (unsigned turned = TURN_COUNTS / 4; !ended; turned += 10) {
        look.wall = turned % (TURN_COUNTS / 2) < TURN_COUNTS / 10;
        ended = calibrate_beat(&calibration, &look, &values);
        look.counts[0] = (uint16_t)(look.counts[0] + 10);
    }
    assert_refused(BODY_TRACK_MM, 80);
}

TEST(track_is_rounded_to_nearest)
{
    calibrate_begin(&calibration, MEASURE_TRACK);
    look.senses = true;
    for (unsigned beat = 0; beat < 10; beat++) {
        look.wall = beat % 2 != 0;
        TEST_ASSERT_EQUAL(beat == 9, calibrate_beat(&calibration, &look, &values));
        look.counts[0] = (uint16_t)(look.counts[0] + 3515 + (beat == 1 ? 3 : 0));
    }
    TEST_ASSERT_EQUAL_UINT8(103, value(BODY_TRACK_MM));   /* 28,123 counts: 102.5002 */
}

TEST(track_measurement_without_a_wall_times_out)
{
    unsigned beats = 0;

    calibrate_begin(&calibration, MEASURE_TRACK);
    look.senses = true;
    while (!calibrate_beat(&calibration, &look, &values))
        beats++;
    TEST_ASSERT_EQUAL_UINT(8000, beats);
    assert_refused(BODY_TRACK_MM, 0);
}

TEST(interrupt_refuses_a_running_measurement_only)
{
    calibration = (struct calibration){.refused = BODY_LAG_MS};
    calibrate_interrupt(&calibration);
    TEST_ASSERT_EQUAL_UINT8(BODY_LAG_MS, calibration.refused);
    calibrate_begin(&calibration, MEASURE_TRACK);
    TEST_ASSERT_EQUAL_UINT8(0, calibration.refused);
    calibrate_interrupt(&calibration);
    TEST_ASSERT_EQUAL_UINT8(MEASURE_NOTHING, calibration.measures);
    TEST_ASSERT_EQUAL_UINT8(BODY_MEASURE, calibration.refused);
    TEST_ASSERT_EQUAL_INT16(0, calibrate_mm_s(&calibration));
}

/* A pseudo-random number. */
static uint32_t random_below(uint32_t range)
{
    static uint32_t state = 1;

    state = state * 1664525u + 1013904223u;
    return (state >> 8) % range;
}

/* For the sanitizer: no sum may overflow, whatever the converter reads and the encoders count. */
TEST(random_voltages_and_counts_are_measured_or_refused)
{
    for (unsigned run = 0; run < 2000; run++) {
        uint16_t speed[PINS_SIDES] = {(uint16_t)random_below(65536), (uint16_t)random_below(65536)};
        uint32_t slower = random_below(2) == 0 ? 1 : 1000;

        calibrate_begin(&calibration, (uint8_t)(run % 16 == 0 ? MEASURE_TRACK : MEASURE_MOTORS));
        look.senses = true;
        do {
            for (unsigned side = 0; side < PINS_SIDES; side++)
                look.counts[side] = (uint16_t)(look.counts[side] + speed[side] / slower + random_below(3));
            look.battery_mv = random_below(2) == 0 ? random_below(MOST_MV + 1) : random_below(2) * MOST_MV;
            look.wall = random_below(2000) == 0;
        } while (!calibrate_beat(&calibration, &look, &values));
        for (unsigned number = CALIBRATION_FIRST; number < BODY_PARAMETER_END; number++)
            TEST_ASSERT_TRUE(value(number) == KEPT || calibration_fit((uint8_t)number, value(number)));
    }
}

TEST(recovering_battery_causes_no_dead_band_overflow)
{
    TEST_ASSERT_FALSE(measure(&(struct motors){{40, 40}, {80, 80}, {0, 0}, {100, 100}, 0, MOST_MV}));
    assert_refused(BODY_DEAD_LEFT, -1030);
}

TEST(racing_wheels_cause_no_track_overflow)
{
    calibrate_begin(&calibration, MEASURE_TRACK);
    look.senses = true;
    for (unsigned beat = 0; !calibrate_beat(&calibration, &look, &values); beat++) {
        look.wall = beat % 1000 == 0;
        look.counts[0] = (uint16_t)(look.counts[0] + 30000);
        look.counts[1] = (uint16_t)(look.counts[1] - 30000);
    }
    TEST_ASSERT_EQUAL_UINT8(BODY_TRACK_MM, calibration.refused);
}
