/* wheel_run.h: a run of the robot on real wheels, on an open floor with something in front of it now and then. */
#ifndef OCTET_WHEEL_RUN_H
#define OCTET_WHEEL_RUN_H

#include <stdint.h>

#include "real_wheels.h"

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
