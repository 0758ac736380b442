/* robot.h: the whole robot in one struct: senses in, drive out, one tick at a time. Nothing here waits. Robots share nothing;
 * one thread at a time uses a robot. */
#ifndef OCTET_ROBOT_H
#define OCTET_ROBOT_H

#include "firmware/caution.h"
#include "firmware/motion/motion.h"
#include "firmware/perception.h"
#include "firmware/sharing.h"

struct robot {
    bool running;
    uint8_t reason;       /* of the action under way */
    uint8_t action;       /* its number, 0..127 */
    uint8_t silences;     /* since the last senses, counted 1..10 round and round; 0: none */
    uint8_t denials;      /* actions that the wheels did not carry out, less those that they did since; stays at 2, where the next
                             one stops the robot */
    bool turn_denied;     /* the last one of them was a turn that tells, so that only another such turn forgives it */
    uint8_t tick;         /* of the last senses */
    struct config config;
    struct perception perception;
    struct caution caution;
    struct sharing sharing;
    uint16_t part_ms;     /* of the second that has begun, with a start at the latest */
    uint16_t uptime_s;    /* robot time since power-up, counted in ticks, wraps */
    struct brain brain;
    struct motion motion;
};

void robot_init(struct robot *robot, uint32_t seed);
        /* Resets to the power-up state: stopped, nothing learned, the article's profile. */

void robot_step(struct robot *robot, const struct senses *senses, struct drive *drive);
        /* Runs one tick: fills *drive for these senses. A stopped robot's wheels rest. */

enum result robot_execute(struct robot *robot, const struct command *command, uint32_t *value);
        /* Executes one command, or returns why not and changes nothing. Sets *value if the answer has one. */

void robot_respond(struct robot *robot, enum input_kind kind, const struct input *in, struct output *out);
        /* Fills *out with the response to one input: a drive to senses, rest to silence, an answer to a command, nothing to
           another robot's memory; plus a report and the memory when they are due. */

#endif
