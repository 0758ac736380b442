/* config.h: the numbers that a robot is set up with, each with its range, and the profiles that name sets of them. */
#ifndef OCTET_CONFIG_H
#define OCTET_CONFIG_H

#include <stdbool.h>
#include <stdint.h>

enum parameter {
    TURN_DEG,           /* a remembered turn */
    TRIAL_DEG,          /* a turn to try */
    STEP_MM,            /* a step forward */
    LOOK_MIN_DEG,       /* looking around: the smallest turn, */
    LOOK_CHOICES,       /* and how many sizes from there on, one degree apart */
    REACH_MM,           /* food nearer than this is eaten */
    BOREDOM_LIMIT,      /* the remembered turn in a row that bores */
    BOREDOM_MIN_DEG,    /* about face: the smallest turn, */
    BOREDOM_CHOICES,    /* and how many sizes from there on, one degree apart */
    SPEED_MM_S,         /* of a wheel, driving forward */
    TURN_SPEED_DEG_S,   /* of the body, turning in place */
    WHEEL_TRACK_MM,     /* from wheel to wheel */
    TICK_MS,            /* from one senses to the next */
    PARAMETER_COUNT
};

struct config {
    uint8_t value[PARAMETER_COUNT];
};

enum profile { PROFILE_ARTICLE, PROFILE_COUNT };

bool config_load(struct config *config, uint8_t profile);
        /* Sets all parameters as the profile has them. False, and nothing is changed, if there is no such profile. */

bool config_fits(uint8_t parameter, uint32_t value);
        /* Is value within the range of parameter 0..PARAMETER_COUNT-1? */

void config_set(struct config *config, uint8_t parameter, uint8_t value);
        /* Sets a parameter to a value that fits. */

#endif
