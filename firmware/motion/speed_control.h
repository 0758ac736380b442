/* speed_control.h: speed control of one wheel by its encoder: feed-forward and PI in integers, every WHEEL_PERIOD_MS.
 *
 * The wheel follows a first-order model of 37 ms. Feed-forward drives the motor along it; PI corrects the position
 * error, so that the wheel finally rolls the commanded distance. The PI's zero cancels the motor's pole: what remains
 * is an integrator with crossover at 20 rad/s, phase margin 80 degrees, gain margin 20 dB at a delay of 7.5 ms. */
#ifndef OCTET_SPEED_CONTROL_H
#define OCTET_SPEED_CONTROL_H

#include <stdbool.h>
#include <stdint.h>

enum { WHEEL_PERIOD_MS = 5, WHEEL_NOMINAL_MV = 7200, WHEEL_DUTY_MAX = 62000 };

/* A motor of 674 mm/s at full duty and a dead band of 8 %, with a time constant of 60 ms; duties in 1/65536. */
enum { WHEEL_FORWARD = 97, WHEEL_DEAD = 5243, WHEEL_LAG_MS = 60, WHEEL_KP = 23, WHEEL_KI_16 = 31 };

struct wheel {
    int32_t model_256;    /* the model's speed, 1/256 um in a period */
    int32_t behind_um;    /* distance that the wheel is behind the model */
    int32_t rest_256;     /* remainder of the counted distance, 1/256 um */
    int32_t way_256;      /* rolled since the start, 1/256 um; wraps with the odometer */
    uint16_t count;       /* last reading of the encoder */
    bool known;
    int16_t forward_more, dead_more, lag_more_ms;   /* how its motor differs from the one above */
};   /* all 0: at rest */

int32_t wheel_run(struct wheel *wheel, uint16_t count, int16_t told_mm_s, uint32_t battery_mv);
        /* The duty for the next period, forward positive, at most WHEEL_DUTY_MAX either way. count: of the encoder,
           which wraps, WHEEL_COUNT_256 each. */

uint16_t wheel_odometer(const struct wheel *wheel);
        /* Distance rolled, as of the last period: 0.1 mm, forward counts up, wraps at ODOMETER_SPAN. */

enum { WHEEL_COUNT_256 = 23450 };   /* 91.6 um: 12 x 30 x 4 counts a turn of a wheel of 42 mm */

#endif
