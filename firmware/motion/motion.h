/* motion.h: turns and steps become wheel speeds, tick by tick, measured by the wheels' odometers.
 *
 * What a turn misses is made up for in the next one, so that errors do not add up. */
#ifndef OCTET_MOTION_H
#define OCTET_MOTION_H

#include "firmware/brain.h"
#include "firmware/motion/owed.h"

enum motion_kind { MOTION_REST, MOTION_STEP, MOTION_BACK, MOTION_TURN, MOTION_TURN_UNTIL_FOOD, MOTION_GLANCE };
        /* Of an action. Nothing is judged by where a glance ends. */

struct motion {
    int32_t turn_left;         /* still to turn, right positive: left wheel less right wheel, 0.1 mm / 16384 */
    int16_t way_left;          /* still to drive: left wheel plus right wheel, 0.1 mm */
    uint16_t odometer_left;    /* as of the last tick */
    uint16_t odometer_right;
    uint16_t ticks_left;       /* until the action is given up because the wheels do not obey */
    uint16_t pace_left;        /* what may be told in a turn until it is too much to be believed, 0.1 mm */
    uint16_t astray;           /* the way that the wheels rolled against orders, less 3/4 of what they rolled as told, 0.1 mm */
    uint8_t tick;              /* as of the last senses */
    uint8_t kind;              /* of the action under way: an enum motion_kind */
    bool referenced;           /* the odometers above are valid */
    struct owed apart;         /* left wheel less right wheel */
    struct owed together;      /* left wheel plus right wheel */
    uint8_t rest_ticks;        /* at rest after what is under way, before the action has ended */
};

void motion_start(struct motion *motion);
        /* At rest, with nothing to make up for. */

void motion_lift(struct motion *motion);
        /* Until the next motion_track the wheels may turn unnoticed: that does not count as the robot's way. */

bool motion_is_credible(const struct motion *motion, const struct config *config, const struct senses *senses,
                        unsigned ticks);
        /* Whether the wheels can have rolled as far as the odometers say in this number of ticks since the last motion_track:
           at up to 13/8 of the highest speed that they are ever told, and for 5 ticks at most, since a body holds its last
           drive no longer. After a gap of several ticks, odometers that both begin anew at 0 are those of a body that was
           restarted, and not credible either. */

bool motion_gave_up(const struct motion *motion);
        /* Whether the action has taken so long that the wheels cannot have obeyed. */

bool motion_tells(const struct motion *motion);
        /* Whether the action is long enough to tell how well the wheels follow: a turn of some size. */

bool motion_is_denied(const struct motion *motion, const struct config *config);
        /* Whether the wheels failed to do what they were told, up to the end of this action. One of these is true:
           - It was given up.
           - It was a turn that took orders for more than 7/4 of its way and 2 ticks at full speed, or wheels that made less
             than half of their speed after ten ticks: wheels or odometers make half of what they should, or follow far too
             late. Those that make twice as much are not credible: see motion_is_credible.
           - Over any number of actions the wheels went astray by as far as both roll in 0.2 s: one wheel makes less than
             1/7 of the other one's way. */

void motion_track(struct motion *motion, const struct senses *senses);
        /* Takes in what the wheels have done since the last tick. Call once for each senses. */

bool motion_ended(const struct motion *motion, const struct config *config, const struct senses *senses);
        /* Whether the action has ended: turned to within 1/8 degree or to food, driven to within 0.25 mm, with what the wheels
           still owe; stopped by an obstacle ahead, or given up. True before the first action, too. */

bool motion_rest(struct motion *motion, const struct config *config);
        /* Begins the rest that is part of the action, if there is one still to come. Call when motion_ended. */

void motion_begin(struct motion *motion, const struct config *config, const struct action *action);
        /* Starts a turn, a step, or one tick of rest. */

void motion_drive(struct motion *motion, const struct config *config, struct drive *drive);
        /* Sets the wheel speeds for this tick, so that the action ends without running over. */

#endif
