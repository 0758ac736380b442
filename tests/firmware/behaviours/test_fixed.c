#include "firmware/brain.h"
#include "firmware/memory_write.h"

#include <unity.h>

static const uint8_t PROGRAMMED[CELL_COUNT] = {0, 1, 1, 1, 2, 1, 2, 1};

static struct brain brain;
static struct config config;

void setUp(void)
{
    brain = (struct brain){.frozen = false};
    config_reset(&config);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_FIXED, 1));
}

void tearDown(void) {}

static struct action next(uint8_t pattern)
{
    const struct senses senses = {.feel = (uint8_t)(pattern << 1)};

    return brain_next(&brain, &config, &senses);
}

static void test_it_begins_with_the_programmed_turns(void)
{
    TEST_ASSERT_EQUAL_UINT8_ARRAY(PROGRAMMED, brain.memory.cell, CELL_COUNT);
    TEST_ASSERT_TRUE(brain.changed);
}

static void test_whatever_was_remembered_gives_way_to_them(void)
{
    memory_learn(&brain.memory, 1, SIDE_RIGHT);
    brain_start(&brain, PROFILE_FIXED, 1);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(PROGRAMMED, brain.memory.cell, CELL_COUNT);
}

static void test_every_pattern_has_its_turn(void)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        struct action action = next(pattern);

        TEST_ASSERT_EQUAL(REASON_REMEMBERED, action.reason);
        TEST_ASSERT_EQUAL(PROGRAMMED[pattern] == SIDE_LEFT ? -10 : 10, action.turn_deg);
    }
}

static void test_what_a_person_writes_is_used(void)
{
    TEST_ASSERT_TRUE(memory_write(&brain.memory, MEMORY_KIND_SIDES, 1u << 1, SIDE_RIGHT << 8));
    TEST_ASSERT_EQUAL(10, next(1).turn_deg);
}

static void test_a_cell_that_a_person_erased_is_tried_and_not_learned(void)
{
    memory_erase(&brain.memory);
    brain.changed = false;
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(7).reason);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(2).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, 7));
    TEST_ASSERT_FALSE(brain.changed);
}

static void test_it_is_bored_as_the_article_is(void)
{
    for (unsigned i = 0; i < 10; i++)
        TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(2).reason);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(2).reason);
}

static void test_it_stores_nothing(void)
{
    TEST_ASSERT_FALSE(brain.learns);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_begins_with_the_programmed_turns);
    RUN_TEST(test_whatever_was_remembered_gives_way_to_them);
    RUN_TEST(test_every_pattern_has_its_turn);
    RUN_TEST(test_what_a_person_writes_is_used);
    RUN_TEST(test_a_cell_that_a_person_erased_is_tried_and_not_learned);
    RUN_TEST(test_it_is_bored_as_the_article_is);
    RUN_TEST(test_it_stores_nothing);
    return UNITY_END();
}
