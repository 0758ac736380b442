/* motion_rig.h: motion, and two wheels with odometers. */
#ifndef OCTET_MOTION_RIG_H
#define OCTET_MOTION_RIG_H

#include <math.h>

#include "tests/test.h"
#include "firmware/motion/motion.h"

static const double PI = 3.14159265358979323846;

/* Two wheels that follow their commands exactly, but for grip and left_share, with odometers. */
struct ideal_wheels {
    double left_mm, right_mm;
    double grip;   /* speed of both wheels as a part of the commanded one; above 1 if they are faster, or count too much */
    double left_share;   /* speed of the left wheel as a part of that */
    uint8_t feel;
    uint8_t tick;
};

static struct ideal_wheels body;
static struct config config;
static struct motion motion;

enum {
    HALF = 500, ROUNDING = 1,                    /* of a degree or a millimetre, in thousandths */
    STEP_MAX_MM = 250, TURN_MAX_DEG = 360 + 179  /* no step or turn of any behaviour is greater */
};

/* What an odometer shows after that distance. */
static inline uint16_t counted(double mm)
{
    return (uint16_t)((int64_t)floor(mm * ODOMETER_COUNTS_PER_MM) & (ODOMETER_SPAN - 1));
}

/* The body's current senses. */
static inline struct senses sensed(void)
{
    return (struct senses){
        .tick = body.tick,
        .feel = body.feel,
        .odometer_left = counted(body.left_mm),
        .odometer_right = counted(body.right_mm),
    };
}

/* The angle by which the wheels have turned the body, right positive, in 1/1000 degree. */
static inline long heading_mdeg(void)
{
    return lround(1000.0 * (body.left_mm - body.right_mm) / config.value[WHEEL_TRACK_MM] * 180.0 / PI);
}

/* The current command to the wheels. */
static inline struct drive commanded(void)
{
    struct drive drive;

    motion_drive(&motion, &config, &drive);
    return drive;
}

/* The wheels follow their command for a tick, and motion tracks it. True: the action has ended. */
static inline bool tick(void)
{
    const struct drive drive = commanded();
    struct senses senses;

    body.tick++;
    body.left_mm += body.left_share * body.grip * drive.left_mm_s * config.value[TICK_MS] / 1000.0;
    body.right_mm += body.grip * drive.right_mm_s * config.value[TICK_MS] / 1000.0;
    senses = sensed();
    motion_track(&motion, &senses);
    return motion_ended(&motion, &config, &senses);
}

/* A tick in which the odometers count that far, whatever was commanded. */
static inline void roll(int left_counts, int right_counts)
{
    const struct senses senses = {
        .tick = ++body.tick,
        .odometer_left = (uint16_t)((motion.odometer_left + left_counts) & (ODOMETER_SPAN - 1)),
        .odometer_right = (uint16_t)((motion.odometer_right + right_counts) & (ODOMETER_SPAN - 1)),
    };

    motion_track(&motion, &senses);
}

/* Begins a turn, a step of up to STEP_MAX_MM, or with 0 and 0 a rest. */
static inline void begin(int turn_deg, unsigned forward_mm)
{
    const struct action action = {.turn_deg = (int16_t)turn_deg, .forward_mm = (uint8_t)forward_mm};

    TEST_ASSERT_LESS_OR_EQUAL_UINT(STEP_MAX_MM, forward_mm);
    motion_begin(&motion, &config, &action);
}

/* Begins such an action and ends it. Returns how many ticks it took. */
static inline unsigned act(int turn_deg, unsigned forward_mm)
{
    enum { TICKS_MAX = 100000 };
    unsigned ticks = 1;

    begin(turn_deg, forward_mm);
    while (!tick())
        TEST_ASSERT_LESS_THAN_UINT(TICKS_MAX, ticks++);
    return ticks;
}

/* A new motion, of sound wheels that have rolled that far. */
static inline void stand_at(double left_mm, double right_mm)
{
    struct senses senses;

    body.left_mm = left_mm;
    body.right_mm = right_mm;
    body.grip = body.left_share = 1.0;
    body.feel = 0;
    motion_start(&motion);
    senses = sensed();
    motion_track(&motion, &senses);
}

#define ENDS(parameter, minimum, maximum, initial) [parameter] = {minimum, maximum},

/* The four parameters that motion depends on, each at an end of its range: corner 0..15. */
static inline void set_corner(unsigned corner)
{
    static const uint8_t ends[PARAMETER_COUNT][2] = {ROBOT_PARAMETERS(ENDS)};
    static const uint8_t parameters[] = {SPEED_MM_S, TURN_SPEED_DEG_S, WHEEL_TRACK_MM, TICK_MS};

    for (unsigned i = 0; i < sizeof parameters; i++)
        config.value[parameters[i]] = ends[parameters[i]][corner >> i & 1u];
}

#endif
