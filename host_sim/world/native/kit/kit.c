#include "host_sim/world/native/kit/kit.h"

enum { ROBOTS_A_SEED = 10000, KEY_BITS = 8 };

static const double NOMINAL_V = 7.2, ONE = 65536.0, MV_PER_V = 1000.0;
static const double FREE_COUNTS = 36.79;   /* per period of the controller: 674 mm/s */
static const double RIM_MM_PER_DEG = 42.0 * 3.141592653589793 / 360.0, FULL_PERCENT = 100.0;   /* of a 42 mm wheel */
static const double DARK = 0.3, WEAK_V = 4.5, WEAK_SAG_V = 1.0, MOTOR_MS = 60.0;

/* name, minimum, maximum, ideal, kit, tolerance */
const struct trait_row KIT_TRAITS[TRAIT_COUNT] = {
    [TRAIT_LAG_MS] = {"lag_ms", 0, 1000, 0, 0, 0},
    [TRAIT_DEAD_MM_S] = {"dead_mm_s", 0, 200, 0, 0, 0},
    [TRAIT_ACCELERATION_MM_S2] = {"acceleration_mm_s2", 100, 1e6, 1e6, 1e6, 0},
    [TRAIT_SLACK_MM] = {"slack_mm", 0, 10, 0, 0.4, 0.3},
    [TRAIT_COUNT_MM] = {"count_mm", 0, 5, 0, 0.0916, 0},
    [TRAIT_LEFT_WHEEL] = {"left_wheel", 0.5, 2, 1, 1, 0.01},
    [TRAIT_RIGHT_WHEEL] = {"right_wheel", 0.5, 2, 1, 1, 0.01},
    [TRAIT_TRACK] = {"track", 0.5, 2, 1, 1, 0.01},
    [TRAIT_SLIP] = {"slip", 0, 1, 0, 0.01, 0.01},
    [TRAIT_DRIVES_TICKS] = {"drives_ticks", 0, KIT_DELAY_MAX, 0, 0, 0},
    [TRAIT_MOTOR_MS] = {"motor_ms", 0, 1000, 0, 60, 15},
    [TRAIT_LEFT_MOTOR] = {"left_motor", 0, 2, 1, 1, 0.1},
    [TRAIT_RIGHT_MOTOR] = {"right_motor", 0, 2, 1, 1, 0.1},
    [TRAIT_BATTERY_V] = {"battery_v", 3, 12, 7.2, 7.4, 0.6},
    [TRAIT_SAG_V] = {"sag_v", 0, 3, 0, 0.3, 0.1},
    [TRAIT_SENSES_TICKS] = {"senses_ticks", 0, KIT_DELAY_MAX, 0, 1, 0},
    [TRAIT_RIGHT_MM] = {"right_mm", 0, 90, 60, 60, 6},
    [TRAIT_FRONT_RIGHT_MM] = {"front_right_mm", 0, 90, 60, 60, 6},
    [TRAIT_FRONT_MM] = {"front_mm", 0, 90, 60.5, 60, 6},
    [TRAIT_FRONT_LEFT_MM] = {"front_left_mm", 0, 90, 60, 60, 6},
    [TRAIT_LEFT_MM] = {"left_mm", 0, 90, 60, 60, 6},
    [TRAIT_CONE_DEG] = {"cone_deg", 1, 45, 45, 45, 0},
    [TRAIT_FOLD_MM] = {"fold_mm", 0, 60, 0, 0, 0},
    [TRAIT_HYSTERESIS_MM] = {"hysteresis_mm", 0, 30, 0, 4, 1},
    [TRAIT_NOISE_MM] = {"noise_mm", 0, 30, 0, 1, 0},
    [TRAIT_WALL] = {"wall", 0.1, 1, 1, 1, 0},
    [TRAIT_BEAM_DEG] = {"beam_deg", 0, 30, 0, 2, 1},
    [TRAIT_BEACON_MM] = {"beacon_mm", 100, 8191, 8191, 8191, 0},
    [TRAIT_BEACON_NOISE] = {"beacon_noise", 0, 1, 0, 0.1, 0},
};

static double limited(double x, double least, double most)
{
    return x < least ? least : x > most ? most : x;
}

double kit_chance(const struct kit *kit, uint64_t number)
{
    return (double)(body_faults_mix(kit->key + number) >> 32) / 2147483648.0 - 1.0;
}

/* The share of the remaining difference that a first-order lag makes up in a period; second-order accurate. */
static double gain(double lag_ms)
{
    double part = lag_ms > 0.0 ? WHEEL_PERIOD_MS / lag_ms : 2.0;

    return part < 2.0 ? part / (1.0 + part / 2.0) : 1.0;
}

static void set_trait(struct kit *kit, enum trait trait, double value)
{
    const struct trait_row *row = &KIT_TRAITS[trait];

    kit->trait[trait] = value = limited(value, row->least, row->most);
    if (value < row->ideal || value > row->ideal)
        *(trait < TRAIT_SENSES_TICKS ? &kit->wheels_differ : &kit->senses_differ) = true;
}

/* Computes what follows from its traits. */
static void reckon(struct kit *kit)
{
    const double *trait = kit->trait, motor_gain = gain(trait[TRAIT_MOTOR_MS]);

    kit->battery_mv = (uint32_t)(trait[TRAIT_BATTERY_V] * MV_PER_V);
    kit->supply = (int64_t)(trait[TRAIT_BATTERY_V] / NOMINAL_V * ONE);
    kit->sag = (uint64_t)(trait[TRAIT_SAG_V] / NOMINAL_V * ONE);
    kit->speed_kept = (int64_t)((1.0 - motor_gain) * ONE);
    kit->counts_per_mm = trait[TRAIT_COUNT_MM] > 0.0 ? 1.0 / trait[TRAIT_COUNT_MM] : 0.0;
    kit->lag_gain = gain(trait[TRAIT_LAG_MS]);
    for (unsigned side = 0; side < KIT_WHEELS; side++)
        kit->wheels[side].strength = (int64_t)(trait[TRAIT_LEFT_MOTOR + side] * FREE_COUNTS * motor_gain * ONE);
}

void kit_suffer(struct kit *kit, const struct body_faults *faults)
{
    double more[TRAIT_COUNT] = {
        [TRAIT_LAG_MS] = faults->lag_ms,
        [TRAIT_SLACK_MM] = faults->slack_deg * RIM_MM_PER_DEG,
        [TRAIT_SLIP] = faults->slip_percent / FULL_PERCENT,
        [TRAIT_SENSES_TICKS] = faults->latency_ticks,
    };

    kit->wheels_differ = kit->pushed;
    kit->senses_differ = false;
    for (unsigned i = 0; i < TRAIT_COUNT; i++)
        set_trait(kit, (enum trait)i, KIT_TRAITS[i].ideal + kit->apart[i] + more[i]);
    if (faults->dark_wall)
        set_trait(kit, TRAIT_WALL, kit->trait[TRAIT_WALL] * DARK);
    if (faults->weak_battery) {
        set_trait(kit, TRAIT_BATTERY_V, WEAK_V);
        set_trait(kit, TRAIT_SAG_V, kit->trait[TRAIT_SAG_V] + WEAK_SAG_V);
        set_trait(kit, TRAIT_MOTOR_MS, kit->trait[TRAIT_MOTOR_MS] > 0.0 ? kit->trait[TRAIT_MOTOR_MS] : MOTOR_MS);
    }
    reckon(kit);
}

void kit_draw(struct kit *kit, const struct kit_kind *kind, uint32_t seed, uint32_t robot)
{
    *kit = (struct kit){.key = ((uint64_t)seed * ROBOTS_A_SEED + robot + 1) << KEY_BITS, .ranges = kit->ranges};
    for (unsigned i = 0; i < TRAIT_COUNT && kind; i++)
        kit->apart[i] = kind->trait[i] + kind->tolerance[i] * kit_chance(kit, i) - KIT_TRAITS[i].ideal;
    kit_suffer(kit, &(struct body_faults){0});
}

void kit_set_kind(struct kit_kind *kind, bool is_kit)
{
    for (unsigned i = 0; i < TRAIT_COUNT; i++) {
        kind->trait[i] = is_kit ? KIT_TRAITS[i].kit : KIT_TRAITS[i].ideal;
        kind->tolerance[i] = is_kit ? KIT_TRAITS[i].tolerance : 0.0;
    }
}

static double most(const struct kit_kind *kind, enum trait trait)
{
    return kind->trait[trait] + kind->tolerance[trait];
}

double kit_reach_mm(const struct kit_kind *kind)
{
    double reach_mm = 0.0;

    for (unsigned i = TRAIT_RIGHT_MM; i <= TRAIT_LEFT_MM; i++)
        if (most(kind, (enum trait)i) > reach_mm)
            reach_mm = most(kind, (enum trait)i);
    return reach_mm + most(kind, TRAIT_HYSTERESIS_MM) + most(kind, TRAIT_NOISE_MM) + 1.0;
}
