#include "firmware/motion/motion.h"

#include "firmware/pattern.h"
#include "firmware/motion/wheels.h"

enum {
    TURN_LIMIT = 1000000000,                       /* of turn_left: far beyond any turn, and no sum overflows */
    TURN_PRECISION = 8,                            /* a turn ends within 1/8 degree */
    WAY_LIMIT = 16000,                             /* of way_left: likewise */
    WAY_PRECISION = 5,                             /* 0.25 mm, as the sum of two wheels' counts */
    TIMEOUT_MARGIN_TICKS = 25,                     /* for wheels that follow late, and for the end, which is slower */
    ANY_PACE = UINT16_MAX,                         /* of pace_left: never used up */
    PACE_MARGIN_TICKS = 2,                         /* at full speed, for drives that come late */
    PACED_TICKS = 8,                               /* at full speed: shorter turns are too short to tell */
    SPEED_TICKS = 9,                               /* after one more with the same command, wheels reach half of it */
    STOPPED_COUNTS = 5,                            /* of both wheels in a tick: almost at rest */
    HOLD_TICKS = 5,                                /* a body without a new drive continues this long, then rests */
    STANDING_MS = 2000,                            /* a wheel that stands still this long is dead, */
    STANDING_COUNTS = 3,                           /* though its odometer may waver this far */
    ASTRAY_PER_S = 5,                              /* wheels may go astray as far as they both roll in 1/5 second */
    CREDIBLE_EIGHTHS = 13,                         /* of the fastest commanded speed is credible, */
    CREDIBLE_COUNTS = 2,                           /* and this much more, for rounding over few ticks */
    RESTART_COUNTS = 8                             /* a restarted body has rolled no farther when it is heard again */
};

static bool is_turn(const struct motion *motion)
{
    return motion->kind >= MOTION_TURN;
}

/* The highest speed of each wheel in the current action, mm/s. */
static uint32_t full_speed(const struct motion *motion, const struct config *config)
{
    return is_turn(motion) ? wheels_turning_mm_s(config) : config->value[SPEED_MM_S];
}

/* What is still to be commanded in the current action: counts of both wheels together, right or forward positive. */
static int32_t counts_left(const struct motion *motion)
{
    if (motion->kind == MOTION_REST)
        return 0;
    if (is_turn(motion))
        return motion->turn_left / WHEELS_TURN_UNIT - backlog_counts(&motion->apart);
    return motion->way_left - backlog_counts(&motion->together);
}

/* The wheel speed that covers counts in one tick, rounded, and at most the limit. */
static int16_t speed_for(int32_t counts, const struct config *config, uint32_t limit_mm_s)
{
    uint32_t per_mm_s = (uint32_t)WHEELS_COUNTS_PER_MM * config->value[TICK_MS];
    uint32_t speed = (wheels_magnitude(counts) * 1000 + per_mm_s / 2) / per_mm_s;

    if (speed > limit_mm_s)
        speed = limit_mm_s;
    return (int16_t)(counts < 0 ? -(int32_t)speed : (int32_t)speed);
}

void motion_start(struct motion *motion)
{
    *motion = (struct motion){.kind = MOTION_REST, .pace_left = ANY_PACE};
}

void motion_lift(struct motion *motion)
{
    motion->referenced = false;
    motion->apart = (struct backlog){.counts = 0};
    motion->together = motion->apart;
}

static bool is_near_0(uint16_t odometer)
{
    return ((odometer + RESTART_COUNTS) & (ODOMETER_SPAN - 1)) <= 2 * RESTART_COUNTS;
}

/* A body that was restarted counts from 0. */
static bool counts_anew(const struct motion *motion, const struct senses *senses)
{
    bool did = is_near_0(motion->odometer_left) && is_near_0(motion->odometer_right);

    return !did && is_near_0(senses->odometer_left) && is_near_0(senses->odometer_right);
}

/* Odometers that jump are not credible: the body was reset, or counts too much. */
bool motion_is_credible(const struct motion *motion, const struct config *config, const struct senses *senses,
                        unsigned ticks)
{
    unsigned rolling = ticks < HOLD_TICKS ? ticks : HOLD_TICKS;
    uint32_t way = rolling * config->value[TICK_MS] * wheels_fastest_mm_s(config) * ODOMETER_COUNTS_PER_MM / 1000u;
    uint32_t farthest = way * CREDIBLE_EIGHTHS / 8u + CREDIBLE_COUNTS;

    if (!motion->referenced)
        return true;
    if (ticks > 1 && counts_anew(motion, senses))
        return false;
    return wheels_magnitude(wheels_counts_between(motion->odometer_left, senses->odometer_left)) <= farthest
        && wheels_magnitude(wheels_counts_between(motion->odometer_right, senses->odometer_right)) <= farthest;
}

bool motion_gave_up(const struct motion *motion)
{
    return motion->kind != MOTION_REST && motion->ticks_left == 0;
}

bool motion_tells(const struct motion *motion)
{
    return motion->pace_left != ANY_PACE;
}

/* Twice as far as a body rolls on at full speed after its last drive. */
static uint16_t astray_limit(const struct config *config)
{
    return (uint16_t)(wheels_fastest_mm_s(config) * WHEELS_COUNTS_PER_MM / ASTRAY_PER_S);
}

bool motion_is_denied(const struct motion *motion, const struct config *config)
{
    return motion_gave_up(motion) || motion->pace_left == 0 || motion->astray >= astray_limit(config);
}

/* In how many ticks since the last senses the wheels were commanded to roll. */
static unsigned pass_time(struct motion *motion, uint8_t tick)
{
    unsigned ticks = (uint8_t)(tick - motion->tick);

    motion->tick = tick;
    if (motion->ticks_left > 0)
        motion->ticks_left--;
    return ticks < HOLD_TICKS ? ticks : HOLD_TICKS;
}

/* Wheels go astray if they turn the body in a step, or move it in a turn, unless they still owe that motion. Correct
 * rolling offsets most of it, since a late drive looks the same for a moment. */
static void judge_way(struct motion *motion, int32_t apart, int32_t together)
{
    int32_t told = is_turn(motion) ? apart : together;
    int32_t untold = apart + together - told;
    int32_t owed = is_turn(motion) ? motion->together.counts : motion->apart.counts;
    uint32_t amends = wheels_magnitude(told) * 3u / 4u;
    uint32_t astray;

    if ((owed < 0) == (untold < 0))
        untold -= wheels_limited(untold, (int32_t)wheels_magnitude(owed));
    astray = motion->astray + wheels_magnitude(untold);
    astray = astray > amends ? astray - amends : 0u;
    motion->astray = (uint16_t)(astray < WAY_LIMIT ? astray : WAY_LIMIT);
}

/* Neither lag nor delay nor gears keep a wheel that obeys from rolling for that long. */
static void judge_standing(struct standing *wheel, int32_t rolled, unsigned ticks)
{
    int32_t way = wheel->way + rolled;

    if (wheels_magnitude(way) > STANDING_COUNTS) {
        *wheel = (struct standing){.way = 0};
        return;
    }
    wheel->way = (int8_t)way;
    if (wheel->ticks <= UINT8_MAX - HOLD_TICKS)
        wheel->ticks = (uint8_t)(wheel->ticks + ticks);
}

static void follow(struct motion *motion, int32_t left, int32_t right, unsigned ticks)
{
    motion->turn_left = wheels_limited(motion->turn_left - (left - right) * WHEELS_TURN_UNIT, TURN_LIMIT);
    motion->way_left = (int16_t)wheels_limited(motion->way_left - (left + right), WAY_LIMIT);
    judge_standing(&motion->left, left, motion->kind == MOTION_REST ? 0 : ticks);
    judge_standing(&motion->right, right, motion->kind == MOTION_REST ? 0 : ticks);
    judge_way(motion, left - right, left + right);
    backlog_roll(&motion->apart, left - right, ticks);
    backlog_roll(&motion->together, left + right, ticks);
}

/* Takes commands off pace_left, since even late wheels obey them in the end; all if half the speed is not reached. */
static void judge_pace(struct motion *motion, unsigned ticks)
{
    uint32_t told = wheels_magnitude(motion->apart.commanded[0]) * ticks;

    if (!motion_tells(motion))
        return;
    motion->pace_left = (uint16_t)(told < motion->pace_left ? motion->pace_left - told : 0u);
    if (motion->apart.same >= SPEED_TICKS
        && 2 * wheels_magnitude(motion->apart.rolled) < wheels_magnitude(motion->apart.commanded[0]))
        motion->pace_left = 0;
}

/* Turns back to where it saw food, if it has overshot. */
static void find_food(struct motion *motion)
{
    motion->kind = MOTION_TURN;
    motion->turn_left = 0;
}

void motion_track(struct motion *motion, const struct senses *senses)
{
    unsigned ticks = pass_time(motion, senses->tick);

    if (motion->referenced)
        follow(motion, wheels_counts_between(motion->odometer_left, senses->odometer_left),
               wheels_counts_between(motion->odometer_right, senses->odometer_right), ticks);
    judge_pace(motion, ticks);
    if (motion->kind == MOTION_TURN_UNTIL_FOOD && senses->look)
        find_food(motion);
    motion->odometer_left = senses->odometer_left;
    motion->odometer_right = senses->odometer_right;
    motion->referenced = true;
}

/* Turned to within 1/8 degree, counting what the wheels still owe, which is little if the end of the turn is judged.
 * If they stop earlier, because they ignore such a small command, up to 1/2 degree is left for the next turn. */
static bool has_turned(const struct motion *motion, const struct config *config)
{
    uint32_t degree = wheels_turn_per_degree(config);
    int32_t owed = backlog_counts(&motion->apart) * WHEELS_TURN_UNIT;

    if (wheels_magnitude(motion->apart.rolled) <= STOPPED_COUNTS && wheels_magnitude(motion->turn_left) <= degree / 2)
        return true;
    return wheels_magnitude(motion->turn_left - owed) <= degree / TURN_PRECISION
        && (motion->kind == MOTION_GLANCE || wheels_magnitude(owed) <= degree * 3u / TURN_PRECISION);
}

bool motion_ended(const struct motion *motion, const struct config *config, const struct senses *senses)
{
    if (motion->ticks_left == 0)
        return true;
    if (is_turn(motion))
        return has_turned(motion, config);
    if (motion->kind == MOTION_BACK)
        return counts_left(motion) >= -WAY_PRECISION;
    return motion->kind == MOTION_STEP && (counts_left(motion) <= WAY_PRECISION || pattern_of(senses->feel) != 0);
}

/* The rest of an unfinished turn is dropped: made up for much later, it would be a surprise. */
static void leave_turn(struct motion *motion, const struct config *config)
{
    int32_t owed = backlog_counts(&motion->apart) * WHEELS_TURN_UNIT;

    if (is_turn(motion) && wheels_magnitude(motion->turn_left - owed) > wheels_turn_per_degree(config) / 2)
        motion->turn_left = 0;
}

bool motion_rest(struct motion *motion, const struct config *config)
{
    if (motion->rest_ticks == 0)
        return false;
    leave_turn(motion, config);
    motion->kind = MOTION_REST;
    motion->ticks_left = motion->rest_ticks;
    motion->rest_ticks = 0;
    return true;
}

static enum motion_kind kind_of(const struct action *action)
{
    if (action->turn_deg != 0)
        return action->until_food ? MOTION_TURN_UNTIL_FOOD
             : action->reason == REASON_LOOK_AROUND ? MOTION_GLANCE : MOTION_TURN;
    if (action->forward_mm < 0)
        return MOTION_BACK;
    return action->forward_mm > 0 ? MOTION_STEP : MOTION_REST;
}

/* Sets the timeout: twice what a step needs at full speed, 1.5 times what a turn needs, plus a margin. Sets what a
 * turn may command: 7/4 of its arc plus a margin, except for turns that food may end and those too short to judge. */
static void allow(struct motion *motion, const struct config *config)
{
    uint32_t in_a_tick = wheels_counts_at(full_speed(motion, config), config);
    uint32_t counts = wheels_magnitude(counts_left(motion));
    uint32_t most = counts * 7u / 4u + PACE_MARGIN_TICKS * in_a_tick;

    motion->pace_left = ANY_PACE;
    if (motion->kind == MOTION_TURN && counts >= PACED_TICKS * in_a_tick && most < ANY_PACE)
        motion->pace_left = (uint16_t)most;
    if (motion->kind == MOTION_REST)
        motion->ticks_left = 1;
    else
        motion->ticks_left = (uint16_t)((is_turn(motion) ? counts * 3u : counts * 4u) / 2u / in_a_tick
                                        + TIMEOUT_MARGIN_TICKS);
}

void motion_begin(struct motion *motion, const struct config *config, const struct action *action)
{
    uint16_t limit = astray_limit(config);

    leave_turn(motion, config);
    motion->kind = (uint8_t)kind_of(action);
    motion->rest_ticks = action->rest_ticks;
    motion->turn_left =
        wheels_limited(motion->turn_left + action->turn_deg * (int32_t)wheels_turn_per_degree(config), TURN_LIMIT);
    motion->way_left = (int16_t)(action->forward_mm * WHEELS_COUNTS_PER_MM + backlog_counts(&motion->together));
    allow(motion, config);
    if (motion->astray > limit)
        motion->astray = limit;   /* wheels that obey again are soon believed */
}

/* Whether a wheel has stood still too long, in any number of actions. */
static bool stands(const struct motion *motion, const struct config *config)
{
    unsigned ticks = motion->left.ticks > motion->right.ticks ? motion->left.ticks : motion->right.ticks;

    return ticks * config->value[TICK_MS] >= STANDING_MS;
}

void motion_drive(struct motion *motion, const struct config *config, struct drive *drive)
{
    int16_t speed = speed_for(counts_left(motion), config, full_speed(motion, config));
    int32_t counts = (int32_t)wheels_counts_at(wheels_magnitude(speed), config);

    if (speed < 0)
        counts = -counts;
    if (stands(motion, config))
        motion->ticks_left = 0;
    backlog_command(&motion->apart, is_turn(motion) ? counts : 0);
    backlog_command(&motion->together, is_turn(motion) ? 0 : counts);
    drive->left_mm_s = speed;
    drive->right_mm_s = is_turn(motion) ? (int16_t)-speed : speed;
}
