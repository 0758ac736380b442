/* robot.h: a robot in any state, and any input for it. */
#ifndef OCTET_PROOF_ANY_ROBOT_H
#define OCTET_PROOF_ANY_ROBOT_H

#include "firmware/robot.h"
#include "tests/proof/any/any.h"

extern struct robot robot;
extern struct input in;
extern struct output out;

void take_any_input(void);
        /* Any senses, any part of another's memory, and any command but one that sets a parameter: config.c has those. */

void take_any_parameters(void);
        /* Each within its range. */

void take_any_state(void);
        /* Whether the robot can come to it or not. */

static inline void respond(enum input_kind kind)
{
    robot_respond(&robot, kind, &in, &out);
}

#endif
