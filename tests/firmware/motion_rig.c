#include "motion_rig.h"

#include <math.h>

#include <unity.h>

const double PI = 3.14159265358979323846;

struct wheels_of_a_body body;

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

struct drive driven(void)
{
    struct drive drive;

    motion_drive(&motion, &config, &drive);
    return drive;
}

/* One tick: the wheels turn, and what they did is sensed. True if the action has ended. */
bool tick(void)
{
    const struct drive drive = driven();
    struct senses senses;

    body.tick++;
    body.left_mm += body.lame * body.grip * drive.left_mm_s * config.value[TICK_MS] / 1000.0;
    body.right_mm += body.grip * drive.right_mm_s * config.value[TICK_MS] / 1000.0;
    senses = sensed();
    motion_track(&motion, &senses);
    return motion_ended(&motion, &config, &senses);
}

void begin(int turn_deg, unsigned forward_mm)
{
    const struct action action = {.turn_deg = (int16_t)turn_deg, .forward_mm = (uint8_t)forward_mm};

    motion_begin(&motion, &config, &action);
}

/* Carries one action through; returns how many ticks it took. */
unsigned act(int turn_deg, unsigned forward_mm)
{
    enum { FAR_TOO_MANY = 100000 };
    unsigned ticks = 1;

    begin(turn_deg, forward_mm);
    while (!tick())
        TEST_ASSERT_LESS_THAN_UINT(FAR_TOO_MANY, ticks++);
    return ticks;
}

void stand_at(double left_mm, double right_mm)
{
    struct senses senses;

    body.left_mm = left_mm;
    body.right_mm = right_mm;
    body.grip = body.lame = 1.0;
    body.feel = 0;
    motion_start(&motion);
    senses = sensed();
    motion_track(&motion, &senses);
}

/* The four parameters that a motion depends on, each at an end of its range: 16 corners. */
void set_corner(unsigned corner)
{
    config.value[SPEED_MM_S] = corner & 1u ? 250 : 20;
    config.value[TURN_SPEED_DEG_S] = corner & 2u ? 250 : 30;
    config.value[WHEEL_TRACK_MM] = corner & 4u ? 250 : 80;
    config.value[TICK_MS] = corner & 8u ? 100 : 10;
}
