/* motion.h: converts turns and steps to wheel speeds, tick by tick, with feedback from the odometers.
 *
 * Each turn makes up for the error of the one before, so that errors do not add up. */
#ifndef OCTET_MOTION_H
#define OCTET_MOTION_H

#include "firmware/brain.h"
#include "firmware/motion/odometry_backlog.h"

enum motion_kind { MOTION_REST, MOTION_STEP, MOTION_BACK, MOTION_TURN, MOTION_TURN_UNTIL_FOOD, MOTION_GLANCE };
        /* The kind of an action. Where a glance ends is not judged. */

/* A wheel since it last rolled farther than the odometer of a wheel that stands still may waver. */
struct standing {
    int8_t way;       /* rolled, 0.1 mm */
    uint8_t ticks;    /* of turns and steps; saturates above 2 s */
};

struct motion {
    int32_t turn_left;         /* still to turn, right positive: left wheel less right wheel, 0.1 mm / 16384 */
    int16_t way_left;          /* still to drive: left wheel plus right wheel, 0.1 mm */
    uint16_t odometer_left;    /* as of the last tick */
    uint16_t odometer_right;
    uint16_t ticks_left;       /* until the action is abandoned because the wheels do not obey */
    uint16_t pace_left;        /* rest of what a turn may command before it is not credible, 0.1 mm */
    uint16_t astray;           /* distance rolled against commands, less 3/4 of that rolled as commanded, 0.1 mm */
    uint8_t tick;              /* as of the last senses */
    uint8_t kind;              /* of the current action: an enum motion_kind */
    bool referenced;           /* the odometers above are valid */
    uint8_t rest_ticks;        /* rest still to come before the action ends */
    struct backlog apart;      /* left wheel less right wheel */
    struct backlog together;   /* left wheel plus right wheel */
    struct standing left;
    struct standing right;
};

void motion_start(struct motion *motion);
        /* Resets to rest, with no error to make up for. */

void motion_lift(struct motion *motion);
        /* Ignores what the wheels roll until the next motion_track. */

bool motion_is_credible(const struct motion *motion, const struct config *config, const struct senses *senses,
                        unsigned ticks);
        /* Whether the wheels can have rolled as far as the odometers say in this number of ticks since the last
           motion_track: at up to 13/8 of the highest speed ever commanded, for at most 5 ticks, since a body holds
           its last drive no longer. After a gap of several ticks, odometers that both restart at 0 are those of a
           restarted body, and not credible either. */

bool motion_gave_up(const struct motion *motion);
        /* Whether the action was abandoned: it has taken so long that the wheels cannot have obeyed, or one of them
           has stood still for 2 s of turns and steps, however many. */

bool motion_tells(const struct motion *motion);
        /* Whether the action is long enough to judge how well the wheels follow: a turn of some size. */

bool motion_is_denied(const struct motion *motion, const struct config *config);
        /* Whether the wheels failed to follow their commands up to the end of this action. One of these is true:
           - The action was abandoned.
           - It was a turn that needed commands for more than 7/4 of its arc plus 2 ticks at full speed, or whose
             wheels were slower than half of their speed after ten ticks: wheels or odometers do half of what they
             should, or follow far too late. If they do twice as much, they are not credible: see motion_is_credible.
           - Over any number of actions the wheels went astray by as far as both roll in 0.2 s: one wheel rolls less
             than 1/7 of the distance of the other. */

void motion_track(struct motion *motion, const struct senses *senses);
        /* Updates the state from the odometers. Call once for each senses. */

bool motion_ended(const struct motion *motion, const struct config *config, const struct senses *senses);
        /* Whether the action has ended: turned to within 1/8 degree or to food, or driven to within 0.25 mm, counting
           what wheels will still roll; stopped by an obstacle ahead; or abandoned. Also true before any action. */

bool motion_rest(struct motion *motion, const struct config *config);
        /* Begins the action's rest, if it is still to come, and returns whether it did. Call when motion_ended. */

void motion_begin(struct motion *motion, const struct config *config, const struct action *action);
        /* Starts a turn, a step, or one tick of rest. */

void motion_drive(struct motion *motion, const struct config *config, struct drive *drive);
        /* Sets the wheel speeds for this tick so that the action does not overshoot, or abandons it, too. */

#endif
