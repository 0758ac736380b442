/* robot.h: the whole robot in one struct: senses in, drive out, one tick at a time. */
#ifndef OCTET_ROBOT_H
#define OCTET_ROBOT_H

#include "firmware/motion.h"

struct robot {
    struct config config;
    struct brain brain;
    struct motion motion;
    uint32_t ticks;       /* since power-up, wraps */
    uint16_t tick;        /* of the last senses */
    uint8_t silences;     /* in a row */
    uint8_t profile;
    uint8_t reason;       /* of the action under way */
    uint8_t action;       /* its number, 0..127 */
    bool running;
};

void robot_init(struct robot *robot, uint32_t seed);
        /* As after power-up: stopped, nothing learned, the article's profile. */

void robot_step(struct robot *robot, const struct senses *senses, struct drive *drive);
        /* One tick: fills *drive for these senses. A stopped robot's wheels rest. */

enum result robot_obey(struct robot *robot, const struct command *command);
        /* Carries out one command, or says why not and changes nothing. */

void robot_respond(struct robot *robot, enum hal_input kind, const struct input *in, struct output *out);
        /* Fills *out with all that one input calls for: the drive for senses, rest for silence, the answer to a
           command, and a report and the memory whenever they are due. */

#endif
