/* behaviour.h: how the robot decides: one behaviour for each profile, chosen by START.
 *
 * A profile NAME of octet.dbc has a file NAME.c here with the two functions declared below. They are called by name,
 * not through pointers, so that tools can compute the worst-case stack. */
#ifndef OCTET_BEHAVIOUR_H
#define OCTET_BEHAVIOUR_H

#include "firmware/brain.h"

/* bool NAME_begin(brain): Begins a run. The memory is already of the behaviour's kind, and the fields of *brain that
 * all behaviours share are reset. May change the memory, and then sets brain->changed. Returns true if the behaviour
 * learns, so that its memory is stored.
 *
 * struct action NAME_next(brain, config, senses): As brain_next. */
#define BEHAVIOUR_DECLARE(profile, name, kind) \
    bool name##_begin(struct brain *brain);    \
    struct action name##_next(struct brain *brain, const struct config *config, const struct senses *senses);

ROBOT_BEHAVIOURS(BEHAVIOUR_DECLARE)

#endif
