#include "firmware/perception.h"

void perception_start(struct perception *perception)
{
    *perception = (struct perception){.before = {0}};
}

uint8_t perception_filter(struct perception *perception, const struct config *config, uint8_t feel)
{
    uint8_t last = perception->before[0];
    uint8_t last_but_one = perception->before[1];

    perception->before[1] = last;
    perception->before[0] = feel;
    if (!config->value[FILTER])
        return feel;
    return (uint8_t)((feel & last) | (feel & last_but_one) | (last & last_but_one));
}

void perception_decide(struct perception *perception, const struct config *config, uint8_t feel)
{
    if (config->value[DISTRUST] == 0)
        return;
    for (unsigned i = 0; i < FEEL_COUNT; i++) {
        uint8_t *count = &perception->in_a_row[i];

        if (!(feel & (1u << i)))
            *count = 0;
        else if (*count < UINT8_MAX)
            (*count)++;
    }
}

uint8_t perception_believed(const struct perception *perception, const struct config *config, uint8_t feel)
{
    uint8_t distrust = config->value[DISTRUST];
    uint8_t believed = feel;

    if (distrust == 0)
        return feel;
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        if (perception->in_a_row[i] >= distrust)
            believed &= (uint8_t)~(1u << i);
    return believed;
}
