#include "firmware/brain.h"

#include "firmware/behaviours/behaviour.h"
#include "tests/test.h"

enum { FRONT = FEEL_FRONT, PATTERN_FRONT = 2 };

static struct brain brain;
static struct config config;

void setUp(void)
{
    brain = (struct brain){.frozen = false};
    config_reset(&config);
}

static struct action next(uint8_t feel)
{
    const struct senses senses = {.feel = feel};

    return brain_next(&brain, &config, &senses);
}

static struct action next_with_food_near(void)
{
    const struct senses senses = {.look = true, .beacon_mm = 1};

    return brain_next(&brain, &config, &senses);
}

TEST(every_profile_can_be_started)
{
    for (uint8_t profile = 0; profile < PROFILE_COUNT; profile++) {
        TEST_ASSERT_TRUE(brain_start(&brain, profile, 1));
        TEST_ASSERT_EQUAL_UINT8(profile, brain.profile);
    }
}

TEST(start_with_an_unknown_profile_changes_no_state)
{
    const struct brain before = brain;

    for (unsigned profile = PROFILE_COUNT; profile <= UINT8_MAX; profile++) {
        TEST_ASSERT_FALSE(brain_start(&brain, (uint8_t)profile, 7));
        TEST_ASSERT_EQUAL_MEMORY(&before, &brain, sizeof brain);
    }
}

TEST(own_behaviour_not_linked_in_stops_the_robot)
{
    brain.profile = PROFILE_OWN;
    TEST_ASSERT_EQUAL(REASON_STOP, next(FRONT).reason);
    TEST_ASSERT_FALSE(own_begin(&brain));
}

TEST(profile_decides_the_next_action)
{
    brain_start(&brain, PROFILE_ARTICLE, 1);
    memory_learn(&brain.memory, PATTERN_FRONT, SIDE_RIGHT);
    TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
    brain_start(&brain, PROFILE_NEVER, 1);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT).reason);
}

TEST(only_learning_profiles_store_their_memory)
{
    brain_start(&brain, PROFILE_FIXED, 1);
    TEST_ASSERT_FALSE(brain.learns);
    brain_start(&brain, PROFILE_ARTICLE, 1);
    TEST_ASSERT_TRUE(brain.learns);
    brain_start(&brain, PROFILE_NEVER, 1);
    TEST_ASSERT_FALSE(brain.learns);
}

TEST(start_of_any_profile_resets_the_repeat_count)
{
    for (uint8_t profile = 0; profile < PROFILE_COUNT; profile++) {
        brain.repeat_count = 9;
        brain_start(&brain, profile, 1);
        TEST_ASSERT_EQUAL_UINT8(0, brain.repeat_count);
    }
}

TEST(start_of_any_profile_discards_the_pending_action)
{
    for (uint8_t profile = 0; profile < PROFILE_COUNT; profile++) {
        brain_start(&brain, PROFILE_ARTICLE, 1);
        next(0);   /* a step, after which it would eat */
        brain_start(&brain, profile, 1);
        TEST_ASSERT_EQUAL_UINT8(0, brain.awaits);
        TEST_ASSERT_EQUAL(REASON_TOWARD_FOOD, next_with_food_near().reason);   /* not: eat */
    }
}

static const uint8_t SURE[CELL_COUNT] = {0, 13, 6};
static const uint8_t OF_ALL_SENSORS[CELL_COUNT] = {0x2F};

TEST(start_translates_the_memory_for_the_profile)
{
    static const uint8_t expected[CELL_COUNT] = {0, 1, 2};

    TEST_ASSERT_TRUE(brain_adopt(&brain, SURE));
    brain.changed = false;
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_ARTICLE, 1));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, brain.memory.cell, CELL_COUNT);
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(start_keeps_a_memory_of_the_kind_of_the_profile)
{
    TEST_ASSERT_TRUE(brain_adopt(&brain, SURE));
    brain.changed = false;
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_SEARCHER, 1));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(SURE, brain.memory.cell, CELL_COUNT);
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(adopted_memory_selects_the_first_matching_profile)
{
    static const uint8_t sides[CELL_COUNT] = {0, 1};

    brain_start(&brain, PROFILE_REARMED, 1);
    TEST_ASSERT_TRUE(brain_adopt(&brain, sides));
    TEST_ASSERT_EQUAL_UINT8(PROFILE_REARMED, brain.profile);
    TEST_ASSERT_TRUE(brain_adopt(&brain, SURE));
    TEST_ASSERT_EQUAL_UINT8(PROFILE_ADAPTIVE, brain.profile);
    TEST_ASSERT_TRUE(brain_adopt(&brain, OF_ALL_SENSORS));
    TEST_ASSERT_EQUAL_UINT8(PROFILE_FIVE, brain.profile);
    TEST_ASSERT_TRUE(brain.learns);
}

TEST(adoption_of_invalid_bytes_changes_no_state)
{
    static const uint8_t none[CELL_COUNT] = {0, 3};
    const struct brain before = brain;

    TEST_ASSERT_FALSE(brain_adopt(&brain, none));
    TEST_ASSERT_EQUAL_MEMORY(&before, &brain, sizeof brain);
}

TEST(write_must_match_the_memory_kind_of_the_profile)
{
    brain_start(&brain, PROFILE_ARTICLE, 1);
    brain.changed = false;
    TEST_ASSERT_FALSE(brain_write(&brain, 1u << 1, 5u << 8));
    TEST_ASSERT_FALSE(brain.changed);
    brain_start(&brain, PROFILE_ADAPTIVE, 1);
    TEST_ASSERT_TRUE(brain_write(&brain, 1u << 1, 5u << 8));
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(start_is_followed_by_a_decision)
{
    brain_start(&brain, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL(REASON_WANDER, next(0).reason);
    brain_start(&brain, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EQUAL(REASON_TRIAL, next(FRONT).reason);
}

TEST(denied_step_is_followed_by_no_look_around)
{
    const struct senses nothing = {.tick = 0};

    brain_start(&brain, PROFILE_ARTICLE, 1);
    next(0);
    brain.used = 7;
    brain_doubt(&brain, &nothing);
    TEST_ASSERT_EQUAL_UINT8(0, brain.used);
    TEST_ASSERT_EQUAL(REASON_WANDER, next(0).reason);
}

/* It makes ten remembered turns that do not help, and is bored. */
static void assert_is_bored_without_learning(enum profile profile, uint8_t cell, uint8_t byte)
{
    const struct senses blocked = {.feel = FRONT};
    struct action action = {.reason = REASON_REMEMBERED};

    brain = (struct brain){.frozen = false};
    brain_start(&brain, profile, 1);
    brain.memory.cell[cell] = byte;
    for (unsigned i = 0; i < 11 && action.reason == REASON_REMEMBERED; i++) {
        action = next(FRONT);
        if (action.reason == REASON_REMEMBERED)
            brain_doubt(&brain, &blocked);
    }
    TEST_ASSERT_EQUAL(REASON_BOREDOM, action.reason);
    TEST_ASSERT_EQUAL_HEX8(byte, brain.memory.cell[cell]);
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(denied_actions_teach_no_behaviour)
{
    assert_is_bored_without_learning(PROFILE_RECHECK, 2, SIDE_LEFT);
    assert_is_bored_without_learning(PROFILE_FORGETFUL, 2, SIDE_LEFT);
    assert_is_bored_without_learning(PROFILE_ADAPTIVE, 2, 5);
    assert_is_bored_without_learning(PROFILE_FIVE, 1, SIDE_LEFT);   /* that of reading 4 in the lowest bits */
}

TEST(start_keeps_a_change_not_yet_reported)
{
    brain.changed = true;
    brain_start(&brain, PROFILE_ARTICLE, 1);
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(adopt_considers_the_first_profile)
{
    static const uint8_t sides[CELL_COUNT] = {0, SIDE_LEFT};

    brain_start(&brain, PROFILE_ADAPTIVE, 1);
    TEST_ASSERT_TRUE(brain_adopt(&brain, sides));
    TEST_ASSERT_EQUAL_UINT8(0, brain.profile);
}

TEST(votes_fill_empty_cells_except_those_emptied_by_boredom)
{
    static const int8_t votes[CELL_COUNT] = {1, 1, -1, 1, -1};
    static const uint8_t expected[CELL_COUNT] = {0, SIDE_LEFT, SIDE_LEFT, 0, SIDE_LEFT};

    brain_start(&brain, PROFILE_ARTICLE, 1);
    memory_learn(&brain.memory, 1, SIDE_LEFT);
    brain.unlearned = 1u << 3;
    TEST_ASSERT_TRUE(brain_take_votes(&brain, votes));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, brain.memory.cell, CELL_COUNT);
}
