/* robot.h: the whole robot in one struct: senses in, drive out, one tick at a time. Nothing here waits. Robots share
 * no state; only one thread at a time may use a robot. */
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
    uint8_t silences;     /* since the last senses: 0 for none, then 1..10 cyclically */
    uint8_t denials;      /* actions that the wheels did not carry out, less those that they did since; stays at 2:
                             then the next one stops the robot */
    bool turn_denied;     /* the last of these was a turn long enough to judge: only another such turn clears it */
    uint8_t tick;         /* of the last senses */
    struct config config;
    struct perception perception;
    struct caution caution;
    struct sharing sharing;
    uint16_t part_ms;     /* of the current second; a start begins a new one */
    uint16_t uptime_s;    /* robot time since power-up, counted in ticks, wraps */
    struct brain brain;
    struct motion motion;
};

void robot_init(struct robot *robot, uint32_t seed);
        /* Resets to the power-up state: stopped, nothing learned, the article's profile. */

void robot_step(struct robot *robot, const struct senses *senses, struct drive *drive);
        /* Runs one tick: fills *drive for these senses. Wheels of a stopped robot stay at rest. */

enum result robot_execute(struct robot *robot, const struct command *command, uint32_t *value);
        /* Executes one command, or returns why not and changes nothing. Sets *value if the answer has one. */

void robot_respond(struct robot *robot, enum input_kind kind, const struct input *in, struct output *out);
        /* Fills *out with the response to one input: a drive to senses, rest to silence, an answer to a command,
           nothing to another robot's memory; plus a report and the memory when they are due. */

#endif
