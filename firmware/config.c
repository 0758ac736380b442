#include "firmware/config.h"

/* A byte holds each: that makes the whole robot 64 bytes. */
static const struct {
    uint8_t min, max;
} ranges[PARAMETER_COUNT] = {
    [TURN_DEG] = {1, 180},
    [TRIAL_DEG] = {1, 180},
    [STEP_MM] = {1, 250},
    [LOOK_MIN_DEG] = {1, 90},
    [LOOK_CHOICES] = {1, 90},
    [REACH_MM] = {1, 250},
    [BOREDOM_LIMIT] = {1, 254},
    [BOREDOM_MIN_DEG] = {1, 180},
    [BOREDOM_CHOICES] = {1, 180},
    [SPEED_MM_S] = {20, 250},
    [TURN_SPEED_DEG_S] = {30, 250},
    [WHEEL_TRACK_MM] = {80, 250},
    [TICK_MS] = {10, 100},
};

/* Each profile a row, complete: what it does can be read off here. */
static const struct config profiles[PROFILE_COUNT] = {
    [PROFILE_ARTICLE] = {{
        [TURN_DEG] = 10,
        [TRIAL_DEG] = 45,
        [STEP_MM] = 12,
        [LOOK_MIN_DEG] = 2,
        [LOOK_CHOICES] = 10,
        [REACH_MM] = 150,
        [BOREDOM_LIMIT] = 10,
        [BOREDOM_MIN_DEG] = 150,
        [BOREDOM_CHOICES] = 60,
        [SPEED_MM_S] = 200,
        [TURN_SPEED_DEG_S] = 180,
        [WHEEL_TRACK_MM] = 160,
        [TICK_MS] = 20,
    }},
};

bool config_load(struct config *config, uint8_t profile)
{
    if (profile >= PROFILE_COUNT)
        return false;
    *config = profiles[profile];
    return true;
}

bool config_fits(uint8_t parameter, uint32_t value)
{
    return value >= ranges[parameter].min && value <= ranges[parameter].max;
}

void config_set(struct config *config, uint8_t parameter, uint8_t value)
{
    config->value[parameter] = value;
}
