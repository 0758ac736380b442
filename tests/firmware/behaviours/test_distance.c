#include "firmware/brain.h"

#include <unity.h>

enum { FRONT = FEEL_FRONT, PATTERN_FRONT = 2 };

static struct brain brain;
static struct config config;

void setUp(void)
{
    brain = (struct brain){.frozen = false};
    config_reset(&config);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_DISTANCE, 1));
}

void tearDown(void) {}

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
    memory_learn(&brain.memory, PATTERN_FRONT, side);
    action = brain_next(&brain, &config, &senses);
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, action.reason);
    return action.turn_deg;
}

static void test_it_wants_ranges_and_learns(void)
{
    TEST_ASSERT_TRUE(brain.wants_ranges);
    TEST_ASSERT_TRUE(brain.learns);
}

static void test_the_nearer_it_is_the_bigger_the_turn(void)
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

static void test_the_front_three_count_and_the_sides_do_not(void)
{
    for (unsigned sensor = 0; sensor < FEEL_COUNT; sensor++)
        TEST_ASSERT_EQUAL_INT(sensor == 0 || sensor == 4 ? 10 : 20, turn_with(SIDE_RIGHT, sensor, 30));
}

static void test_the_nearest_counts(void)
{
    struct senses senses = blocked(1, 50);

    senses.range_mm[2] = 21;
    senses.range_mm[3] = 40;
    memory_learn(&brain.memory, PATTERN_FRONT, SIDE_LEFT);
    TEST_ASSERT_EQUAL_INT(-23, brain_next(&brain, &config, &senses).turn_deg);
}

static void test_it_adds_to_the_turn_that_is_set(void)
{
    config_set(&config, TURN_DEG, 180);
    TEST_ASSERT_EQUAL_INT(200, turn_with(SIDE_RIGHT, 2, 0));
}

static void test_a_trial_is_as_big_as_ever(void)
{
    const struct senses senses = blocked(2, 0);
    int turn_deg = brain_next(&brain, &config, &senses).turn_deg;

    TEST_ASSERT_EQUAL_INT(45, turn_deg < 0 ? -turn_deg : turn_deg);
}

static void test_another_behaviour_wants_no_ranges(void)
{
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_ARTICLE, 1));
    TEST_ASSERT_FALSE(brain.wants_ranges);
}

static void test_a_behaviour_that_a_memory_has_chosen_wants_no_ranges(void)
{
    static const uint8_t cells[CELL_COUNT] = {0, 5};

    TEST_ASSERT_TRUE(brain_adopt(&brain, cells));
    TEST_ASSERT_FALSE(brain.wants_ranges);
}

static void test_the_smallest_turn_is_to_its_side_too(void)
{
    config_set(&config, TURN_DEG, 1);
    TEST_ASSERT_EQUAL_INT(21, turn_with(SIDE_RIGHT, 2, 0));
    TEST_ASSERT_EQUAL_INT(-21, turn_with(SIDE_LEFT, 2, 0));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_wants_ranges_and_learns);
    RUN_TEST(test_the_nearer_it_is_the_bigger_the_turn);
    RUN_TEST(test_the_front_three_count_and_the_sides_do_not);
    RUN_TEST(test_the_nearest_counts);
    RUN_TEST(test_it_adds_to_the_turn_that_is_set);
    RUN_TEST(test_a_trial_is_as_big_as_ever);
    RUN_TEST(test_another_behaviour_wants_no_ranges);
    RUN_TEST(test_a_behaviour_that_a_memory_has_chosen_wants_no_ranges);
    RUN_TEST(test_the_smallest_turn_is_to_its_side_too);
    return UNITY_END();
}
