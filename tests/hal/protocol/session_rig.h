/* session_rig.h: a session without an owner, and what a test has come to it. */
#ifndef OCTET_SESSION_RIG_H
#define OCTET_SESSION_RIG_H

#include "tests/test.h"
#include "hal/protocol/e2e.h"
#include "hal/protocol/session.h"

enum { OURS = 1, THEIRS = 2 };

extern struct session session;
extern enum result why;    /* the last command was refused */
extern unsigned missed;    /* before the last senses; 999: nobody said */

enum arrival command(enum opcode opcode, uint8_t counter, uint8_t owner);

enum arrival start(bool lockstep);
        /* From OURS, with counter 1, and the robot does it. */

enum arrival tick(unsigned ticks);
        /* Senses of that tick, with its counter. */

void refuses(enum result expected, enum opcode opcode, uint8_t counter, uint8_t owner);
        /* Such a command is refused with this reason. */

#endif
