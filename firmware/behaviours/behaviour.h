/* behaviour.h: how the robot decides: one behaviour for each profile, chosen by START.
 *
 * A profile NAME of octet.dbc has a file NAME.c here with the two functions declared below. They are called by name and
 * not through pointers, so that the worst stack can be worked out. */
#ifndef OCTET_BEHAVIOUR_H
#define OCTET_BEHAVIOUR_H

#include "firmware/brain.h"

/* bool NAME_begin(brain): A run begins; the memory is of the behaviour's kind, and all that is in *brain for every
 * behaviour is as new. True if it learns, so that its memory is to be stored. It may put something into the memory, and
 * sets brain->changed if it does.
 *
 * struct action NAME_next(brain, config, senses): As brain_next. */
#define BEHAVIOUR_DECLARE(profile, name, kind) \
    bool name##_begin(struct brain *brain);    \
    struct action name##_next(struct brain *brain, const struct config *config, const struct senses *senses);

ROBOT_BEHAVIOURS(BEHAVIOUR_DECLARE)

#endif
