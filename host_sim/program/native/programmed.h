/* programmed.h: a robot whose brain is a program: the firmware with another brain linked in. It is used like any
 * struct octet of hal/library/exchange.h. */
#ifndef OCTET_PROGRAMMED_H
#define OCTET_PROGRAMMED_H

#include "hal/library/exchange.h"
#include "host_sim/program/native/program.h"

struct programmed {
    struct octet octet;
    struct program program;
};

struct octet *programmed_open(uint8_t node, const uint8_t memory[CELL_COUNT], const char *text, size_t len);
        /* As octet_open, with a program. If the program has a mistake, the robot rests. octet_close frees it. */

const struct program *programmed_state(const struct octet *octet);
        /* The program of a robot that programmed_open has opened. */

enum { PROGRAMMED_TOLD_MAX = 1024 };

void programmed_tell(const struct program *program, char told[PROGRAMMED_TOLD_MAX]);
        /* The state of a program in one line for people: its mistake, that it has ended, what it shows. */

const char *programmed_printed(const struct program *program);
        /* The first bytes of what it has printed, in lines. */

struct program *programmed_program(struct brain *brain);
        /* The program that is this brain. Exactly one implementation is linked in. */

void programmed_decided(const struct program *program);
        /* Called after each decision. Linked in likewise. */

void programmed_robot_respond(struct robot *robot, enum input_kind kind, const struct input *in, struct output *out);
        /* robot_respond of a robot with a program. */

#endif
