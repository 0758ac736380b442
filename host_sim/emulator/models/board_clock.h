/* board_clock.h: the board's time, counted in cycles of the core. Events happen as time passes them.
 * Python reads this header too. */
#ifndef OCTET_BOARD_CLOCK_H
#define OCTET_BOARD_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#include "host_sim/emulator/models/can_wire.h"

struct moment {
    uint64_t ns;   /* since power-up; the greatest is never */
    uint64_t fs;   /* in addition, less than a nanosecond */
};

struct board_clock {
    struct moment now;
    struct moment horizon;    /* when something is next due */
    uint64_t cycles;          /* of the core, since power-up */
    uint64_t period_fs;       /* length of a cycle */
    bool failed;              /* something that was due has failed: no more time passes */
    struct can_wire *wire;    /* moved on whenever something is due; NULL: there is none */
    struct moment *alarms;    /* when each of Python's events is next due */
    unsigned alarm_count;
    void (*ring)(struct board_clock *clock, unsigned alarm);   /* lets that event happen, and sets its alarm anew */
    void (*take)(struct board_clock *clock);     /* takes what was heard on the wire, or what a controller refused */
};

bool moment_before(struct moment one, struct moment other);

void clock_expect(struct board_clock *clock, struct moment moment);
        /* Notes that something new is due at a moment. */

void clock_settle(struct board_clock *clock);
        /* Makes all events happen that are due. */

void clock_execute(struct board_clock *clock, uint64_t cycles);
        /* Lets time pass: that of a number of cycles. */

void clock_skip_to(struct board_clock *clock, struct moment moment);
        /* Lets time pass in which the core does nothing, at most an hour, and stops at each event on the way. */

void clock_skip_to_event(struct board_clock *clock, uint64_t most_ns);
        /* Skips to the next event, by most_ns at the most. */

#endif
