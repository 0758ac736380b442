#include "host_sim/world/native/kit/kit.h"

#include "host_sim/world/native/vector_sums.h"

enum { STREAMS = 8 };   /* random numbers per tick */

static const uint64_t SENSES = (uint64_t)1 << 48;   /* first number of the sensors' random stream */
static const double FOLDED = 2.0;                   /* below fold_mm: growth of the apparent distance per mm nearer */
static const double RAD_PER_DEG = 0.017453292519943295, BEACON_MAX_MM = 8191.0;

static double chance(const struct kit *kit, uint32_t tick, unsigned n)
{
    return kit_chance(kit, SENSES + (uint64_t)tick * STREAMS + n);
}

bool kit_sees(const struct kit *kit, double ahead_mm, double aside_mm, double beam_mm)
{
    double slope = kit->trait[TRAIT_BEAM_DEG] * RAD_PER_DEG, beside_mm = __builtin_fabs(aside_mm) - beam_mm / 2.0;
    double left;

    if (!kit->senses_differ)
        return beside_mm <= 0.0;
    if (ahead_mm >= kit->trait[TRAIT_BEACON_MM] || beside_mm > ahead_mm * slope)
        return false;
    left = 1.0 - ahead_mm / kit->trait[TRAIT_BEACON_MM];
    return beside_mm <= ahead_mm * slope * vector_root(left);
}

/* Apparent distance of an obstacle, mm. */
static double seeming(const struct kit *kit, uint8_t range_mm)
{
    double under_mm = kit->trait[TRAIT_FOLD_MM] - range_mm;

    return under_mm > 0.0 ? kit->trait[TRAIT_FOLD_MM] + FOLDED * under_mm : range_mm;
}

/* Noise of a sensor in this tick, mm: added to its range, subtracted from the distances it reads. */
static double noise(const struct kit *kit, uint32_t tick, unsigned n)
{
    return kit->trait[TRAIT_NOISE_MM] * chance(kit, tick, n);
}

static double reach(const struct kit *kit, unsigned n)
{
    return kit->trait[TRAIT_RIGHT_MM + n] * kit->trait[TRAIT_WALL];
}

static void measure(const struct kit *kit, const struct world *world, const struct body *body, uint8_t *range_mm)
{
    struct ranges ranges = *kit->ranges;

    ranges.cone_deg = kit->trait[TRAIT_CONE_DEG];
    ranges_measure(&ranges, world, body, range_mm);
}

void kit_light(const struct kit *kit, const struct world *world, const struct body *body, uint32_t tick,
               uint16_t light[FEEL_COUNT])
{
    uint8_t range_mm[FEEL_COUNT] = {RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE};

    if (body->feel != 0)
        measure(kit, world, body, range_mm);
    body_faults_measure(&body->faults, range_mm);
    kit_light_from(kit, range_mm, tick, light);
}

/* The window of a sensor acts like BEHIND_MM more distance. */
void kit_light_from(const struct kit *kit, const uint8_t range_mm[FEEL_COUNT], uint32_t tick,
                    uint16_t light[FEEL_COUNT])
{
    static const double BEHIND_MM = 20.0, MOST = 4095.0;

    for (unsigned n = 0; n < FEEL_COUNT; n++) {
        double part = (reach(kit, n) + noise(kit, tick, n) + BEHIND_MM) / (range_mm[n] + BEHIND_MM);
        double received = KIT_LIGHT_NEAR * part * part;

        light[n] = range_mm[n] == RANGE_NONE ? 0 : (uint16_t)(received < MOST ? received : MOST);
    }
}

/* A sensor is triggered within its range, with hysteresis; while triggered, it gives a distance. */
static void feel(const struct kit *kit, uint32_t tick, const uint8_t *range_mm, struct senses *senses)
{
    unsigned before = kit->sensed[(tick - 1) % KIT_SENSED].feel;

    senses->feel = 0;
    for (unsigned n = 0; n < FEEL_COUNT; n++) {
        double noise_mm = noise(kit, tick, n), reach_mm = reach(kit, n) + noise_mm;
        double seems_mm = seeming(kit, range_mm[n]);

        if (before >> n & 1u)
            reach_mm += kit->trait[TRAIT_HYSTERESIS_MM];
        if (range_mm[n] == RANGE_NONE || seems_mm > reach_mm)
            continue;
        senses->feel = (uint8_t)(senses->feel | 1u << n);
        senses->range_mm[n] = (uint8_t)vector_whole(seems_mm > noise_mm ? seems_mm - noise_mm : 0.0);
    }
}

static void sense(const struct kit *kit, const struct world *world, const struct body *body, uint32_t tick,
                  struct senses *senses)
{
    uint8_t range_mm[FEEL_COUNT];

    if (senses->feel != 0) {
        measure(kit, world, body, range_mm);
        feel(kit, tick, range_mm, senses);
    }
    if (senses->look) {
        double far_mm = vector_whole(senses->beacon_mm
                                     * (1.0 + kit->trait[TRAIT_BEACON_NOISE] * chance(kit, tick, FEEL_COUNT)));

        senses->beacon_mm = (uint16_t)(far_mm < 1.0 ? 1.0 : far_mm > BEACON_MAX_MM ? BEACON_MAX_MM : far_mm);
    }
}

void kit_sense(struct kit *kit, const struct world *world, const struct body *body, uint32_t tick,
               struct senses *senses)
{
    unsigned late = kit->pushed ? 0 : (unsigned)kit->trait[TRAIT_SENSES_TICKS];
    uint8_t told_tick = senses->tick;

    if (kit->senses_differ)
        sense(kit, world, body, tick, senses);
    for (unsigned i = 0; i < KIT_SENSED && !kit->has_sensed; i++)
        kit->sensed[i] = *senses;
    kit->has_sensed = true;
    kit->sensed[tick % KIT_SENSED] = *senses;
    if (late > 0)
        *senses = kit->sensed[(tick - late) % KIT_SENSED];
    senses->tick = told_tick;
}
