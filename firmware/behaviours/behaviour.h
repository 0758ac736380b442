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

extern const bool OWN_IS_LINKED;
        /* Whether the profile own is there: a behaviour that its user has written, linked in the place of own.c. */

/* The loop of the article's listing, for the behaviours that differ from it only in their knowledge.
 * Random numbers are drawn exactly where the listing draws one. */

/* What to do when the current action ends. */
enum awaits {
    AWAITS_NOTHING,
    AWAITS_LOOK,      /* after a step forward: look for food */
    AWAITS_VERDICT,   /* after a trial turn: judge it */
    AWAITS_BOREDOM,   /* after one remembered turn too many: about-face */
    AWAITS_CHECK      /* after any other remembered turn: nothing in the listing */
};

bool listing_trial_helped(const struct brain *brain, const struct senses *senses);
        /* Whether a trial has just ended, at tried_feel and to tried_side, with fewer sensors triggered than before.
           Call before listing_next, which begins the next action. */

bool listing_remembered_in_vain(const struct brain *brain, const struct senses *senses);
        /* Whether a remembered turn has just ended, at tried_feel, with no fewer sensors triggered than before. Call
           before listing_next. */

struct action listing_step(struct brain *brain, const struct config *config, const struct senses *senses);
        /* A step forward; sets AWAITS_LOOK. */

struct action listing_next(struct brain *brain, const struct config *config, const struct senses *senses,
                           enum side known);
        /* The listing's next action, given the turn that it remembers for these senses. */

/* Credit assignment for the behaviours that judge their memory by the outcome. The cells used since the
 * robot was blocked are praised when the way is clear, and blamed when it turns about in boredom.
 *
 * The behaviour says how much praise adds to a cell's confidence: 0 if its cells hold only a side. */

bool used_cells_learn(struct brain *brain, const struct senses *senses, unsigned confidence);
        /* If a trial has just helped, stores its side with that confidence, marks the cell as used and returns true.
           Call before the next action is chosen. */

void used_cells_judge(struct brain *brain, const struct action *action, uint8_t pattern, int praise);
        /* Notes the action chosen for that pattern. An about-face lowers the confidence of each used cell by 2 and
           resets the repeat count. */

struct action used_cells_next(struct brain *brain, const struct config *config, const struct senses *senses,
                              unsigned confidence, int praise);
        /* The listing's next action, between calls of the two functions above. */

#endif
