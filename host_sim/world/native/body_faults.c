#include "host_sim/world/native/body_faults.h"

#include <math.h>

#include "firmware/io.h"

enum { STREAMS = 8, FULL_PERCENT = 100 };   /* random numbers per tick: at least one for each sensor */

static uint8_t mirror(uint8_t feel)
{
    unsigned mirrored = 0;

    for (unsigned n = 0; n < FEEL_COUNT; n++)
        mirrored |= ((unsigned)feel >> n & 1u) << (FEEL_COUNT - 1 - n);
    return (uint8_t)mirrored;
}

uint64_t body_faults_mix(uint64_t number)
{
    uint64_t mixed = number + 0x9E3779B97F4A7C15u;

    mixed = (mixed ^ mixed >> 30) * 0xBF58476D1CE4E5B9u;
    mixed = (mixed ^ mixed >> 27) * 0x94D049BB133111EBu;
    return mixed ^ mixed >> 31;
}

/* The sensors that read wrong in a tick. */
static uint8_t wrong(const struct body_faults *faults, uint32_t tick)
{
    uint64_t first = faults->noise_key + (uint64_t)tick * STREAMS;
    unsigned bits = 0;

    if (faults->noise == 0)
        return 0;
    for (unsigned n = 0; n < FEEL_COUNT; n++)
        bits |= (unsigned)((body_faults_mix(first + n) >> 32) % faults->noise_of < faults->noise) << n;
    return (uint8_t)bits;
}

void body_faults_sense(const struct body_faults *faults, uint32_t tick, struct senses *senses)
{
    uint8_t feel = faults->mirrored ? mirror(senses->feel) : senses->feel;
    uint16_t left = senses->odometer_left;

    senses->feel = (uint8_t)(((feel ^ wrong(faults, tick)) | faults->stuck_on) & ~faults->stuck_off);
    if (faults->swapped) {
        senses->odometer_left = senses->odometer_right;
        senses->odometer_right = left;
    }
    if (faults->false_beacon_mm != 0 && !senses->look) {
        senses->look = true;
        senses->beacon_mm = faults->false_beacon_mm;
    }
}

void body_faults_measure(const struct body_faults *faults, uint8_t *range_mm)
{
    for (unsigned n = 0; n < FEEL_COUNT / 2 && faults->mirrored; n++) {
        uint8_t right_mm = range_mm[n];

        range_mm[n] = range_mm[FEEL_COUNT - 1 - n];
        range_mm[FEEL_COUNT - 1 - n] = right_mm;
    }
    for (unsigned n = 0; n < FEEL_COUNT; n++)
        range_mm[n] = faults->stuck_off >> n & 1u ? RANGE_NONE : faults->stuck_on >> n & 1u ? 0 : range_mm[n];
}

static double weakened(double speed_mm_s, int lost_percent)
{
    return lost_percent == 0 ? speed_mm_s : trunc(speed_mm_s * (FULL_PERCENT - lost_percent) / FULL_PERCENT);
}

void body_faults_drive(const struct body_faults *faults, double *left_mm_s, double *right_mm_s)
{
    double left = faults->swapped ? *right_mm_s : *left_mm_s;
    double right = faults->swapped ? *left_mm_s : *right_mm_s;

    *left_mm_s = weakened(left, faults->left_lost_percent);
    *right_mm_s = weakened(right, faults->right_lost_percent);
}

static double miscounted(double rolled_mm, int miscounted_percent)
{
    return miscounted_percent == 0 ? rolled_mm : rolled_mm * (FULL_PERCENT + miscounted_percent) / FULL_PERCENT;
}

void body_faults_count(const struct body_faults *faults, double *left_mm, double *right_mm)
{
    double left_way_mm = faults->odometers_swapped ? *right_mm : *left_mm;
    double right_way_mm = faults->odometers_swapped ? *left_mm : *right_mm;

    *left_mm = miscounted(left_way_mm, faults->left_miscounted_percent);
    *right_mm = miscounted(right_way_mm, faults->right_miscounted_percent);
}
