#include "firmware/io.h"
#include "host_sim/world/native/body_faults.h"
#include "tests/test.h"

enum { SEED = 1, ROBOT = 0 };

static struct body_faults faults;

void setUp(void)
{
    faults = (struct body_faults){0};
}

static void add(const char *what)
{
    TEST_ASSERT_NULL_MESSAGE(body_faults_add(&faults, what, SEED, ROBOT), what);
}

static void assert_refused(const char *what, const char *why)
{
    TEST_ASSERT_EQUAL_STRING_MESSAGE(why, body_faults_add(&faults, what, SEED, ROBOT), what);
}

TEST(swapping_or_mirroring_twice_undoes_it)
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

TEST(each_sensor_can_be_stuck)
{
    add("stuck-on:right");
    add("stuck-on:front-left");
    add("stuck-off:left");
    TEST_ASSERT_EQUAL_UINT8(FEEL_RIGHT | FEEL_FRONT_LEFT, faults.stuck_on);
    TEST_ASSERT_EQUAL_UINT8(FEEL_LEFT, faults.stuck_off);
}

TEST(the_last_way_in_which_a_sensor_is_stuck_holds)
{
    add("stuck-on:front");
    add("stuck-off:front");
    TEST_ASSERT_EQUAL_UINT8(0, faults.stuck_on);
    add("stuck-on:front");
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, faults.stuck_on);
    TEST_ASSERT_EQUAL_UINT8(0, faults.stuck_off);
}

TEST(a_motor_lacks_what_it_does_not_have)
{
    add("weak-motor:left:60%");
    add("weak-motor:right:0%");
    TEST_ASSERT_EQUAL_UINT8(40, faults.left_lost_percent);
    TEST_ASSERT_EQUAL_UINT8(100, faults.right_lost_percent);
    add("weak-motor:left:100%");
    TEST_ASSERT_EQUAL_UINT8(0, faults.left_lost_percent);
}

TEST(an_odometer_counts_too_little_too_much_or_backward)
{
    add("odometer:left:-999%");
    add("odometer:right:999%");
    TEST_ASSERT_EQUAL_INT16(-1099, faults.left_miscounted_percent);
    TEST_ASSERT_EQUAL_INT16(899, faults.right_miscounted_percent);
}

TEST(food_is_shown_where_none_is)
{
    add("false-beacon:8191");
    TEST_ASSERT_EQUAL_UINT16(8191, faults.false_beacon_mm);
    add("false-beacon:0");
    TEST_ASSERT_EQUAL_UINT16(0, faults.false_beacon_mm);
}

TEST(what_is_late_or_loose_has_its_unit)
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

TEST(noise_can_be_in_no_tick_and_in_all)
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

TEST(another_seed_or_robot_has_other_noise)
{
    TEST_ASSERT_EQUAL_HEX64(0xE220A8397B1DCDAFu, key_of(0, 0));   /* SplitMix64's first number */
    TEST_ASSERT_EQUAL_HEX64(key_of(1, 0), key_of(0, 10000));
    TEST_ASSERT_NOT_EQUAL_HEX64(key_of(1, 0), key_of(2, 0));
    TEST_ASSERT_NOT_EQUAL_HEX64(key_of(1, 0), key_of(1, 1));
}

TEST(only_noise_has_a_key)
{
    add("noise:1/2");
    add("mirror");
    TEST_ASSERT_EQUAL_UINT32(1, faults.noise);
    TEST_ASSERT_NULL(body_faults_add(&faults, "mirror", SEED + 1, ROBOT));
    TEST_ASSERT_EQUAL_HEX64(body_faults_mix(10000u * SEED), faults.noise_key);
}

TEST(a_repair_mends_everything)
{
    static const struct body_faults nothing = {0};

    add("mirror");
    add("noise:1/2");
    add("stuck-on:front");
    add("weak-motor:left:5%");
    add("repair");
    TEST_ASSERT_EQUAL_MEMORY(&nothing, &faults, sizeof faults);
}

TEST(what_cannot_be_changes_nothing_and_says_what_was_meant)
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
