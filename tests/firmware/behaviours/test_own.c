/* A robot with a behaviour of its user: this one, linked in the place of own.c. */
#include "firmware/behaviours/behaviour.h"

#include <string.h>

#include "tests/test.h"

const bool OWN_IS_LINKED = true;

static bool learns;
static struct brain brain;
static struct config config;

bool own_begin(struct brain *begun)
{
    begun->own[7]++;
    return learns;
}

struct action own_next(struct brain *asked, const struct config *set, const struct senses *senses)
{
    return (struct action){
        .reason = REASON_PROGRAM,
        .turn_deg = (int16_t)(asked->own[7] + senses->feel + set->value[TURN_DEG]),
    };
}

void setUp(void)
{
    brain = (struct brain){.frozen = false};
    config_reset(&config);
    learns = true;
}

TEST(own_behaviour_is_started_and_called)
{
    const struct senses senses = {.feel = FEEL_FRONT};
    struct action action;

    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_OWN, 1));
    TEST_ASSERT_EQUAL_UINT8(PROFILE_OWN, brain.profile);
    action = brain_next(&brain, &config, &senses);
    TEST_ASSERT_EQUAL(REASON_PROGRAM, action.reason);
    TEST_ASSERT_EQUAL_INT(1 + FEEL_FRONT + 10, action.turn_deg);
}

TEST(own_behaviour_decides_whether_it_learns)
{
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_OWN, 1));
    TEST_ASSERT_TRUE(brain.learns);
    learns = false;
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_OWN, 1));
    TEST_ASSERT_FALSE(brain.learns);
}

TEST(start_clears_the_bytes_of_own_behaviour)
{
    static const uint8_t expected[8] = {0, 0, 0, 0, 0, 0, 0, 1};

    memset(brain.own, 9, sizeof brain.own);
    TEST_ASSERT_TRUE(brain_start(&brain, PROFILE_OWN, 1));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, brain.own, sizeof brain.own);
    brain_start(&brain, PROFILE_ARTICLE, 1);
    TEST_ASSERT_EACH_EQUAL_UINT8(0, brain.own, sizeof brain.own);
}

TEST(start_rejects_profiles_above_own)
{
    for (unsigned profile = PROFILE_OWN + 1; profile <= UINT8_MAX; profile++)
        TEST_ASSERT_FALSE(brain_start(&brain, (uint8_t)profile, 1));
}

TEST(own_behaviour_uses_the_sides_memory_kind)
{
    static const uint8_t sure[CELL_COUNT] = {0, 13, 6};
    static const uint8_t expected[CELL_COUNT] = {0, 1, 2};

    TEST_ASSERT_TRUE(memory_adopt(&brain.memory, sure));
    brain_start(&brain, PROFILE_OWN, 1);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, brain.memory.cell, CELL_COUNT);
    TEST_ASSERT_TRUE(brain_write(&brain, 2, SIDE_RIGHT << 8));
    TEST_ASSERT_FALSE(brain_write(&brain, 2, 13 << 8));
}
