/* hal.h: all that the robot asks of its body. Exactly one implementation is linked in.
 *
 * Results: 0 or a positive number is fine, a negative one is an enum hal_error. */
#ifndef OCTET_HAL_H
#define OCTET_HAL_H

#include <stdbool.h>
#include <stdint.h>

enum {
    CELL_COUNT = 8,            /* bytes of learned memory, one for each pattern of the front sensors */
    HAL_SILENCE_MS = 100,      /* without senses for so long, the wheels stop */
    HAL_LOCKSTEP_MS = 10000,   /* the same where the sender's clock rules, which may pause */
    ODOMETER_SPAN = 4096,      /* odometers count 0..4095 and wrap */
    ODOMETER_COUNTS_PER_MM = 10
};

/* What the body senses at one control tick. */
struct senses {
    uint16_t tick;            /* 0..4095, wraps */
    uint8_t feel;             /* proximity, one bit each: right 1, front-right 2, front 4, front-left 8, left 16 */
    bool bump;                /* the body touches an obstacle */
    bool look;                /* food is seen straight ahead */
    uint16_t beacon_mm;       /* distance from the middle of the body to that food; 0: none seen */
    uint16_t odometer_left;   /* 0.1 mm, forward counts up, wraps at ODOMETER_SPAN */
    uint16_t odometer_right;
};

/* Why the robot does what it does. */
enum reason {
    REASON_STOP,          /* told to stop, or left without senses */
    REASON_WANDER,        /* nothing in the way, no food in sight: a step forward */
    REASON_TOWARD_FOOD,   /* nothing in the way, food ahead: a step forward */
    REASON_LOOK_AROUND,   /* no food ahead: a small random turn */
    REASON_REMEMBERED,    /* blocked, and the memory knows a turn */
    REASON_TRIAL,         /* blocked, and nothing is known: a random turn to try */
    REASON_BOREDOM,       /* too many remembered turns in a row: about face */
    REASON_EAT            /* food within reach */
};

/* What the wheels are to do until the next tick. */
struct drive {
    uint16_t tick;            /* of the senses that this answers */
    int16_t left_mm_s;        /* -2047..2047, forward positive */
    int16_t right_mm_s;
    enum reason reason;
    uint8_t repeat_count;     /* remembered turns since the way was last clear; stays at 255 */
    uint8_t action;           /* one more for each new action, 0..127, wraps */
    bool eat;
};

enum opcode {
    OPCODE_STOP = 1,   /* wheels to rest, until start or resume; answered with a report */
    OPCODE_START,      /* begin with a profile's parameters and a seed; the memory stays */
    OPCODE_RESUME,     /* go on as before the stop */
    OPCODE_SET,        /* one parameter */
    OPCODE_WRITE,      /* cells of the memory */
    OPCODE_ERASE,      /* the whole memory */
    OPCODE_FREEZE      /* learn no more, or learn again */
};

struct command {
    enum opcode opcode;   /* values that are no enum opcode arrive too; the robot refuses them */
    uint8_t which;        /* start: profile. set: parameter. write: mask of cells. freeze: 1 or 0 */
    uint32_t value;       /* start: seed. set: value. write: two bits a cell, cell p at bit 2p */
};

enum result {
    RESULT_DONE,
    RESULT_UNKNOWN_COMMAND,
    RESULT_UNKNOWN_PROFILE,
    RESULT_UNKNOWN_PARAMETER,
    RESULT_OUT_OF_RANGE
};

/* What one tick or one command calls for: the parts that a flag marks. */
struct output {
    bool has_answer, has_report, has_memory, has_drive;   /* to be sent */
    bool store;                                           /* the memory has changed, and is to be stored */
    enum result answer;
    struct {
        bool running, frozen;
        uint8_t profile;
        uint16_t uptime_s;   /* robot time: counted in ticks, wraps */
    } report;
    uint8_t memory[CELL_COUNT];
    struct drive drive;
};

enum hal_input { HAL_SILENCE = 0, HAL_SENSES = 1, HAL_COMMAND = 2 };

struct input {
    struct senses senses;     /* filled with HAL_SENSES */
    struct command command;   /* filled with HAL_COMMAND */
};

enum hal_error {
    HAL_E_BODY = -1,     /* the body cannot be reached; said on the console where there is one */
    HAL_E_USAGE = -2,    /* the arguments make no sense; said on the console where there is one */
    HAL_E_CLOSED = -3,   /* the body is gone for good */
    HAL_E_STORE = -4     /* the memory could not be stored, or what is stored is no memory */
};

struct hal;   /* one body */

int hal_open(struct hal **hal, int argc, char *const argv[]);
        /* Gets the body ready, wheels at rest. 0, or HAL_E_USAGE or HAL_E_BODY with *hal untouched.
           argc is 0 where there is no command line. */

int hal_receive(struct hal *hal, struct input *in);
        /* Waits for the next senses or command, in the order in which they came. HAL_SENSES or HAL_COMMAND: that
           part of *in is filled. HAL_SILENCE: no senses for HAL_SILENCE_MS, said again after each such time.
           Frames that are stale, damaged or not ours are counted and skipped, and do not break the silence.
           Never waits longer than the silence limit. HAL_E_CLOSED ends the robot. */

int hal_send(struct hal *hal, const struct output *out);
        /* Sends the marked parts, the drive last. 0, also where the bus took too long and a frame was dropped and
           counted: the next tick brings a newer one. HAL_E_CLOSED as above. */

int hal_load(struct hal *hal, uint8_t memory[CELL_COUNT]);
        /* The memory as last stored. 1: filled. 0: none was ever stored. HAL_E_STORE: what is there is no memory;
           it is left as it is. memory is written to only with result 1. */

int hal_store(struct hal *hal, const uint8_t memory[CELL_COUNT]);
        /* All or nothing: after a loss of power inside, hal_load gives the old memory or the new one. 0, or
           HAL_E_STORE, counted, with the old one still there. A body that would need long puts it off until the next
           silence, when the wheels stand: 0, and until then hal_load gives the old one. */

uint32_t hal_entropy(struct hal *hal);
        /* A number that differs from one power-up to the next as well as this body can. Never fails. */

#endif
