#include "firmware/motion/wheels.h"

/* The constant, track * pi / 180 in units of 1/128, makes it exact to one in a million. */
uint32_t wheels_turn_per_degree(const struct config *config)
{
    return (config->value[WHEEL_TRACK_MM] * 366022u + 64u) / 128u;
}

/* All divisions here are unsigned: on a small processor division is a library routine, and one kind is enough. */
uint32_t wheels_turning_mm_s(const struct config *config)
{
    return wheels_turn_per_degree(config) / 64 * config->value[TURN_SPEED_DEG_S]
        / (WHEELS_TURN_UNIT / 64 * WHEELS_COUNTS_PER_MM);
}

uint32_t wheels_fastest_mm_s(const struct config *config)
{
    uint32_t turning = wheels_turning_mm_s(config);

    return turning > config->value[SPEED_MM_S] ? turning : config->value[SPEED_MM_S];
}

uint32_t wheels_counts_at(uint32_t speed_mm_s, const struct config *config)
{
    return (speed_mm_s * WHEELS_COUNTS_PER_MM * config->value[TICK_MS] + 500u) / 1000u;
}

int32_t wheels_counts_between(uint16_t before, uint16_t now)
{
    return ((now - before + ODOMETER_SPAN / 2) & (ODOMETER_SPAN - 1)) - ODOMETER_SPAN / 2;
}

uint32_t wheels_magnitude(int32_t x)
{
    return (uint32_t)(x < 0 ? -x : x);
}

int32_t wheels_limited(int32_t x, int32_t limit)
{
    if (x > limit)
        return limit;
    return x < -limit ? -limit : x;
}
