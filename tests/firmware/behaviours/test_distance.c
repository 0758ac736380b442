#include "brain_rig.h"

void setUp(void)
{
    begin(PROFILE_DISTANCE);
}

static struct senses blocked(unsigned sensor, uint8_t range_mm)
{
    struct senses senses = {.feel = FRONT, .range_mm = {RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE}};

    senses.range_mm[sensor] = range_mm;
    return senses;
}

static int turn_with(enum side side, unsigned sensor, uint8_t range_mm)
{
    const struct senses senses = blocked(sensor, range_mm);
    struct action action;

    brain.awaits = 0;
    teach(PATTERN_FRONT, side);
    action = brain_next(&brain, &config, &senses);
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, action.reason);
    return action.turn_deg;
}

TEST(distance_profile_wants_ranges_and_learns)
{
    TEST_ASSERT_TRUE(brain.wants_ranges);
    TEST_ASSERT_TRUE(brain.learns);
}

TEST(turn_grows_with_nearness)
{
    static const struct {
        uint8_t range_mm;
        int turn_deg;
    } cases[] = {{RANGE_NONE, 10}, {61, 10}, {60, 10}, {59, 10}, {58, 11}, {57, 11}, {30, 20}, {2, 29}, {1, 30}, {0, 30}};

    for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++) {
        TEST_ASSERT_EQUAL_INT(cases[i].turn_deg, turn_with(SIDE_RIGHT, 2, cases[i].range_mm));
        TEST_ASSERT_EQUAL_INT(-cases[i].turn_deg, turn_with(SIDE_LEFT, 2, cases[i].range_mm));
    }
}

TEST(turn_depends_on_the_front_three_distances)
{
    for (unsigned sensor = 0; sensor < FEEL_COUNT; sensor++)
        TEST_ASSERT_EQUAL_INT(sensor == 0 || sensor == 4 ? 10 : 20, turn_with(SIDE_RIGHT, sensor, 30));
}

TEST(turn_depends_on_the_nearest_distance)
{
    struct senses senses = blocked(1, 50);

    senses.range_mm[2] = 21;
    senses.range_mm[3] = 40;
    teach(PATTERN_FRONT, SIDE_LEFT);
    TEST_ASSERT_EQUAL_INT(-23, brain_next(&brain, &config, &senses).turn_deg);
}

TEST(nearness_adds_to_the_turn_parameter)
{
    config.value[TURN_DEG] = 180;
    TEST_ASSERT_EQUAL_INT(200, turn_with(SIDE_RIGHT, 2, 0));
}

TEST(distance_does_not_change_the_trial_angle)
{
    const struct senses senses = blocked(2, 0);
    int turn_deg = brain_next(&brain, &config, &senses).turn_deg;

    TEST_ASSERT_EQUAL_INT(45, turn_deg < 0 ? -turn_deg : turn_deg);
}

TEST(start_of_another_profile_clears_wants_ranges)
{
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_ARTICLE, 1));
    TEST_ASSERT_FALSE(brain.wants_ranges);
}

TEST(adopted_memory_clears_wants_ranges)
{
    static const uint8_t cells[CELL_COUNT] = {0, 5};

    TEST_ASSERT_TRUE(brain_adopt(&brain, cells));
    TEST_ASSERT_FALSE(brain.wants_ranges);
}

TEST(smallest_turn_parameter_keeps_the_side)
{
    config.value[TURN_DEG] = 1;
    TEST_ASSERT_EQUAL_INT(21, turn_with(SIDE_RIGHT, 2, 0));
    TEST_ASSERT_EQUAL_INT(-21, turn_with(SIDE_LEFT, 2, 0));
}

TEST(near_object_outside_the_way_causes_no_turn)
{
    struct senses senses = blocked(2, 30);

    senses.feel = CLEAR;
    TEST_ASSERT_EQUAL_INT(0, brain_next(&brain, &config, &senses).turn_deg);
}
