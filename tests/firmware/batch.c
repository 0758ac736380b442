/* For many_brains.py: brain_next of many brains, with the same senses, in one call. */
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
