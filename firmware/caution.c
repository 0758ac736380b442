#include "firmware/caution.h"

#include "firmware/pattern.h"

enum doing { NOTHING, TOUCHING, BACKING_OFF, LOOKING_ASIDE };

enum {
    BACK_OFF_MM = 20,
    AWAY_DEG = 40,         /* four remembered turns, or one trial */
    ASIDE_DEG = 24,        /* to the left, where the front-right sensor sees what the front one should, */
    ASIDE_EVERY_MM = 60,   /* at most: as far as it reaches */
    FRONT_RIGHT = 2,       /* of feel */
    FRONT = 4,
    FRONT_LEFT = 8
};

bool caution_stops(struct caution *caution, const struct senses *senses, bool forward)
{
    bool stops = senses->bump && forward && !caution->pressed;

    caution->pressed = caution->pressed && senses->bump;
    if (stops)
        caution->doing = TOUCHING;
    return stops;
}

static void expect(struct caution *caution)
{
    caution->ahead = true;
    caution->turned_deg = 0;
}

/* After turning toward what the next sensor showed, that is in front. */
void caution_see(struct caution *caution, uint8_t feel, bool blind)
{
    if (!blind)
        caution->blind_mm = 0;
    if (blind && (caution->beside & ~feel) != 0)
        expect(caution);
}

/* Chooses an action that comes before the brain's: a step back, or a turn aside and back. False: none. */
static bool acts(struct caution *caution, const struct senses *senses, struct action *action)
{
    enum doing done = (enum doing)caution->doing;

    *action = (struct action){.reason = REASON_AVOID, .rest_ticks = 1};
    caution->doing = NOTHING;
    if (done == BACKING_OFF)
        caution->pressed = senses->bump;
    if (done == TOUCHING) {
        caution->doing = BACKING_OFF;
        expect(caution);
        action->forward_mm = -BACK_OFF_MM;
    } else if (done == LOOKING_ASIDE) {
        action->turn_deg = ASIDE_DEG;
    } else if (caution->blind_mm >= ASIDE_EVERY_MM && pattern_of(senses->feel) == 0) {
        caution->doing = LOOKING_ASIDE;
        caution->blind_mm = 0;
        action->turn_deg = -ASIDE_DEG;
    } else {
        return false;
    }
    return true;
}

/* It is far enough if another step would be too far. */
static void drive_blind(struct caution *caution, int forward_mm)
{
    int driven = caution->blind_mm + forward_mm;

    caution->blind_mm = (uint8_t)(driven + forward_mm > ASIDE_EVERY_MM ? ASIDE_EVERY_MM : driven);
}

static void note(struct caution *caution, const struct action *action, uint8_t feel)
{
    int turned = caution->turned_deg + action->turn_deg;

    caution->ahead = caution->ahead && turned < AWAY_DEG && turned > -AWAY_DEG;
    caution->turned_deg = (int8_t)(caution->ahead ? turned : 0);
    caution->beside = 0;
    if (action->turn_deg != 0)
        caution->beside = feel & (action->turn_deg < 0 ? FRONT_LEFT : FRONT_RIGHT);
    if (action->forward_mm > 0)
        drive_blind(caution, action->forward_mm);
}

struct action caution_next(struct caution *caution, struct brain *brain, const struct config *config,
                           struct senses *senses)
{
    struct action action;

    if (caution->ahead)
        senses->feel |= FRONT;
    if (!acts(caution, senses, &action))
        action = brain_next(brain, config, senses);
    note(caution, &action, senses->feel);
    return action;
}
