#include "firmware/motion.h"

#include "firmware/pattern.h"

enum kind { REST, STEP, TURN, TURN_UNTIL_FOOD };

enum {
    TURN_UNIT = 16384,                             /* of turn_left, for 0.1 mm of difference */
    TURN_LIMIT = 1000000000,                       /* of turn_left: far beyond any turn, and no sum overflows */
    TURN_PRECISION = 8,                            /* a turn ends within 1/8 degree */
    WAY_LIMIT = 16000,                             /* of way_left: likewise */
    WAY_PRECISION = 5,                             /* 0.25 mm, as the sum of two wheels' counts */
    COUNTS_PER_MM = 2 * ODOMETER_COUNTS_PER_MM,    /* of both wheels together */
    TIMEOUT_MARGIN_TICKS = 25,                     /* beyond twice the ticks that an action needs */
    ANY_PACE = UINT16_MAX,                         /* of pace_left: never used up */
    PACE_MARGIN_TICKS = 7,                         /* for drives that come late and for the end, which is slower */
    HOLD_TICKS = 5,                                /* without a new drive, a body goes on for this long and then rests */
    ASTRAY_PER_S = 5,                              /* wheels may go astray as far as they both roll in 1/5 second */
    CREDIBLE_EIGHTHS = 13,                         /* of the fastest that a wheel is told, it may be seen to roll, */
    CREDIBLE_COUNTS = 2,                           /* and so much more, in fewer ticks than a count takes */
    RESTART_COUNTS = 8                             /* a body that was restarted has rolled no farther when it is heard again */
};

static bool is_turn(const struct motion *motion)
{
    return motion->kind >= TURN;
}

static uint32_t magnitude(int32_t x)
{
    return (uint32_t)(x < 0 ? -x : x);
}

static int32_t clamped(int32_t x, int32_t limit)
{
    if (x > limit)
        return limit;
    return x < -limit ? -limit : x;
}

/* turn_left for one degree: track * pi / 180 in units. The constant, in 1/128, makes it exact to one in a million. */
static uint32_t turn_per_degree(const struct config *config)
{
    return (config->value[WHEEL_TRACK_MM] * 366022u + 64u) / 128u;
}

/* Divisions here are unsigned throughout: a small processor has to bring its own, and one kind is enough. */
static uint32_t wheel_speed_turning(const struct config *config)
{
    return turn_per_degree(config) / 64 * config->value[TURN_SPEED_DEG_S] / (TURN_UNIT / 64 * COUNTS_PER_MM);
}

/* The highest speed of each wheel in the current action, mm/s. */
static uint32_t full_speed(const struct motion *motion, const struct config *config)
{
    return is_turn(motion) ? wheel_speed_turning(config) : config->value[SPEED_MM_S];
}

/* What is left of the current action: the counts of both wheels together, right or forward positive. */
static int32_t counts_left(const struct motion *motion)
{
    if (motion->kind == REST)
        return 0;
    if (is_turn(motion))
        return motion->turn_left / TURN_UNIT;
    return motion->way_left;
}

/* The wheel speed that covers counts in one tick, rounded, or the limit where that takes longer. */
static int16_t speed_for(int32_t counts, const struct config *config, uint32_t limit_mm_s)
{
    uint32_t per_mm_s = (uint32_t)COUNTS_PER_MM * config->value[TICK_MS];
    uint32_t speed = (magnitude(counts) * 1000 + per_mm_s / 2) / per_mm_s;

    if (speed > limit_mm_s)
        speed = limit_mm_s;
    return (int16_t)(counts < 0 ? -(int32_t)speed : (int32_t)speed);
}

/* How far a wrapping odometer went, forward positive; good for up to half its span between two ticks. */
static int32_t counts_between(uint16_t before, uint16_t now)
{
    int32_t moved = (now - before) & (ODOMETER_SPAN - 1);

    return moved < ODOMETER_SPAN / 2 ? moved : moved - ODOMETER_SPAN;
}

void motion_start(struct motion *motion)
{
    *motion = (struct motion){.kind = REST, .pace_left = ANY_PACE};
}

void motion_lift(struct motion *motion)
{
    motion->referenced = false;
}

static uint32_t fastest_mm_s(const struct config *config)
{
    uint32_t turning = wheel_speed_turning(config);

    return turning > config->value[SPEED_MM_S] ? turning : config->value[SPEED_MM_S];
}

/* A body that was restarted counts from 0. */
static bool is_near_0(uint16_t left, uint16_t right)
{
    return magnitude(counts_between(0, left)) <= RESTART_COUNTS && magnitude(counts_between(0, right)) <= RESTART_COUNTS;
}

/* Odometers that jump do not measure: the body was reset, or counts too much. */
bool motion_is_credible(const struct motion *motion, const struct config *config, const struct senses *senses,
                        unsigned ticks)
{
    unsigned rolling = ticks < HOLD_TICKS ? ticks : HOLD_TICKS;
    uint32_t way = rolling * config->value[TICK_MS] * fastest_mm_s(config) * ODOMETER_COUNTS_PER_MM / 1000u;
    uint32_t farthest = way * CREDIBLE_EIGHTHS / 8u + CREDIBLE_COUNTS;

    if (!motion->referenced)
        return true;
    if (ticks > 1 && is_near_0(senses->odometer_left, senses->odometer_right)
        && !is_near_0(motion->odometer_left, motion->odometer_right))
        return false;
    return magnitude(counts_between(motion->odometer_left, senses->odometer_left)) <= farthest
        && magnitude(counts_between(motion->odometer_right, senses->odometer_right)) <= farthest;
}

bool motion_gave_up(const struct motion *motion)
{
    return motion->kind != REST && motion->ticks_left == 0;
}

/* Twice as far as a body rolls on at full speed after its last drive. */
static uint16_t astray_limit(const struct config *config)
{
    return (uint16_t)(fastest_mm_s(config) * COUNTS_PER_MM / ASTRAY_PER_S);
}

bool motion_is_denied(const struct motion *motion, const struct config *config)
{
    return motion_gave_up(motion) || motion->pace_left == 0 || motion->astray >= astray_limit(config);
}

static void pass_time(struct motion *motion, uint8_t tick)
{
    unsigned ticks = (uint8_t)(tick - motion->tick);

    if (ticks > HOLD_TICKS)
        ticks = HOLD_TICKS;
    motion->tick = tick;
    if (motion->ticks_left > 0)
        motion->ticks_left--;
    if (motion->kind == TURN)
        motion->pace_left = (uint16_t)(ticks < motion->pace_left ? motion->pace_left - ticks : 0u);
}

/* Wheels that roll apart in a step, or together in a turn, go astray. What they do right makes amends for most of it, for
 * a drive that comes late looks the same for a moment. */
static void judge_way(struct motion *motion, int32_t apart, int32_t together)
{
    int32_t told = is_turn(motion) ? apart : together;
    int32_t untold = apart + together - told;
    uint32_t amends = magnitude(told) * 3u / 4u;
    uint32_t astray = motion->astray + magnitude(untold);

    astray = astray > amends ? astray - amends : 0u;
    motion->astray = (uint16_t)(astray < WAY_LIMIT ? astray : WAY_LIMIT);
}

static void follow(struct motion *motion, int32_t left, int32_t right)
{
    motion->turn_left = clamped(motion->turn_left - (left - right) * TURN_UNIT, TURN_LIMIT);
    motion->way_left = (int16_t)clamped(motion->way_left - (left + right), WAY_LIMIT);
    judge_way(motion, left - right, left + right);
}

void motion_track(struct motion *motion, const struct senses *senses)
{
    if (motion->referenced)
        follow(motion, counts_between(motion->odometer_left, senses->odometer_left),
               counts_between(motion->odometer_right, senses->odometer_right));
    motion->odometer_left = senses->odometer_left;
    motion->odometer_right = senses->odometer_right;
    motion->referenced = true;
    pass_time(motion, senses->tick);
}

static bool has_turned(const struct motion *motion, const struct config *config)
{
    return magnitude(motion->turn_left) <= turn_per_degree(config) / TURN_PRECISION;
}

bool motion_ended(const struct motion *motion, const struct config *config, const struct senses *senses)
{
    if (motion->ticks_left == 0)
        return true;
    if (is_turn(motion))
        return has_turned(motion, config) || (motion->kind == TURN_UNTIL_FOOD && senses->look);
    return motion->kind == STEP && (motion->way_left <= WAY_PRECISION || pattern_of(senses->feel) != 0);
}

/* A turn that was not finished is not made up for: it would come as a surprise much later. */
static void leave_turn(struct motion *motion, const struct config *config)
{
    if (is_turn(motion) && !has_turned(motion, config))
        motion->turn_left = 0;
}

bool motion_rest(struct motion *motion, const struct config *config)
{
    if (motion->rest_ticks == 0)
        return false;
    leave_turn(motion, config);
    motion->kind = REST;
    motion->ticks_left = motion->rest_ticks;
    motion->rest_ticks = 0;
    return true;
}

static enum kind kind_of(const struct action *action)
{
    if (action->turn_deg != 0)
        return action->until_food ? TURN_UNTIL_FOOD : TURN;
    return action->forward_mm != 0 ? STEP : REST;
}

static uint32_t ticks_at_full_speed(const struct motion *motion, const struct config *config, uint32_t counts)
{
    return counts / (full_speed(motion, config) * COUNTS_PER_MM * config->value[TICK_MS] / 1000);
}

/* Ticks to allow: twice what the action needs at full speed, and a little. */
static uint16_t timeout_ticks(const struct motion *motion, const struct config *config)
{
    if (motion->kind == REST)
        return 1;
    return (uint16_t)(ticks_at_full_speed(motion, config, 2 * magnitude(counts_left(motion))) + TIMEOUT_MARGIN_TICKS);
}

/* A turn that food may end is over before its time, and one step is too short to tell. */
static uint16_t pace_ticks(const struct motion *motion, const struct config *config)
{
    if (motion->kind != TURN)
        return ANY_PACE;
    return (uint16_t)(ticks_at_full_speed(motion, config, magnitude(counts_left(motion))) * 7u / 4u + PACE_MARGIN_TICKS);
}

void motion_begin(struct motion *motion, const struct config *config, const struct action *action)
{
    leave_turn(motion, config);
    motion->kind = (uint8_t)kind_of(action);
    motion->rest_ticks = action->rest_ticks;
    motion->turn_left = clamped(motion->turn_left + action->turn_deg * (int32_t)turn_per_degree(config), TURN_LIMIT);
    motion->way_left = (int16_t)(action->forward_mm * COUNTS_PER_MM);
    motion->ticks_left = timeout_ticks(motion, config);
    motion->pace_left = pace_ticks(motion, config);
    if (motion->astray > astray_limit(config))
        motion->astray = astray_limit(config);   /* wheels that obey again are soon believed */
}

void motion_drive(const struct motion *motion, const struct config *config, struct drive *drive)
{
    int16_t speed = speed_for(counts_left(motion), config, full_speed(motion, config));

    drive->left_mm_s = speed;
    drive->right_mm_s = speed;
    if (is_turn(motion))
        drive->right_mm_s = (int16_t)-speed;
}
