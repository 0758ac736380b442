#include "firmware/motion.h"

#include "firmware/pattern.h"

enum kind { REST, TURN, STEP };

enum {
    TURN_UNIT = 16384,                             /* of turn_left, for 0.1 mm of difference */
    TURN_LIMIT = 1000000000,                       /* of turn_left: far beyond any turn, and no sum overflows */
    TURN_PRECISION = 8,                            /* a turn ends within 1/8 degree */
    WAY_LIMIT = 16000,                             /* of way_left: likewise */
    WAY_PRECISION = 5,                             /* 0.25 mm, as the sum of two wheels' counts */
    COUNTS_PER_MM = 2 * ODOMETER_COUNTS_PER_MM,    /* of both wheels together */
    PATIENCE_TICKS = 25                            /* beyond twice the ticks that an action needs */
};

static int32_t magnitude(int32_t x)
{
    return x < 0 ? -x : x;
}

static int32_t clamped(int32_t x, int32_t limit)
{
    if (x > limit)
        return limit;
    return x < -limit ? -limit : x;
}

/* turn_left for one degree: track * pi / 180 in units. The constant, in 1/128, makes it exact to one in a million. */
static int32_t turn_per_degree(const struct config *config)
{
    return (int32_t)((config->value[WHEEL_TRACK_MM] * 366022u + 64u) / 128u);
}

static int32_t wheel_speed_turning(const struct config *config)
{
    return turn_per_degree(config) / 64 * config->value[TURN_SPEED_DEG_S] / (TURN_UNIT / 64 * COUNTS_PER_MM);
}

static int32_t counts_per_tick(const struct config *config, int32_t speed_mm_s)
{
    return speed_mm_s * COUNTS_PER_MM * config->value[TICK_MS] / 1000;
}

/* The wheel speed that covers counts in one tick, rounded, or the limit where that takes longer. */
static int16_t speed_for(int32_t counts, const struct config *config, int32_t limit_mm_s)
{
    int32_t per_mm_s = COUNTS_PER_MM * config->value[TICK_MS];
    int32_t rounding = counts < 0 ? -per_mm_s / 2 : per_mm_s / 2;

    return (int16_t)clamped((counts * 1000 + rounding) / per_mm_s, limit_mm_s);
}

/* How far a wrapping odometer went, forward positive; good for up to half its span between two ticks. */
static int32_t counts_between(uint16_t before, uint16_t now)
{
    int32_t moved = (now - before) & (ODOMETER_SPAN - 1);

    return moved < ODOMETER_SPAN / 2 ? moved : moved - ODOMETER_SPAN;
}

void motion_start(struct motion *motion)
{
    *motion = (struct motion){.kind = REST};
}

void motion_lift(struct motion *motion)
{
    motion->referenced = false;
}

void motion_track(struct motion *motion, const struct senses *senses)
{
    if (motion->referenced) {
        int32_t left = counts_between(motion->odometer_left, senses->odometer_left);
        int32_t right = counts_between(motion->odometer_right, senses->odometer_right);

        motion->turn_left = clamped(motion->turn_left - (left - right) * TURN_UNIT, TURN_LIMIT);
        motion->way_left = (int16_t)clamped(motion->way_left - (left + right), WAY_LIMIT);
    }
    motion->odometer_left = senses->odometer_left;
    motion->odometer_right = senses->odometer_right;
    motion->referenced = true;
    if (motion->ticks_left > 0)
        motion->ticks_left--;
}

bool motion_ended(const struct motion *motion, const struct config *config, const struct senses *senses)
{
    if (motion->ticks_left == 0)
        return true;
    if (motion->kind == TURN)
        return magnitude(motion->turn_left) <= turn_per_degree(config) / TURN_PRECISION;
    return motion->way_left <= WAY_PRECISION || pattern_of(senses->feel) != 0;
}

static enum kind kind_of(const struct action *action)
{
    if (action->turn_deg != 0)
        return TURN;
    return action->forward_mm != 0 ? STEP : REST;
}

/* Ticks to allow: twice what the action needs at full speed, and a little. */
static uint16_t patience(const struct motion *motion, const struct config *config)
{
    if (motion->kind == REST)
        return 1;
    if (motion->kind == STEP)
        return (uint16_t)(2 * motion->way_left / counts_per_tick(config, config->value[SPEED_MM_S]) + PATIENCE_TICKS);
    return (uint16_t)(2 * (magnitude(motion->turn_left) / TURN_UNIT)
                      / counts_per_tick(config, wheel_speed_turning(config)) + PATIENCE_TICKS);
}

void motion_begin(struct motion *motion, const struct config *config, const struct action *action)
{
    /* A turn that the wheels refused is not made up for: it would come as a surprise much later. */
    if (motion->kind == TURN && motion->ticks_left == 0)
        motion->turn_left = 0;
    motion->kind = (uint8_t)kind_of(action);
    motion->turn_left += action->turn_deg * turn_per_degree(config);
    motion->way_left = (int16_t)(action->forward_mm * COUNTS_PER_MM);
    motion->ticks_left = patience(motion, config);
}

void motion_drive(const struct motion *motion, const struct config *config, struct drive *drive)
{
    drive->left_mm_s = 0;
    drive->right_mm_s = 0;
    if (motion->kind == TURN) {
        drive->left_mm_s = speed_for(motion->turn_left / TURN_UNIT, config, wheel_speed_turning(config));
        drive->right_mm_s = (int16_t)-drive->left_mm_s;
    } else if (motion->kind == STEP) {
        drive->left_mm_s = speed_for(motion->way_left, config, config->value[SPEED_MM_S]);
        drive->right_mm_s = drive->left_mm_s;
    }
}
