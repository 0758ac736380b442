#include "host_sim/world/native/kit/kit.h"
#include "host_sim/world/native/vector_sums.h"

enum { PERIODS = 4, ONE = 65536 };   /* PERIODS: per tick of 20 ms, WHEEL_PERIOD_MS each */

static const uint64_t SLIPS = 1u << 16;   /* first number of the slip's random stream */
static const double MM_PER_PLACE = WHEEL_COUNT_256 / 256.0 / 1000.0 / ONE, MS_PER_S = 1000.0;

static double limited(double x, double least, double most)
{
    return x < least ? least : x > most ? most : x;
}

static double whole_down(double number)
{
    double whole = vector_whole(number);

    return whole > number ? whole - 1.0 : whole;
}

static void follow(const struct kit *kit, struct kit_wheel *wheel, double order_mm_s, double most_mm_s)
{
    if (wheel->told_mm_s == order_mm_s)
        return;
    wheel->told_mm_s += limited((order_mm_s - wheel->told_mm_s) * kit->lag_gain, -most_mm_s, most_mm_s);
    wheel->told = (int16_t)vector_whole(wheel->told_mm_s);
}

uint16_t kit_count(const struct kit *kit, unsigned side)
{
    return (uint16_t)(kit->wheels[side].place / ONE);
}

/* A motor's speed settles toward the one that its duty beyond the dead band gives. */
static void turn_motor(struct kit_wheel *wheel, int64_t supply, int64_t kept)
{
    const int64_t dead = (int64_t)WHEEL_DEAD * ONE;
    int64_t pushed = wheel->duty * supply;

    pushed = pushed > dead ? pushed - dead : pushed < -dead ? pushed + dead : 0;
    wheel->speed = (wheel->speed * kept * ONE + pushed * wheel->strength) / ((int64_t)ONE * ONE);
    wheel->place += (uint64_t)wheel->speed;
}

static uint32_t size(int32_t duty)
{
    return (uint32_t)(duty < 0 ? -duty : duty);
}

/* Supply voltage as a fraction of the nominal one, 1/65536. */
static int64_t supply_of(const struct kit *kit)
{
    uint64_t load = (uint64_t)size(kit->wheels[0].duty) + size(kit->wheels[1].duty);

    return kit->supply - (int64_t)(kit->sag * load / (2 * ONE));
}

uint32_t kit_supply_mv(const struct kit *kit)
{
    return (uint32_t)(supply_of(kit) * WHEEL_NOMINAL_MV / ONE);
}

/* Runs the motors with new duties for a period. The battery sags under the load of the period before. */
static void turn_motors(struct kit *kit, const int32_t duty[KIT_WHEELS])
{
    int64_t supply = supply_of(kit);

    for (unsigned side = 0; side < KIT_WHEELS; side++) {
        kit->wheels[side].duty = duty[side];
        turn_motor(&kit->wheels[side], supply, kit->speed_kept);
    }
}

/* Runs the board's controllers for a period. */
static void run_motors(struct kit *kit)
{
    int32_t duty[KIT_WHEELS];

    for (unsigned side = 0; side < KIT_WHEELS; side++)
        duty[side] = wheel_run(&kit->wheels[side].control, kit_count(kit, side), kit->wheels[side].told,
                               kit->battery_mv);
    turn_motors(kit, duty);
}

void kit_push(struct kit *kit, const int32_t duty[KIT_WHEELS])
{
    kit->pushed = kit->wheels_differ = true;
    turn_motors(kit, duty);
}

static void order(struct kit *kit, const double *way_mm, double tick_s, double *told_mm_s)
{
    unsigned late = (unsigned)kit->trait[TRAIT_DRIVES_TICKS];

    for (unsigned side = 0; side < KIT_WHEELS; side++) {
        for (unsigned i = late; i > 0; i--)
            kit->told[i][side] = kit->told[i - 1][side];
        kit->told[0][side] = way_mm[side] / tick_s;
        told_mm_s[side] = kit->told[late][side];
        if (__builtin_fabs(told_mm_s[side]) < kit->trait[TRAIT_DEAD_MM_S])
            told_mm_s[side] = 0.0;
    }
}

/* Runs the motors, or wheels without motors, for a tick at the commanded speeds. */
static void run(struct kit *kit, const double *told_mm_s)
{
    const double period_s = WHEEL_PERIOD_MS / MS_PER_S, most_mm_s = kit->trait[TRAIT_ACCELERATION_MM_S2] * period_s;
    const bool driven = kit->trait[TRAIT_MOTOR_MS] > 0.0;

    for (unsigned i = 0; i < PERIODS; i++) {
        for (unsigned side = 0; side < KIT_WHEELS; side++) {
            struct kit_wheel *wheel = &kit->wheels[side];

            follow(kit, wheel, told_mm_s[side], most_mm_s);
            if (!driven)
                wheel->motor_mm += wheel->told_mm_s * period_s;
        }
        if (driven)
            run_motors(kit);
    }
}

/* The distance that the odometer has counted. */
static double counted(const struct kit *kit, double way_mm)
{
    double count_mm = kit->trait[TRAIT_COUNT_MM];

    return count_mm > 0.0 ? whole_down(way_mm * kit->counts_per_mm) * count_mm : way_mm;
}

/* Converts a motor's distance to what the odometer counts and what the wheel rolls. */
static void finish(struct kit *kit, unsigned side, double *counted_mm, double *rolled_mm)
{
    struct kit_wheel *wheel = &kit->wheels[side];
    double slack_mm = kit->trait[TRAIT_SLACK_MM] / 2.0, wheel_mm = wheel->wheel_mm, odometer_mm = wheel->counted_mm;
    double slip = kit->trait[TRAIT_SLIP] * (1.0 + kit_chance(kit, SLIPS + (uint64_t)kit->moved * KIT_WHEELS + side))
                / 2.0;

    wheel->motor_mm += (double)(int64_t)(wheel->place - wheel->place_was) * MM_PER_PLACE;
    wheel->place_was = wheel->place;
    wheel->wheel_mm = limited(wheel_mm, wheel->motor_mm - slack_mm, wheel->motor_mm + slack_mm);
    wheel->counted_mm = counted(kit, wheel->motor_mm);
    *counted_mm = wheel->counted_mm - odometer_mm;
    *rolled_mm = (wheel->wheel_mm - wheel_mm) * kit->trait[TRAIT_LEFT_WHEEL + side] * (1.0 - slip);
}

double kit_roll(struct kit *kit, double tick_s, double *counted_mm, double *rolled_mm)
{
    double told_mm_s[KIT_WHEELS];

    if (!kit->wheels_differ)
        return 1.0;
    order(kit, rolled_mm, tick_s, told_mm_s);
    if (!kit->pushed)
        run(kit, told_mm_s);
    kit->moved++;
    for (unsigned side = 0; side < KIT_WHEELS; side++)
        finish(kit, side, &counted_mm[side], &rolled_mm[side]);
    return kit->trait[TRAIT_TRACK];
}
