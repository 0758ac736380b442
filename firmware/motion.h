/* motion.h: turns and steps become wheel speeds, tick by tick, measured by the wheels' odometers.
 *
 * What a turn misses is made up for in the next one, so that errors do not add up. */
#ifndef OCTET_MOTION_H
#define OCTET_MOTION_H

#include "firmware/brain.h"

struct motion {
    int32_t turn_left;         /* still to turn, right positive: left wheel less right wheel, 0.1 mm / 16384 */
    int16_t way_left;          /* still to drive: left wheel plus right wheel, 0.1 mm */
    uint16_t odometer_left;    /* as of the last tick */
    uint16_t odometer_right;
    uint16_t ticks_left;       /* then the action is given up: the wheels do not obey */
    uint16_t pace_left;        /* ticks: then the turn has taken too long to be believed */
    uint16_t astray;           /* what the wheels made that they were not told, less 3/4 of what they were, 0.1 mm */
    uint8_t tick;              /* as of the last senses */
    uint8_t kind;              /* what is under way */
    bool referenced;           /* the odometers above hold */
    uint8_t rest_ticks;        /* at rest after what is under way, before the action has ended */
};

void motion_start(struct motion *motion);
        /* At rest, with nothing to make up for. */

void motion_lift(struct motion *motion);
        /* The wheels may turn unseen from here to the next motion_track: that is not the robot's way. */

bool motion_is_credible(const struct motion *motion, const struct config *config, const struct senses *senses,
                        unsigned ticks);
        /* Whether wheels can have turned as far as the odometers say, in this number of ticks since the last motion_track: 13/8 of
           the fastest that they are ever told. */

bool motion_gave_up(const struct motion *motion);
        /* Whether the action has taken so long that the wheels cannot have obeyed. */

bool motion_is_denied(const struct motion *motion, const struct config *config);
        /* Whether the wheels have not done what they were told in the action that has ended: it was given up; or it was a
           turn that took 7/4 of its time at full speed and more than 6 ticks beyond that: wheels or odometers make half
           of what they should. Those that make twice as much are not credible, see there. Or the wheels have gone astray
           for as far as both roll in 0.2 s, over any number of actions: one makes less than 1/7 of the other one's way. */

void motion_track(struct motion *motion, const struct senses *senses);
        /* Takes in what the wheels have done since the last tick. Call once for each senses. */

bool motion_ended(const struct motion *motion, const struct config *config, const struct senses *senses);
        /* Is the action done with: turned to within 1/8 degree or to food, driven to within 0.25 mm, stopped by an
           obstacle ahead, or given up? True before the first action, too. */

bool motion_rest(struct motion *motion, const struct config *config);
        /* Begins the rest that is part of the action, if there is one still to come. Call when motion_ended. */

void motion_begin(struct motion *motion, const struct config *config, const struct action *action);
        /* Starts a turn, a step, or one tick of rest. */

void motion_drive(const struct motion *motion, const struct config *config, struct drive *drive);
        /* Sets the wheel speeds for this tick, so that the action ends without running over. */

#endif
