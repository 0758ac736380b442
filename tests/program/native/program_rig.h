/* program_rig.h: a program and a robot's senses for it. */
#ifndef OCTET_PROGRAM_RIG_H
#define OCTET_PROGRAM_RIG_H

#include "host_sim/program/native/program.h"

extern struct program program;
extern struct brain brain;
extern struct config config;
extern struct senses senses;

void rig_reset(void);
        /* A robot as at its start, which senses nothing. */

struct action rig_begin(const char *text);
        /* Compiles a program, which must have no mistake, and runs it up to the first thing that it wants. */

struct action rig_next(void);
        /* That has been done: what comes next. */

double rig_value(const char *name);
        /* The value of a variable. */

void rig_fails(const char *text, unsigned line, const char *word, enum program_expected expected);
        /* This program is refused, or stops by itself, with this mistake. */

#endif
