#include "tests/test.h"
#include "firmware/io.h"
#include "host_sim/world/native/body_faults.h"
#include "host_sim/world/native/world.h"

static struct body_faults faults;

void setUp(void)
{
    faults = (struct body_faults){0};
}

static uint8_t felt(uint8_t feel, uint32_t tick)
{
    struct senses senses = {.feel = feel};

    body_faults_sense(&faults, tick, &senses);
    return senses.feel;
}

static void assert_driven(double left_mm_s, double right_mm_s, double left_told_mm_s, double right_told_mm_s)
{
    body_faults_drive(&faults, &left_told_mm_s, &right_told_mm_s);
    TEST_ASSERT_EQUAL_DOUBLE(left_mm_s, left_told_mm_s);
    TEST_ASSERT_EQUAL_DOUBLE(right_mm_s, right_told_mm_s);
}

TEST(body_without_faults_is_unchanged)
{
    TEST_ASSERT_EQUAL_UINT8(19, felt(19, 5));
    assert_driven(-2047.0, 0.5, -2047.0, 0.5);
}

TEST(mirrored_ring_swaps_left_and_right)
{
    faults.mirrored = true;
    TEST_ASSERT_EQUAL_UINT8(FEEL_LEFT | FEEL_FRONT_RIGHT, felt(FEEL_RIGHT | FEEL_FRONT_LEFT, 0));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt(FEEL_FRONT, 0));
}

TEST(stuck_sensors_are_always_on_or_off)
{
    faults.stuck_on = FEEL_FRONT;
    faults.stuck_off = FEEL_LEFT;
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, felt(FEEL_LEFT, 0));
}

TEST(swapped_motors_are_swapped_with_their_odometers)
{
    struct senses senses = {.odometer_left = 3, .odometer_right = 4095};

    faults.swapped = true;
    body_faults_sense(&faults, 0, &senses);
    TEST_ASSERT_EQUAL_UINT16(4095, senses.odometer_left);
    TEST_ASSERT_EQUAL_UINT16(3, senses.odometer_right);
    assert_driven(-150.0, 200.0, 200.0, -150.0);
}

TEST(weak_motor_speed_is_its_share_rounded_toward_0)
{
    faults.left_lost_percent = 40;
    faults.right_lost_percent = 100;
    assert_driven(-120.0, 0.0, -201.0, 200.0);
}

static void roll(struct body *body, int left_mm_s, int right_mm_s)
{
    struct world world = {.params = {.tick_s = 0.02, .max_wheel_speed_mm_s = 500.0}};

    body->lifted = true;
    body->faults = faults;
    world_move(&world, body, left_mm_s, right_mm_s);
}

TEST(sound_odometers_count_the_way)
{
    struct body body = {.left_mm = 1.0};

    roll(&body, 200, -100);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(-2.0, body.right_mm);
}

TEST(odometer_may_be_stuck_or_reversed)
{
    struct body body = {.left_mm = 1.1, .right_mm = 7.0};

    faults.left_miscounted_percent = -100;
    faults.right_miscounted_percent = -200;
    roll(&body, 200, 100);
    TEST_ASSERT_EQUAL_DOUBLE(1.1, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(5.0, body.right_mm);
}

TEST(swapped_odometers_count_each_others_wheels)
{
    struct body body = {.left_mm = 0.0};

    faults.odometers_swapped = true;
    faults.left_miscounted_percent = 50;
    roll(&body, 200, 100);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(4.0, body.right_mm);
}

TEST(odometers_count_what_weak_motors_turn)
{
    struct body body = {.left_mm = 0.0};

    faults.left_lost_percent = 50;
    roll(&body, 200, 100);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, body.left_mm);
    TEST_ASSERT_EQUAL_DOUBLE(2.0, body.right_mm);
}

TEST(false_beacon_shows_only_when_no_food_is_seen)
{
    struct senses none = {.look = false}, real = {.look = true, .beacon_mm = 700};

    faults.false_beacon_mm = 100;
    body_faults_sense(&faults, 0, &none);
    body_faults_sense(&faults, 0, &real);
    TEST_ASSERT_TRUE(none.look);
    TEST_ASSERT_EQUAL_UINT16(100, none.beacon_mm);
    TEST_ASSERT_EQUAL_UINT16(700, real.beacon_mm);
}

TEST(noise_matches_the_reference_numbers)
{
    static const uint8_t expected[] = {3, 18, 19, 22, 16, 16};

    faults.noise = 300;
    faults.noise_of = 1000;
    faults.noise_key = 7;
    for (uint32_t tick = 0; tick < sizeof expected; tick++)
        TEST_ASSERT_EQUAL_UINT8(expected[tick], felt(0, tick));
}

TEST(mirrored_ring_reverses_ranges)
{
    uint8_t range_mm[FEEL_COUNT] = {10, 20, 30, 40, RANGE_NONE};
    const uint8_t expected[FEEL_COUNT] = {RANGE_NONE, 40, 30, 20, 10};

    faults.mirrored = true;
    body_faults_measure(&faults, range_mm);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, range_mm, FEEL_COUNT);
}

TEST(stuck_sensor_measures_0_or_no_range)
{
    uint8_t range_mm[FEEL_COUNT] = {10, 20, RANGE_NONE, 40, 50};
    const uint8_t expected[FEEL_COUNT] = {RANGE_NONE, 20, 0, 40, 50};

    faults.stuck_on = FEEL_FRONT;
    faults.stuck_off = FEEL_RIGHT;
    body_faults_measure(&faults, range_mm);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, range_mm, FEEL_COUNT);
}

enum { SEED = 1, ROBOT = 0 };

static void add(const char *what)
{
    TEST_ASSERT_NULL_MESSAGE(body_faults_add(&faults, what, SEED, ROBOT), what);
}

static void assert_refused(const char *what, const char *why)
{
    TEST_ASSERT_EQUAL_STRING_MESSAGE(why, body_faults_add(&faults, what, SEED, ROBOT), what);
}

TEST(swap_or_mirror_twice_has_no_effect)
{
    add("mirror");
    add("swap-motors");
    add("swap-odometers");
    TEST_ASSERT_TRUE(faults.mirrored && faults.swapped && faults.odometers_swapped);
    add("swap-odometers");
    add("swap-motors");
    add("mirror");
    TEST_ASSERT_FALSE(faults.mirrored || faults.swapped || faults.odometers_swapped);
}

TEST(sensors_can_be_stuck_separately)
{
    add("stuck-on:right");
    add("stuck-on:front-left");
    add("stuck-off:left");
    TEST_ASSERT_EQUAL_UINT8(FEEL_RIGHT | FEEL_FRONT_LEFT, faults.stuck_on);
    TEST_ASSERT_EQUAL_UINT8(FEEL_LEFT, faults.stuck_off);
}

TEST(last_stuck_fault_of_a_sensor_applies)
{
    add("stuck-on:front");
    add("stuck-off:front");
    TEST_ASSERT_EQUAL_UINT8(0, faults.stuck_on);
    add("stuck-on:front");
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, faults.stuck_on);
    TEST_ASSERT_EQUAL_UINT8(0, faults.stuck_off);
}

TEST(weak_motor_stores_the_lost_percentage)
{
    add("weak-motor:left:60%");
    add("weak-motor:right:0%");
    TEST_ASSERT_EQUAL_UINT8(40, faults.left_lost_percent);
    TEST_ASSERT_EQUAL_UINT8(100, faults.right_lost_percent);
    add("weak-motor:left:100%");
    TEST_ASSERT_EQUAL_UINT8(0, faults.left_lost_percent);
}

TEST(odometer_fault_ranges_from_minus_999_to_999_percent)
{
    add("odometer:left:-999%");
    add("odometer:right:999%");
    TEST_ASSERT_EQUAL_INT16(-1099, faults.left_miscounted_percent);
    TEST_ASSERT_EQUAL_INT16(899, faults.right_miscounted_percent);
}

TEST(false_beacon_sets_its_distance)
{
    add("false-beacon:8191");
    TEST_ASSERT_EQUAL_UINT16(8191, faults.false_beacon_mm);
    add("false-beacon:0");
    TEST_ASSERT_EQUAL_UINT16(0, faults.false_beacon_mm);
}

TEST(lag_slack_slip_and_latency_are_read_with_their_units)
{
    add("lag:60ms");
    add("slack:3deg");
    add("slip:5%");
    add("latency:1");
    add("dark-wall");
    add("weak-battery");
    TEST_ASSERT_EQUAL_UINT16(60, faults.lag_ms);
    TEST_ASSERT_EQUAL_UINT8(3, faults.slack_deg);
    TEST_ASSERT_EQUAL_UINT8(5, faults.slip_percent);
    TEST_ASSERT_EQUAL_UINT8(1, faults.latency_ticks);
    TEST_ASSERT_TRUE(faults.dark_wall && faults.weak_battery);
}

TEST(noise_accepts_zero_and_all_ticks)
{
    add("noise:1000000/1000000");
    TEST_ASSERT_EQUAL_UINT32(1000000, faults.noise);
    TEST_ASSERT_EQUAL_UINT32(1000000, faults.noise_of);
    add("noise:0/5");
    TEST_ASSERT_EQUAL_UINT32(0, faults.noise);
}

static uint64_t key_of(uint32_t seed, uint32_t robot)
{
    setUp();
    TEST_ASSERT_NULL(body_faults_add(&faults, "noise:1/3", seed, robot));
    return faults.noise_key;
}

TEST(noise_key_differs_by_seed_and_robot)
{
    TEST_ASSERT_EQUAL_HEX64(0xE220A8397B1DCDAFu, key_of(0, 0));   /* SplitMix64's first number */
    TEST_ASSERT_EQUAL_HEX64(key_of(1, 0), key_of(0, 10000));
    TEST_ASSERT_NOT_EQUAL_HEX64(key_of(1, 0), key_of(2, 0));
    TEST_ASSERT_NOT_EQUAL_HEX64(key_of(1, 0), key_of(1, 1));
}

TEST(only_noise_sets_the_noise_key)
{
    add("noise:1/2");
    add("mirror");
    TEST_ASSERT_EQUAL_UINT32(1, faults.noise);
    TEST_ASSERT_NULL(body_faults_add(&faults, "mirror", SEED + 1, ROBOT));
    TEST_ASSERT_EQUAL_HEX64(body_faults_mix(10000u * SEED), faults.noise_key);
}

TEST(repair_clears_all_faults)
{
    static const struct body_faults nothing = {0};

    add("mirror");
    add("noise:1/2");
    add("stuck-on:front");
    add("weak-motor:left:5%");
    add("repair");
    TEST_ASSERT_EQUAL_MEMORY(&nothing, &faults, sizeof faults);
}

TEST(invalid_fault_is_refused_with_the_right_form)
{
    static const struct body_faults nothing = {0};
    static const char sensors[] = "write stuck-on:SENSOR, with SENSOR one of right, front-right, front, front-left, left";

    assert_refused("explode", "there is no such fault");
    assert_refused("mirro", "there is no such fault");
    assert_refused("", "there is no such fault");
    assert_refused("mirror:left", "write mirror");
    assert_refused("stuck-on", sensors);
    assert_refused("stuck-on:", sensors);
    assert_refused("stuck-on:nose", sensors);
    assert_refused("stuck-on:left:left", sensors);
    assert_refused("noise:5", "write noise:N/TICKS, such as noise:10/1000");
    assert_refused("noise:5/", "write noise:N/TICKS, such as noise:10/1000");
    assert_refused("noise:00000001/2", "write noise:N/TICKS, such as noise:10/1000");
    assert_refused("noise:11/10", "noise is in 0 to all of 1 to 1000000 ticks");
    assert_refused("noise:0/0", "noise is in 0 to all of 1 to 1000000 ticks");
    assert_refused("noise:-1/10", "noise is in 0 to all of 1 to 1000000 ticks");
    assert_refused("noise:1/1000001", "noise is in 0 to all of 1 to 1000000 ticks");
    assert_refused("weak-motor:left", "write weak-motor:left:60% or weak-motor:right:60%");
    assert_refused("weak-motor:both:6%", "write weak-motor:left:60% or weak-motor:right:60%");
    assert_refused("weak-motor:left:101%", "a motor has 0% to 100%");
    assert_refused("weak-motor:right:-1%", "a motor has 0% to 100%");
    assert_refused("odometer:left:-%", "write odometer:left:0% or odometer:right:-100%");
    assert_refused("odometer:left:1000%", "an odometer counts -999% to 999% of the way");
    assert_refused("odometer:left:-1000%", "an odometer counts -999% to 999% of the way");
    assert_refused("false-beacon:+1", "write false-beacon:MM, such as false-beacon:100");
    assert_refused("false-beacon:8192", "food is seen up to 8191 mm away");
    assert_refused("lag:60", "write lag:60ms");
    assert_refused("lag:60msx", "write lag:60ms");
    assert_refused("lag:1001ms", "wheels lag by 0 to 1000 ms");
    assert_refused("slack:21deg", "gears have a slack of 0 to 20 degrees");
    assert_refused("slip:101%", "wheels slip by 0% to 100%");
    assert_refused("slip:-1%", "wheels slip by 0% to 100%");
    assert_refused("latency:6", "senses are 0 to 5 ticks late");
    assert_refused("false-beacon:-1", "food is seen up to 8191 mm away");
    TEST_ASSERT_EQUAL_MEMORY(&nothing, &faults, sizeof faults);
}
