/* octet_brain.h: all that a behaviour of your own needs: tools/run --profile mine.c. tools/octet new begins one.
 *
 * Your file has the two functions below, and others if you like. It is one file, includes this header and no other
 * file of yours, and uses nothing else of the robot.
 *
 * What must not be done, and is refused with the file and the line:
 * - Nothing lasts from one call to the next except in *brain: no static or global variables. One program may run
 *   thousands of robots, and takes them back in time.
 * - No malloc, printf, time or other function of a system: a microcontroller has none. note() prints.
 * - No random numbers but those of below() and any_side(). The same *brain and senses always give the same action.
 * - No loop without an end: a call may take a million branches, and 0.2 s.
 * - Of *brain, change only what is listed below; of *config and *senses, nothing. */
#ifndef OCTET_BRAIN_OF_ONES_OWN_H
#define OCTET_BRAIN_OF_ONES_OWN_H

#include "firmware/behaviours/behaviour.h"
#include "firmware/pattern.h"

bool own_begin(struct brain *brain);
        /* Called once, when a run starts. The memory still holds the eight bytes of the last run; what else is yours
           in *brain is 0. Returns whether the robot learns: if so, its memory is stored whenever it has changed. */

struct action own_next(struct brain *brain, const struct config *config, const struct senses *senses);
        /* Called each time that an action has ended, never in between: about every 0.1 s. The senses are those of the
           place where it ended. Judges what the action brought, if you like, and returns the next one.

   struct action: what the robot does until the next call.
       reason           why, for people and pages: REASON_WANDER, _TOWARD_FOOD, _LOOK_AROUND, _REMEMBERED, _TRIAL,
                        _BOREDOM, _EAT, _PROGRAM (none of these), or _STOP (at rest for one tick). Only _EAT does
                        something: it eats food within reach.
       forward_mm       a step of -1000..1000 mm, backward negative; it ends early in front of an obstacle
       turn_deg         or a turn of -360..360 degrees, right positive; not both in one action
       rest_ticks       then a rest of 0..255 ticks of 20 ms
       until_food       true: the turn ends when food is seen

   senses, read only:
       feel             proximity, a sum of FEEL_RIGHT 1, FEEL_FRONT_RIGHT 2, FEEL_FRONT 4, FEEL_FRONT_LEFT 8 and
                        FEEL_LEFT 16
       look             food is straight ahead, beacon_mm 1..8191 mm away; beacon_mm is 0 if none is seen
       bump             the body touches an obstacle
   pattern_of(feel)     the three front sensors, a sum of 1 front-right, 2 front, 4 front-left; 0: the way is clear
   pattern_count(p)     how many of the three, 0..3

   config->value[N], read only: a parameter, 0..255 in its unit, such as [STEP_MM]; docs/protocol.md lists them.

   *brain, yours to change:
       memory           eight bytes, all that the robot learns. memory_recall(&brain->memory, pattern) gives
                        SIDE_NOTHING, SIDE_LEFT or SIDE_RIGHT; memory_learn(&brain->memory, pattern, side) stores one
                        for pattern 1..7.
       changed          set it to true after each change of the memory, so that it is reported and stored
       own[0..7]        0..255 each, for whatever you like
       repeat_count     0..255, shown on the screen: the article's remembered turns in a row
       awaits           what your next call is to do first; the robot changes AWAITS_LOOK (1) to 0 if its wheels did
                        not obey
       tried_feel       the feel when a turn began that you will judge; the robot makes it 0 if its wheels did not
                        obey: then that turn teaches nothing
       tried_side       the side of that turn
   and to read:
       frozen           true: learn nothing now. A change of the memory is refused then. */

static inline struct action step(enum reason reason, int mm)
        /* A step forward of mm. */
{
    return (struct action){.reason = reason, .forward_mm = (int16_t)mm};
}

static inline struct action turn(enum reason reason, enum side side, int degrees)
        /* A turn to a side. */
{
    return (struct action){.reason = reason, .turn_deg = (int16_t)(side == SIDE_RIGHT ? degrees : -degrees)};
}

static inline int below(struct brain *brain, uint8_t n)
        /* A number from 0 to n - 1, drawn; n is 1..255. */
{
    return random_below(&brain->random, n);
}

static inline enum side any_side(struct brain *brain)
        /* SIDE_LEFT or SIDE_RIGHT, drawn. */
{
    return (enum side)(SIDE_LEFT + below(brain, 2));
}

void note(const char *text, long value);
        /* Prints "text value" at the end of the run: for finding mistakes. At most some 4,000 characters in a run;
           with --fast, in fleets and in comparisons it does nothing. */

#endif
