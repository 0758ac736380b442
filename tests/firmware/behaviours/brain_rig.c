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

void remembered_turns(unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(REASON_REMEMBERED, next(FRONT).reason);
}
