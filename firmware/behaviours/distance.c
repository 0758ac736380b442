/* distance: the article's robot, but the nearer the obstacle, the bigger the remembered turn: TURN_DEG at the
 * sensors' maximum range, FARTHER_DEG more at the body, linear between, rounded to a degree. */
#include "firmware/behaviours/behaviour.h"

enum {
    REACH_OF_SENSORS_MM = 60,
    FARTHER_DEG = 20,
    MM_A_DEGREE = REACH_OF_SENSORS_MM / FARTHER_DEG
};

bool distance_begin(struct brain *brain)
{
    brain->wants_ranges = true;
    return true;
}

/* The nearest distance seen by the three front sensors; REACH_OF_SENSORS_MM if they see nothing, or none was sent. */
static int nearest_mm(const struct senses *senses)
{
    int nearest = REACH_OF_SENSORS_MM;

    for (unsigned i = 1; i < FEEL_COUNT - 1; i++)   /* the first and the last look to the sides */
        if (senses->range_mm[i] < nearest)
            nearest = senses->range_mm[i];
    return nearest;
}

struct action distance_next(struct brain *brain, const struct config *config, const struct senses *senses)
{
    struct action action = article_next(brain, config, senses);
    int farther_deg = (REACH_OF_SENSORS_MM - nearest_mm(senses) + MM_A_DEGREE / 2) / MM_A_DEGREE;

    if (action.reason == REASON_REMEMBERED)
        action.turn_deg = (int16_t)(action.turn_deg + (action.turn_deg > 0 ? farther_deg : -farther_deg));
    return action;
}
