/* Many decisions in one call, for many_brains.py: the same question to each of many brains. */
#include <stddef.h>

#include "firmware/brain.h"

void brain_next_each(struct action actions[], struct brain brains[], const struct config *config,
                     const struct senses *senses, size_t count);

void brain_next_each(struct action actions[], struct brain brains[], const struct config *config,
                     const struct senses *senses, size_t count)
{
    for (size_t i = 0; i < count; i++)
        actions[i] = brain_next(&brains[i], config, senses);
}
