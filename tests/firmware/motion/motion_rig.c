#include "motion_rig.h"

#include <math.h>

#include <unity.h>

const double PI = 3.14159265358979323846;

struct ideal_wheels body;

struct config config;
struct motion motion;
struct random dice;

uint16_t counted(double mm)
{
    return (uint16_t)((int64_t)floor(mm * ODOMETER_COUNTS_PER_MM) & (ODOMETER_SPAN - 1));
}

struct senses sensed(void)
{
    return (struct senses){
        .tick = body.tick,
        .feel = body.feel,
        .odometer_left = counted(body.left_mm),
        .odometer_right = counted(body.right_mm),
    };
}

long heading_mdeg(void)
{
    return lround(1000.0 * (body.left_mm - body.right_mm) / config.value[WHEEL_TRACK_MM] * 180.0 / PI);
}

struct drive commanded(void)
{
    struct drive drive;

    motion_drive(&motion, &config, &drive);
    return drive;
}

bool tick(void)
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

void roll(int left_counts, int right_counts)
{
    const struct senses senses = {
        .tick = ++body.tick,
        .odometer_left = (uint16_t)((motion.odometer_left + left_counts) & (ODOMETER_SPAN - 1)),
        .odometer_right = (uint16_t)((motion.odometer_right + right_counts) & (ODOMETER_SPAN - 1)),
    };

    motion_track(&motion, &senses);
}

void begin(int turn_deg, unsigned forward_mm)
{
    const struct action action = {.turn_deg = (int16_t)turn_deg, .forward_mm = (uint8_t)forward_mm};

    TEST_ASSERT_LESS_OR_EQUAL_UINT(STEP_MAX_MM, forward_mm);
    motion_begin(&motion, &config, &action);
}

unsigned act(int turn_deg, unsigned forward_mm)
{
    enum { TICKS_MAX = 100000 };
    unsigned ticks = 1;

    begin(turn_deg, forward_mm);
    while (!tick())
        TEST_ASSERT_LESS_THAN_UINT(TICKS_MAX, ticks++);
    return ticks;
}

void stand_at(double left_mm, double right_mm)
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

void set_corner(unsigned corner)
{
    static const uint8_t ends[PARAMETER_COUNT][2] = {ROBOT_PARAMETERS(ENDS)};
    static const uint8_t parameters[] = {SPEED_MM_S, TURN_SPEED_DEG_S, WHEEL_TRACK_MM, TICK_MS};

    for (unsigned i = 0; i < sizeof parameters; i++)
        config.value[parameters[i]] = ends[parameters[i]][corner >> i & 1u];
}
