/* real_wheels.h: two wheels that follow their orders as motors do: late, through slack gears and within limits. */
#ifndef OCTET_REAL_WHEELS_H
#define OCTET_REAL_WHEELS_H

#include <stdint.h>

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

#endif
