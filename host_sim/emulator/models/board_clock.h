/* board_clock.h: the board's time, counted in core cycles, with timed events.
 * Python reads this header too. */
#ifndef OCTET_BOARD_CLOCK_H
#define OCTET_BOARD_CLOCK_H

#include <stdbool.h>
#include <stdint.h>

#include "host_sim/emulator/models/can_wire.h"

struct moment {
    uint64_t ns;   /* since power-up; the maximum means never */
    uint64_t fs;   /* in addition, less than a nanosecond */
};

struct board_clock {
    struct moment now;
    struct moment horizon;    /* when something is next due */
    uint64_t cycles;          /* of the core, since power-up */
    uint64_t period_fs;       /* length of a cycle */
    bool failed;              /* an event has failed: time stands still */
    struct can_wire *wire;    /* advanced whenever something is due; NULL: none */
    struct moment *alarms;    /* when each of Python's events is next due */
    unsigned alarm_count;
    void (*ring)(struct board_clock *clock, unsigned alarm);   /* runs that event, and sets its next alarm */
    void (*take)(struct board_clock *clock);     /* takes frames heard on the wire, or a controller's refusal */
};

bool moment_before(struct moment one, struct moment other);

void clock_expect(struct board_clock *clock, struct moment moment);
        /* Notes that something is due at a moment. */

void clock_settle(struct board_clock *clock);
        /* Runs all events that are due. */

void clock_execute(struct board_clock *clock, uint64_t cycles);
        /* Advances time by a number of cycles. */

void clock_skip_to(struct board_clock *clock, struct moment moment);
        /* Advances time while the core is idle, at most an hour, and stops at each event on the way. */

void clock_skip_to_event(struct board_clock *clock, uint64_t most_ns);
        /* Skips to the next event, by at most most_ns. */

#endif
