/* guard.h: when the wheels must not turn, whatever the robot wants. */
#ifndef OCTET_GUARD_H
#define OCTET_GUARD_H

#include <stdbool.h>
#include <stdint.h>

enum {
    GUARD_SIDES = 2,
    GUARD_BATTERY_MV = 5600,     /* less for 0.2 s: the battery is empty */
    GUARD_WRONG_DUTY = 12000,    /* of 65536: a motor that is pushed harder than this turns that way, */
    GUARD_BEATS = 40             /* 0.2 s later at the latest, or its encoder counts the wrong way */
};

struct guard_look {
    uint16_t counts[GUARD_SIDES];
    uint32_t battery_mv;
    bool bumped, failed;
};

struct guard {
    int32_t duty[GUARD_SIDES];       /* of the motors, since the last look */
    uint16_t counts[GUARD_SIDES];
    uint8_t against[GUARD_SIDES];    /* looks in a row in which a wheel turned against its motor */
    uint8_t weak;                    /* looks in a row with a weak battery */
    bool known, bumped;
    bool forbids;
};   /* all 0: nothing is wrong */

bool guard_stops(struct guard *guard, const struct guard_look *look);
        /* Once in 5 ms. True: the wheels must stop now. At a bump they may be told to turn again, to back off. */

bool guard_forbids(const struct guard *guard);
        /* They must not turn until the next reset: the battery is empty, an encoder counts against its motor, or the bridge has
           failed. */

#endif
