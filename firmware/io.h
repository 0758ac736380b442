/* io.h: the robot's inputs and outputs, tick by tick. */
#ifndef OCTET_IO_H
#define OCTET_IO_H

#include <stdbool.h>
#include <stdint.h>

#include "robot_words.h"

/* What the body senses at one control tick. */
struct senses {
    uint8_t tick;             /* wraps */
    uint8_t feel;             /* proximity, the sum of the FEEL_ bits */
    bool bump;                /* the body touches an obstacle */
    bool look;                /* food is seen straight ahead */
    uint16_t beacon_mm;       /* distance from the middle of the body to that food; 0: none seen */
    uint16_t odometer_left;   /* 0.1 mm, forward counts up, wraps at ODOMETER_SPAN */
    uint16_t odometer_right;
    uint8_t range_mm[FEEL_COUNT];   /* beyond the rim, by sensor as in feel; RANGE_NONE: out of reach, or not sent */
};

/* What the wheels are to do until the next tick. */
struct drive {
    uint8_t tick;             /* of the senses that this answers */
    int16_t left_mm_s;        /* -2047..2047, forward positive */
    int16_t right_mm_s;
    enum reason reason;
    uint8_t repeat_count;     /* remembered turns since the way was last clear; stays at 255 */
    uint8_t action;           /* counts actions, 0..ACTION_SPAN-1, wraps */
    bool eat;
};

struct command {
    enum opcode opcode;   /* may hold other values; the robot refuses them */
    uint8_t which;        /* start: profile. set, get: parameter. freeze: 1 or 0. write: bit 4 for the upper four
                             cells, bit i of 0..3 to write the i-th of the four */
    uint32_t value;       /* start: seed. set: value. write: a byte for each of the four cells, the first lowest */
};

/* Half of another robot's memory. */
struct peer {
    bool upper;                    /* the upper four cells, not the lower */
    uint8_t cell[CELL_COUNT / 2];
};

enum input_kind { INPUT_SILENCE = 0, INPUT_SENSES = 1, INPUT_COMMAND = 2, INPUT_PEER = 3 };

struct input {
    struct senses senses;     /* filled with INPUT_SENSES */
    struct command command;   /* filled with INPUT_COMMAND */
    struct peer peer;         /* filled with INPUT_PEER */
};

/* The state of the robot, reported once a second. */
struct report {
    bool running, frozen;
    uint8_t profile;
    uint16_t uptime_s;   /* robot time: counted in ticks, wraps */
};

/* What the robot answers to one input: the parts whose flag is set. */
struct output {
    bool has_answer, has_report, has_memory, has_drive;   /* to be sent */
    bool whole_report;                                    /* all of it now; else maybe spread over later outputs */
    bool silent;                                          /* the input was silence, not senses */
    bool contradiction;                                   /* the senses contradicted themselves */
    bool denied;                                          /* the wheels did not do what they were told */
    bool store;                                           /* the memory has changed: store it */
    enum result answer;
    uint32_t answer_value;                                /* get: the value. start: ANSWER_WANTS_RANGES or 0 */
    struct report report;                                 /* filled even without has_report, */
    uint8_t memory[CELL_COUNT];                           /* and this without has_memory */
    struct drive drive;
};

#endif
