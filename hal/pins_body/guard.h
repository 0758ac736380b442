/* guard.h: decides when the wheels must not turn, whatever the robot commands. */
#ifndef OCTET_GUARD_H
#define OCTET_GUARD_H

#include <stdbool.h>
#include <stdint.h>

enum {
    GUARD_SIDES = 2,
    GUARD_BATTERY_MV = 5600,     /* below this for 0.2 s: the battery is empty */
    GUARD_WRONG_DUTY = 12000,    /* of 65536: with more than this a motor turns the commanded way */
    GUARD_BEATS = 40             /* within 0.2 s, or its encoder counts the wrong way */
};

struct guard_look {
    uint16_t counts[GUARD_SIDES];
    uint32_t battery_mv;
    bool bumped, failed;
};

struct guard {
    int32_t duty[GUARD_SIDES];       /* of the motors, since the last check */
    uint16_t counts[GUARD_SIDES];
    uint8_t against[GUARD_SIDES];    /* checks in a row in which a wheel turned against its motor */
    uint8_t weak;                    /* checks in a row with a weak battery */
    bool known, bumped;
    bool forbids;
};   /* all 0: nothing is wrong */

bool guard_stops(struct guard *guard, const struct guard_look *look);
        /* Call every 5 ms. True: the wheels must stop now. After a bump they may be commanded again, to back off. */

bool guard_forbids(const struct guard *guard);
        /* Whether they must not turn until the next reset: the battery is empty, an encoder counts against its motor,
           or the bridge has failed. */

#endif
