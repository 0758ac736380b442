/* loop_rig.h: a loop of robots that answer as a test says, in a world whose space does. */
#ifndef OCTET_LOOP_RIG_H
#define OCTET_LOOP_RIG_H

#include "tests/test.h"
#include "host_sim/sim/native/loop.h"
#include "logged_lines.h"

enum { ROBOTS = 2, TICKS = 8, SENSES = 0x101, DRIVE = 0x041, FAULTS = 0x781, MEMORY = 0x681 };

/* A robot that answers as the test says. */
struct octet {
    enum reason reason;
    uint8_t action;
    bool eat;
    bool silent;
    uint8_t faults;        /* told each tick; 0: no report */
    bool tells_memory;     /* each tick */
    unsigned memories;     /* of others that were heard, */
    struct frame memory;   /* and the last of them */
    struct frame heard;
    struct frame answers[3];
};

extern struct octet octets[ROBOTS];
extern struct loop_robot robots[ROBOTS];
extern struct world world;
extern struct loop loop;
extern int16_t rows[ROBOTS][TICKS * ROW_COUNT];
extern double poses[ROBOTS][TICKS * LOOP_POSE];
extern char text[TICKS * ROBOTS * 20 * LOG_LINE_MAX];   /* the log */

struct frame drive_of(const struct octet *octet, uint8_t tick);
        /* The robot's answer to that tick. */

#endif
