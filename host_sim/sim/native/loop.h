/* loop.h: robots of this process in their world, a block of ticks at a time.
 *
 * Simulation.step in host_sim/sim/simulation.py is the readable reference. Here the same happens in the same order, with
 * the same frames: the robots hear and answer by the wire's own codec. The caller provides all memory. */
#ifndef OCTET_LOOP_H
#define OCTET_LOOP_H

#include "hal/link/link.h"
#include "host_sim/sim/native/log_lines.h"
#include "host_sim/world/native/body_faults.h"
#include "host_sim/world/native/world.h"

struct octet;   /* a robot as a library call: hal/library/exchange.h */

enum {
    LOOP_FRAMES_MAX = 16,    /* that a robot answers in one tick */
    LOOP_KINDS_MAX = 32,     /* of reports of one robot: an identifier, and which page of it */
    LOOP_REASONS = 16,
    LOOP_ROW = 17,           /* numbers that are recorded of each tick: the senses, the drive, the pattern, lifted, 0 */
    LOOP_POSE = 3
};

struct loop_robot {
    struct octet *octet;
    uint32_t senses_id;
    uint32_t drive_id;
    uint32_t heartbeat_id;
    uint8_t senses_counter;           /* of the last SENSES */
    struct body_faults faults;        /* what is wrong with its body */
    bool begun_any;                   /* an action has begun, with this pattern: */
    uint8_t pattern;
    uint8_t action;                   /* the last drive's */
    uint8_t reason;
    uint32_t begun[LOOP_REASONS];     /* actions begun, by reason */
    uint32_t food_eaten;
    const struct frame *waiting;      /* what it said before the block, to be taken in its first tick */
    size_t waiting_count;
    uint32_t received;                /* frames from the robot, */
    uint32_t refused;                 /* and drives that answer other senses */
    size_t answer_count;              /* in this tick */
    struct frame drive;               /* its last DRIVE */
    struct frame known[LOOP_KINDS_MAX];     /* the last report of each kind */
    size_t known_count;
    struct frame reports[LOOP_FRAMES_MAX];  /* of the last tick, */
    size_t report_count;
    bool has_news;                          /* and whether one of them says something new */
    int16_t *rows;                    /* LOOP_ROW for each tick of the block */
    double *poses;                    /* x and y in mm and heading in rad, after each tick */
    uint32_t *decisions;              /* ticks of the block in which a remembered turn or a trial began, or ended a trial */
    size_t decision_count;
};

struct loop {
    size_t (*exchange)(struct octet *octet, const struct frame *in);
    const struct frame *(*answers)(const struct octet *octet);
    struct world *world;
    size_t robot_count;               /* as many as the world has bodies */
    struct loop_robot *robots;
    uint32_t tick;                    /* number of the next tick */
    uint32_t ticks;                   /* done in the block */
    struct log_lines log;             /* without text: nothing is logged */
    size_t log_size;
    int32_t silent;                   /* the robot that did not answer; -1: none */
};

void loop_run(struct loop *loop, uint32_t ticks_max);
        /* Runs a block of ticks. The log must have room for one tick's lines. It ends earlier after a tick in
           which food was eaten or a robot reported something new, when the log is full, and when a robot does not answer;
           that tick is not counted. */

#endif
