/* brain_rig.h: a brain, and what the tests of its behaviours share. */
#ifndef OCTET_BRAIN_RIG_H
#define OCTET_BRAIN_RIG_H

#include "tests/test.h"
#include "firmware/brain.h"

enum { CLEAR = 0, FRONT_RIGHT = FEEL_FRONT_RIGHT, FRONT = FEEL_FRONT, FRONT_LEFT = FEEL_FRONT_LEFT, ALL_THREE = 14 };
enum { PATTERN_FRONT_RIGHT = 1, PATTERN_FRONT = 2, PATTERN_FRONT_LEFT = 4, PATTERN_ALL_THREE = 7 };

static struct brain brain;
static struct config config;

/* Starts this profile with an empty memory and the default parameters. */
static inline void begin(enum profile profile)
{
    brain = (struct brain){.frozen = false};
    config_reset(&config);
    TEST_ASSERT_TRUE(brain_start(&brain, (uint8_t)profile, 1));
}

/* The next action, where the last one ended with these sensors triggered. */
static inline struct action next(uint8_t feel)
{
    const struct senses senses = {.feel = feel};

    return brain_next(&brain, &config, &senses);
}

/* The same, with food in sight. */
static inline struct action next_seeing_food(uint8_t feel, uint16_t beacon_mm)
{
    const struct senses senses = {.feel = feel, .look = true, .beacon_mm = beacon_mm};

    return brain_next(&brain, &config, &senses);
}

/* Puts the side into the pattern's cell. */
static inline void teach(uint8_t pattern, enum side side)
{
    memory_learn(&brain.memory, pattern, side);
}

/* Checks reason, turn and distance of an action. */
static inline void assert_action(enum reason reason, int turn_deg, unsigned forward_mm, struct action action)
{
    TEST_ASSERT_EQUAL(reason, action.reason);
    TEST_ASSERT_EQUAL(turn_deg, action.turn_deg);
    TEST_ASSERT_EQUAL(forward_mm, action.forward_mm);
}

/* Checks that the next so many actions, blocked in front, are remembered turns. */
static inline void remembered_turns(unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
}

#endif
