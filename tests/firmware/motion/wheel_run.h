/* wheel_run.h: a run of the robot on real wheels, on an open floor with something in front of it now and then. */
#ifndef OCTET_WHEEL_RUN_H
#define OCTET_WHEEL_RUN_H

#include <stdint.h>

/* Two wheels that follow their orders as motors do: late, through slack gears and within limits. */

enum { DELAY_MAX = 8 };

struct wheel_traits {
    double lag_ms;         /* time constant of the first order in which speed follows its order; 0: at once */
    double dead_mm_s;      /* slower orders do not move a wheel */
    double slack_mm;       /* of the gears, at the wheel's rim: the odometer, at the motor, counts it as way */
    double fastest_mm_s;   /* 0: any speed */
    double accel_mm_s2;    /* 0: at once */
    double gain;           /* a wheel makes this part of its order */
    int delay_ticks;       /* 0..DELAY_MAX: until an order arrives */
};

struct real_wheel {
    double speed_mm_s, motor_mm, rim_mm;   /* rolled by the motor and by the rim; the rim lags by half the slack at most */
    int16_t orders[DELAY_MAX + 1];         /* the newest first */
};

void real_wheel_turn(struct real_wheel *wheel, const struct wheel_traits *traits, int16_t order_mm_s, unsigned tick_ms);
        /* One tick with this order given at its beginning. */

uint16_t real_wheel_counts(const struct real_wheel *wheel);
        /* What the odometer shows. */

struct wheel_figures {
    int32_t actions, denied;
    int32_t stopped_tick;   /* -1: never */
    int32_t lessons;        /* cells that are not empty in the end */
    double over_deg;        /* the farthest beyond the end of a turn, or beyond where wheels that still rolled would have come */
    double left_deg;        /* the greatest that a turn which is judged left, by the odometers, when it had ended */
    double passed_deg;      /* the greatest that was left to turn when the step after a turn had ended */
    double slack_deg;       /* the greatest that the body was off where left_deg is measured, with what its gears hide */
    double way_mm;          /* rolled in all */
};

struct wheel_figures wheel_run(uint8_t profile, uint32_t seed, int32_t ticks, const struct wheel_traits *traits);
        /* All figures of a run from a START on, in ticks of 20 ms. */

#endif
