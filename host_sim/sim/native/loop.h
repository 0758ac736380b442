/* loop.h: robots in their world, a block of ticks at a time.
 *
 * Simulation.step in host_sim/sim/simulation.py is the readable reference. This does the same in the same order, with
 * the same frames: the robots use the wire's own codec. The caller provides all memory.
 *
 * A robot is in this process, or behind a link. For a robot behind a link, this handles only the common case: the
 * drive that answers its senses, and reports that say nothing new. Anything else, or a timeout, hands the unfinished
 * tick to the caller: the rules of a session are in host_sim/client/. */
#ifndef OCTET_LOOP_H
#define OCTET_LOOP_H

#include "hal/link/link.h"
#include "host_sim/sim/native/log_lines.h"
#include "host_sim/world/native/world.h"

struct octet;   /* a robot as a library call: hal/library/exchange.h */

enum {
    LOOP_FRAMES_MAX = 16,    /* that a robot answers in one tick */
    LOOP_ASK_LINES = 32,     /* of the log, in which ask asks one robot */
    LOOP_KINDS_MAX = 32,     /* of reports of one robot: an identifier, and which page of it */
    LOOP_REASONS = 16,
    LOOP_HEARD = 16,         /* checks over senses that are kept */
    LOOP_POSE = 3
};

struct loop_robot {
    struct octet *octet;              /* in this process, */
    struct link *link;                /* or behind this */
    uint32_t senses_id;
    uint32_t drive_id;
    uint32_t heartbeat_id;
    uint32_t health_id;
    uint8_t senses_counter;           /* of the last SENSES */
    struct frame senses;              /* the last SENSES */
    uint32_t commands;                /* the check in HEALTH's held over what it was told before the block, */
    uint32_t heard[LOOP_HEARD];       /* and over the senses that it has answered; the last is at heard_count - 1, */
    uint32_t heard_count;             /* modulo LOOP_HEARD. 1 at least */
    uint8_t driven[8];                /* the last answer to them; zeros for none */
    bool halted;                      /* it has stopped by itself, and answers with drives at rest */
    uint8_t action;                   /* the last drive's */
    uint32_t begun[LOOP_REASONS];     /* actions begun, by reason */
    uint32_t food_eaten;
    const struct frame *waiting;      /* frames sent before the block, to be taken in its first tick */
    size_t waiting_count;
    uint32_t received;                /* frames from the robot, */
    uint32_t refused;                 /* and drives that answer other senses */
    size_t answer_count;              /* in this tick */
    struct frame drive;               /* its last DRIVE */
    struct frame known[LOOP_KINDS_MAX];     /* the last report of each kind */
    uint32_t told[LOOP_KINDS_MAX];          /* behind a link: which of the block's received frames it was; 0: none */
    size_t known_count;
    struct frame reports[LOOP_FRAMES_MAX];  /* of the last tick, */
    size_t report_count;
    bool has_news;                          /* and whether one of them says something new */
    int16_t *rows;                    /* ROW_COUNT numbers for each tick of the block; the last three: 0, lifted, 0 */
    double *poses;                    /* x and y in mm and heading in rad, after each tick */
};

struct turn;   /* turn.h */

struct loop {
    bool (*take_turns)(struct loop *loop, struct turn *turns);   /* one of those below; null: turns_in_process */
    uint32_t wait_ms;                 /* for a frame over a link */
    size_t (*exchange)(struct octet *octet, const struct frame *in);
    const struct frame *(*answers)(const struct octet *octet);
    bool (*ask)(struct loop *loop, size_t robot);   /* asks one in this process that has stopped by itself how it
                                                       is, and logs that in up to LOOP_ASK_LINES; false: it has not.
                                                       null: its tick is handed over */
    struct world *world;
    size_t robot_count;               /* as many as the world has bodies */
    struct loop_robot *robots;
    uint32_t tick;                    /* number of the next tick */
    uint32_t ticks;                   /* done in the block */
    struct log_lines log;             /* without text: nothing is logged */
    size_t log_size;
    bool handed_over;                 /* the next tick has begun, but is left to the caller: */
    size_t sent;                      /* robots that got their senses, */
    size_t answered;                  /* robots whose drives have arrived, */
    int received;                     /* and what link_receive returned for the next one; if 1, this frame */
    struct frame in_hand;
};

void loop_run(struct loop *loop, uint32_t ticks_max);
        /* Runs a block of ticks. The log must have room for one tick's lines. It ends earlier after a tick in
           which food was eaten or a robot reported something new, when the log is full, and when a tick is handed
           over, which is not counted. In this process, that is one in which a robot does not answer. */

bool turns_in_process(struct loop *loop, struct turn *turns);
        /* Sends each robot its senses, then receives the answers. False: hand the tick over. */

bool turns_over_links(struct loop *loop, struct turn *turns);
        /* The same for robots behind links. */

void loop_record(struct loop *loop);
        /* Counts and records one more tick of the block, which the caller has completed. The first numbers of its
           rows, up to the drive's, and the bodies' poses after it are already set. */

#endif
