/* wheels.h: wheel distances and speeds in odometer counts. */
#ifndef OCTET_WHEELS_H
#define OCTET_WHEELS_H

#include "firmware/config.h"

enum {
    WHEELS_TURN_UNIT = 16384,                             /* parts of a count, for turns */
    WHEELS_COUNTS_PER_MM = 2 * ODOMETER_COUNTS_PER_MM     /* of both wheels together */
};

uint32_t wheels_turn_per_degree(const struct config *config);
        /* The difference between both wheels that turns the body by one degree, in 0.1 mm / WHEELS_TURN_UNIT. */

uint32_t wheels_turning_mm_s(const struct config *config);
        /* The speed of each wheel in a turn. */

uint32_t wheels_fastest_mm_s(const struct config *config);
        /* The highest speed ever commanded of a wheel. */

uint32_t wheels_counts_at(uint32_t speed_mm_s, const struct config *config);
        /* What both wheels together roll in a tick at this speed. */

int32_t wheels_counts_between(uint16_t before, uint16_t now);
        /* How far a wrapping odometer went, forward positive; good for up to half its span. */

uint32_t wheels_magnitude(int32_t x);

int32_t wheels_limited(int32_t x, int32_t limit);
        /* x clamped to -limit..limit. */

#endif
