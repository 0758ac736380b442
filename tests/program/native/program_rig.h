/* program_rig.h: a program, and the senses of its robot. */
#ifndef OCTET_PROGRAM_RIG_H
#define OCTET_PROGRAM_RIG_H

#include "host_sim/program/native/program.h"

extern struct program program;
extern struct brain brain;
extern struct config config;
extern struct senses senses;

void rig_reset(void);
        /* A robot at its start, without any sensor triggered. */

struct action rig_begin(const char *text);
        /* Compiles a program, which must have no mistake, and returns its first action. */

struct action rig_next(void);
        /* Returns the action after that. */

double rig_value(const char *name);
        /* The value of a variable. */

void rig_fails(const char *text, unsigned line, const char *word, enum program_expected expected);
        /* Checks that compiling or running a program fails with this mistake. */

#endif
