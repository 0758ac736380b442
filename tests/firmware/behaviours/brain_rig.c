#include "brain_rig.h"

struct brain brain;
struct config config;

void begin(enum profile profile)
{
    brain = (struct brain){.frozen = false};
    config_reset(&config);
    TEST_ASSERT_TRUE(brain_start(&brain, (uint8_t)profile, 1));
}

struct action next(uint8_t feel)
{
    const struct senses senses = {.feel = feel};

    return brain_next(&brain, &config, &senses);
}

struct action next_seeing_food(uint8_t feel, uint16_t beacon_mm)
{
    const struct senses senses = {.feel = feel, .look = true, .beacon_mm = beacon_mm};

    return brain_next(&brain, &config, &senses);
}

void teach(uint8_t pattern, enum side side)
{
    memory_learn(&brain.memory, pattern, side);
}

void assert_action(enum reason reason, int turn_deg, unsigned forward_mm, struct action action)
{
    TEST_ASSERT_EQUAL(reason, action.reason);
    TEST_ASSERT_EQUAL(turn_deg, action.turn_deg);
    TEST_ASSERT_EQUAL(forward_mm, action.forward_mm);
}

void remembered_turns(unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
}
