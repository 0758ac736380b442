#include "brain_rig.h"

#include "firmware/memory/memory.h"

static const uint8_t PROGRAMMED[CELL_COUNT] = {0, 1, 1, 1, 2, 1, 2, 1};

void setUp(void)
{
    begin(PROFILE_FIXED);
}

TEST(it_begins_with_the_programmed_turns)
{
    TEST_ASSERT_EQUAL_UINT8_ARRAY(PROGRAMMED, brain.memory.cell, CELL_COUNT);
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(whatever_was_remembered_gives_way_to_them)
{
    memory_learn(&brain.memory, 1, SIDE_RIGHT);
    brain_start(&brain, PROFILE_FIXED, 1);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(PROGRAMMED, brain.memory.cell, CELL_COUNT);
}

TEST(every_pattern_has_its_turn)
{
    for (uint8_t pattern = 1; pattern < CELL_COUNT; pattern++) {
        struct action action = next((uint8_t)(pattern << 1));

        TEST_ASSERT_EQUAL(REASON_REMEMBERED, action.reason);
        TEST_ASSERT_EQUAL(PROGRAMMED[pattern] == SIDE_LEFT ? -10 : 10, action.turn_deg);
    }
}

TEST(what_a_person_writes_is_used)
{
    TEST_ASSERT_TRUE(memory_write(&brain.memory, MEMORY_KIND_SIDES, 1u << 1, SIDE_RIGHT << 8));
    TEST_ASSERT_EQUAL(10, next(FRONT_RIGHT).turn_deg);
}

TEST(a_cell_that_a_person_erased_is_tried_and_not_learned)
{
    memory_erase(&brain.memory);
    brain.changed = false;
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(ALL_THREE).reason);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT).reason);
    TEST_ASSERT_EQUAL(SIDE_NOTHING, memory_recall(&brain.memory, PATTERN_ALL_THREE));
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(it_is_bored_as_the_article_is)
{
    remembered_turns(10);
    TEST_ASSERT_EQUAL(REASON_BOREDOM, next(FRONT).reason);
}

TEST(it_stores_nothing)
{
    TEST_ASSERT_FALSE(brain.learns);
}
