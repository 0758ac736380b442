#include "host_sim/world/native/kit.h"

#include "hal/pins_body/proximity.h"
#include "host_sim/world/native/vector_sums.h"

enum { PARTS = 4, STREAMS = 8 };   /* of a tick of 20 ms: a period of the controller each; random numbers of a tick */

static const uint64_t SLIPS = 1u << 16, SENSES = (uint64_t)1 << 48;   /* where these random numbers begin */


static const double FREE_MM_S = 674.0, DEAD_DUTY = 0.08, NOMINAL_V = 7.2;
static const double DUTY_ONE = 65536.0, MV_PER_V = 1000.0, MS_PER_S = 1000.0;

/* name, least, most, ideal, kit, tolerance */
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
    [TRAIT_SENSES_TICKS] = {"senses_ticks", 0, KIT_DELAY_MAX, 0, 1, 0},
    [TRAIT_DRIVES_TICKS] = {"drives_ticks", 0, KIT_DELAY_MAX, 0, 0, 0},
    [TRAIT_MOTOR_MS] = {"motor_ms", 0, 1000, 0, 60, 15},
    [TRAIT_LEFT_MOTOR] = {"left_motor", 0, 2, 1, 1, 0.1},
    [TRAIT_RIGHT_MOTOR] = {"right_motor", 0, 2, 1, 1, 0.1},
    [TRAIT_BATTERY_V] = {"battery_v", 3, 12, 7.2, 7.4, 0.6},
    [TRAIT_SAG_V] = {"sag_v", 0, 3, 0, 0.3, 0.1},
    [TRAIT_RIGHT_MM] = {"right_mm", 0, 90, 60, 60, 6},
    [TRAIT_FRONT_RIGHT_MM] = {"front_right_mm", 0, 90, 60, 60, 6},
    [TRAIT_FRONT_MM] = {"front_mm", 0, 90, 60.5, 60, 6},
    [TRAIT_FRONT_LEFT_MM] = {"front_left_mm", 0, 90, 60, 60, 6},
    [TRAIT_LEFT_MM] = {"left_mm", 0, 90, 60, 60, 6},
    [TRAIT_HYSTERESIS_MM] = {"hysteresis_mm", 0, 30, 0, 4, 1},
    [TRAIT_NOISE_MM] = {"noise_mm", 0, 30, 0, 1, 0},
    [TRAIT_WALL] = {"wall", 0.1, 1, 1, 1, 0},
    [TRAIT_BEAM_DEG] = {"beam_deg", 0, 30, 0, 2, 1},
    [TRAIT_BEACON_NOISE] = {"beacon_noise", 0, 1, 0, 0.1, 0},
};

static double limited(double x, double least, double most)
{
    return x < least ? least : x > most ? most : x;
}

/* From -1 up to 1, each as likely. */
static double chance(const struct kit *kit, uint64_t number)
{
    return (double)(body_faults_mix(kit->key + number) >> 32) / 2147483648.0 - 1.0;
}

void kit_draw(struct kit *kit, const double *trait, const double *tolerance, uint64_t key)
{
    *kit = (struct kit){.key = key, .ranges = kit->ranges};
    for (unsigned i = 0; i < TRAIT_COUNT; i++) {
        bool wheels = i < TRAIT_RIGHT_MM;
        double value = trait[i] + tolerance[i] * chance(kit, i);

        kit->trait[i] = limited(value, KIT_TRAITS[i].least, KIT_TRAITS[i].most);
        if (kit->trait[i] < KIT_TRAITS[i].ideal || kit->trait[i] > KIT_TRAITS[i].ideal)
            *(wheels ? &kit->wheels_differ : &kit->senses_differ) = true;
    }
}

/* What a first-order lag gains in a time of what is missing; exact to the second order. */
static double gain(double time_ms, double lag_ms)
{
    double part = lag_ms > 0.0 ? time_ms / lag_ms : 2.0;

    return part < 2.0 ? part / (1.0 + part / 2.0) : 1.0;
}

static double whole_down(double number)
{
    double whole = vector_whole(number);

    return whole > number ? whole - 1.0 : whole;
}

/* Speed toward which a motor settles at its duty. */
static double pushed_mm_s(const struct kit *kit, const struct kit_wheel *wheel, double strength)
{
    double sag_v = kit->trait[TRAIT_SAG_V] * (__builtin_fabs(kit->wheels[0].duty) + __builtin_fabs(kit->wheels[1].duty)) / 2.0;
    double push = wheel->duty * (kit->trait[TRAIT_BATTERY_V] - sag_v) / NOMINAL_V;

    if (push > DEAD_DUTY)
        return (push - DEAD_DUTY) * FREE_MM_S * strength;
    return push < -DEAD_DUTY ? (push + DEAD_DUTY) * FREE_MM_S * strength : 0.0;
}

uint16_t kit_count(const struct kit *kit, unsigned side)
{
    return (uint16_t)(int64_t)whole_down(kit->wheels[side].motor_mm * (256.0 * MS_PER_S / WHEEL_COUNT_256));
}

static void turn_motor(struct kit *kit, unsigned side)
{
    struct kit_wheel *wheel = &kit->wheels[side];

    wheel->speed_mm_s += (pushed_mm_s(kit, wheel, kit->trait[TRAIT_LEFT_MOTOR + side]) - wheel->speed_mm_s)
                       * kit->motor_gain;
}

/* A period of the board's controller and its motor. */
static void run_motor(struct kit *kit, unsigned side)
{
    struct kit_wheel *wheel = &kit->wheels[side];
    uint32_t battery_mv = (uint32_t)(kit->trait[TRAIT_BATTERY_V] * MV_PER_V);

    wheel->duty = wheel_run(&wheel->control, kit_count(kit, side), (int16_t)vector_whole(wheel->told_mm_s), battery_mv) * (1.0 / DUTY_ONE);
    turn_motor(kit, side);
}

static void turn_wheel(struct kit *kit, unsigned side, double period_ms)
{
    struct kit_wheel *wheel = &kit->wheels[side];
    double slack_mm = kit->trait[TRAIT_SLACK_MM] / 2.0;

    wheel->motor_mm += wheel->speed_mm_s * period_ms / MS_PER_S;
    wheel->wheel_mm = limited(wheel->wheel_mm, wheel->motor_mm - slack_mm, wheel->motor_mm + slack_mm);
}

void kit_push(struct kit *kit, const int32_t duty[KIT_WHEELS])
{
    kit->pushed = kit->wheels_differ = true;
    kit->motor_gain = gain(WHEEL_PERIOD_MS, kit->trait[TRAIT_MOTOR_MS]);
    for (unsigned side = 0; side < KIT_WHEELS; side++)
        kit->wheels[side].duty = duty[side] * (1.0 / DUTY_ONE);
    for (unsigned side = 0; side < KIT_WHEELS; side++) {
        turn_motor(kit, side);
        turn_wheel(kit, side, WHEEL_PERIOD_MS);
    }
}

static void run_wheel(struct kit *kit, unsigned side, double order_mm_s, double period_ms)
{
    struct kit_wheel *wheel = &kit->wheels[side];
    double step_mm_s = kit->trait[TRAIT_ACCELERATION_MM_S2] * period_ms / MS_PER_S;

    if (__builtin_fabs(order_mm_s) < kit->trait[TRAIT_DEAD_MM_S])
        order_mm_s = 0.0;
    wheel->told_mm_s += limited((order_mm_s - wheel->told_mm_s) * kit->lag_gain, -step_mm_s, step_mm_s);
    if (kit->trait[TRAIT_MOTOR_MS] > 0.0)
        run_motor(kit, side);
    else
        wheel->speed_mm_s = wheel->told_mm_s;
    turn_wheel(kit, side, period_ms);
}

static double counted(const struct kit *kit, double way_mm)
{
    double count_mm = kit->trait[TRAIT_COUNT_MM];

    return count_mm > 0.0 ? whole_down(way_mm / count_mm) * count_mm : way_mm;
}

static void order(struct kit *kit, const double *way_mm, double tick_s)
{
    for (unsigned i = (unsigned)kit->trait[TRAIT_DRIVES_TICKS]; i > 0; i--)
        for (unsigned side = 0; side < KIT_WHEELS; side++)
            kit->told[i][side] = kit->told[i - 1][side];
    for (unsigned side = 0; side < KIT_WHEELS; side++)
        kit->told[0][side] = way_mm[side] / tick_s;
}

double kit_roll(struct kit *kit, double tick_s, double *counted_mm, double *rolled_mm)
{
    unsigned late = (unsigned)kit->trait[TRAIT_DRIVES_TICKS];

    if (!kit->wheels_differ)
        return 1.0;
    order(kit, rolled_mm, tick_s);
    kit->moved++;
    kit->lag_gain = gain(tick_s * MS_PER_S / PARTS, kit->trait[TRAIT_LAG_MS]);
    kit->motor_gain = gain(tick_s * MS_PER_S / PARTS, kit->trait[TRAIT_MOTOR_MS]);
    for (unsigned side = 0; side < KIT_WHEELS; side++) {
        struct kit_wheel *wheel = &kit->wheels[side];
        double slip = kit->trait[TRAIT_SLIP] * (1.0 + chance(kit, SLIPS + (uint64_t)kit->moved * KIT_WHEELS + side)) / 2.0;

        for (unsigned i = 0; i < PARTS && !kit->pushed; i++)
            run_wheel(kit, side, kit->told[late][side], tick_s * MS_PER_S / PARTS);
        counted_mm[side] = counted(kit, wheel->motor_mm) - counted(kit, wheel->motor_was_mm);
        rolled_mm[side] = (wheel->wheel_mm - wheel->wheel_was_mm) * kit->trait[TRAIT_LEFT_WHEEL + side] * (1.0 - slip);
        wheel->motor_was_mm = wheel->motor_mm;
        wheel->wheel_was_mm = wheel->wheel_mm;
    }
    return kit->trait[TRAIT_TRACK];
}

double kit_beam_mm(const struct kit *kit, double far_mm, double ideal_mm)
{
    static const double RAD_PER_DEG = 0.017453292519943295;

    return ideal_mm + 2.0 * far_mm * kit->trait[TRAIT_BEAM_DEG] * RAD_PER_DEG;
}

/* How far a sensor reaches in this tick. */
static double reach(const struct kit *kit, uint32_t tick, unsigned sensor)
{
    double reach_mm = kit->trait[TRAIT_RIGHT_MM + sensor] * kit->trait[TRAIT_WALL];

    return reach_mm + kit->trait[TRAIT_NOISE_MM] * chance(kit, SENSES + (uint64_t)tick * STREAMS + sensor);
}

/* Behind its window, a pair sees about as if it were so much farther away. */
void kit_light(const struct kit *kit, const struct world *world, const struct body *body, uint32_t tick, uint16_t light[FEEL_COUNT])
{
    static const double BEHIND_MM = 20.0, MOST = 4095.0;
    uint8_t range_mm[FEEL_COUNT] = {RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE, RANGE_NONE};

    if (body->feel != 0)
        ranges_measure(kit->ranges, world, body, range_mm);
    for (unsigned n = 0; n < FEEL_COUNT; n++) {
        double part = (reach(kit, tick, n) + BEHIND_MM) / (range_mm[n] + BEHIND_MM);

        light[n] = range_mm[n] == RANGE_NONE ? 0 : (uint16_t)limited(PROXIMITY_NEAR * part * part, 0.0, MOST);
    }
}

/* A sensor is triggered within its reach, and lets go farther away. */
static uint8_t feel(struct kit *kit, const uint8_t *range_mm)
{
    unsigned triggered = 0;

    for (unsigned n = 0; n < FEEL_COUNT; n++) {
        double reach_mm = reach(kit, kit->tick, n);

        if ((unsigned)kit->feel >> n & 1u)
            reach_mm += kit->trait[TRAIT_HYSTERESIS_MM];
        triggered |= (range_mm[n] != RANGE_NONE && range_mm[n] <= reach_mm ? 1u : 0u) << n;
    }
    return (uint8_t)triggered;
}

static void see(struct kit *kit, struct senses *senses)
{
    double far_mm = senses->beacon_mm * (1.0 + kit->trait[TRAIT_BEACON_NOISE] * chance(kit, SENSES + (uint64_t)kit->tick * STREAMS + FEEL_COUNT));

    if (senses->look)
        senses->beacon_mm = (uint16_t)limited(vector_whole(far_mm), 1.0, 8191.0);
}

void kit_sense(struct kit *kit, const struct world *world, const struct body *body, uint32_t tick, struct senses *senses)
{
    unsigned late = kit->pushed ? 0 : (unsigned)kit->trait[TRAIT_SENSES_TICKS];
    uint8_t range_mm[FEEL_COUNT], told_tick = senses->tick;

    if (kit->has_sensed && tick == kit->tick) {
        *senses = kit->told_senses;
        return;
    }
    kit->has_sensed = true;
    kit->tick = tick;
    if (kit->senses_differ) {
        if (senses->feel != 0)
            ranges_measure(kit->ranges, world, body, range_mm);
        kit->feel = senses->feel == 0 ? 0 : feel(kit, range_mm);
        senses->feel = kit->feel;
        see(kit, senses);
    }
    for (unsigned i = late; i > 0; i--)
        kit->sensed[i] = kit->sensed[i - 1];
    kit->sensed[0] = *senses;
    if (late > 0)
        *senses = kit->sensed[late];
    senses->tick = told_tick;
    kit->told_senses = *senses;
}
