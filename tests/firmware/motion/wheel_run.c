#include "wheel_run.h"

#include "firmware/io.h"
#include "firmware/robot.h"

#include <math.h>
#include <string.h>

static double clamped(double x, double limit)
{
    return fmin(fmax(x, -limit), limit);
}

/* What the speed loop aims at. */
static double aim(const struct wheel_traits *traits, double order_mm_s)
{
    double aim = fabs(order_mm_s) < traits->dead_mm_s ? 0.0 : order_mm_s * traits->gain;

    return traits->fastest_mm_s > 0.0 ? clamped(aim, traits->fastest_mm_s) : aim;
}

static void roll_1_ms(struct real_wheel *wheel, const struct wheel_traits *traits, double aim_mm_s)
{
    double change = aim_mm_s - wheel->speed_mm_s;

    if (traits->lag_ms > 0.0)
        change *= 1.0 - exp(-1.0 / traits->lag_ms);
    if (traits->accel_mm_s2 > 0.0)
        change = clamped(change, traits->accel_mm_s2 / 1000.0);
    wheel->speed_mm_s += change;
    wheel->motor_mm += wheel->speed_mm_s / 1000.0;
    wheel->rim_mm = wheel->motor_mm + clamped(wheel->rim_mm - wheel->motor_mm, traits->slack_mm / 2.0);
}

void real_wheel_turn(struct real_wheel *wheel, const struct wheel_traits *traits, int16_t order_mm_s, unsigned tick_ms)
{
    memmove(wheel->orders + 1, wheel->orders, sizeof wheel->orders - sizeof *wheel->orders);
    wheel->orders[0] = order_mm_s;
    for (unsigned ms = 0; ms < tick_ms; ms++)
        roll_1_ms(wheel, traits, aim(traits, wheel->orders[traits->delay_ticks]));
}

uint16_t real_wheel_counts(const struct real_wheel *wheel)
{
    /* The little more keeps sums of whole counts whole. */
    return (uint16_t)((int64_t)floor(wheel->motor_mm * ODOMETER_COUNTS_PER_MM + 1e-6) & (ODOMETER_SPAN - 1));
}

enum {
    BLOCKED_TICKS = 100, BLOCKED_EVERY = 4,   /* something is in front of it in one of four times 2 s */
    TURN_COUNT = 16384,                       /* of turn_left, for one count */
    TICK_OF_20_MS = 20
};

struct rig {
    struct robot robot;
    struct output out;
    struct real_wheel left, right;
    bool turning, passing;   /* the action under way */
    int sign;                /* of the last turn */
    double carried_deg;      /* beyond its end the wheels would have rolled by themselves when it began */
};

static double degrees(double mm_apart)
{
    return mm_apart / 160.0 * 180.0 / 3.14159265358979323846;
}

static double to_turn_deg(const struct rig *rig)
{
    return degrees(rig->robot.motion.turn_left / (double)TURN_COUNT / ODOMETER_COUNTS_PER_MM);
}

static double hidden_deg(const struct rig *rig)
{
    return degrees(rig->left.motor_mm - rig->left.rim_mm - rig->right.motor_mm + rig->right.rim_mm);
}

static struct senses sensed(const struct rig *rig, int32_t tick)
{
    struct senses senses = {
        .tick = (uint8_t)tick,
        .feel = tick / BLOCKED_TICKS % BLOCKED_EVERY == BLOCKED_EVERY - 1 ? FEEL_FRONT : 0,
        .odometer_left = real_wheel_counts(&rig->left),
        .odometer_right = real_wheel_counts(&rig->right),
    };

    for (unsigned i = 0; i < FEEL_COUNT; i++)
        senses.range_mm[i] = RANGE_NONE;
    return senses;
}

/* An action has ended; this is what it left to turn. */
static void note_end(const struct rig *rig, struct wheel_figures *figures, double left_deg)
{
    double *worst = rig->turning ? &figures->left_deg : &figures->passed_deg;

    if (rig->turning && rig->passing)
        return;
    *worst = fmax(*worst, fabs(left_deg));
    if (rig->turning)
        figures->slack_deg = fmax(figures->slack_deg, fabs(left_deg + hidden_deg(rig)));
}

static void note_begin(struct rig *rig)
{
    rig->turning = rig->out.drive.reason == REASON_LOOK_AROUND || rig->out.drive.reason == REASON_TRIAL
        || rig->out.drive.reason == REASON_REMEMBERED || rig->out.drive.reason == REASON_BOREDOM;
    rig->passing = rig->out.drive.reason == REASON_LOOK_AROUND;
    if (!rig->turning)
        return;
    rig->sign = rig->robot.motion.turn_left < 0 ? -1 : 1;
    rig->carried_deg = rig->sign
        * (degrees(rig->robot.motion.apart.counts / (double)ODOMETER_COUNTS_PER_MM) - to_turn_deg(rig));
}

static int between(uint16_t before, uint16_t now)
{
    return ((now - before + ODOMETER_SPAN / 2) & (ODOMETER_SPAN - 1)) - ODOMETER_SPAN / 2;
}

static void live_a_tick(struct rig *rig, struct wheel_figures *figures, int32_t tick)
{
    const struct input in = {.senses = sensed(rig, tick)};
    const struct motion before = rig->robot.motion;
    uint8_t action = rig->robot.action;
    int apart = between(before.odometer_left, in.senses.odometer_left) - between(before.odometer_right, in.senses.odometer_right);
    double left_deg = to_turn_deg(rig) - degrees(before.referenced ? apart / (double)ODOMETER_COUNTS_PER_MM : 0.0);

    robot_respond(&rig->robot, INPUT_SENSES, &in, &rig->out);
    figures->denied += rig->out.denied;
    figures->over_deg = fmax(figures->over_deg, -rig->sign * left_deg - fmax(rig->carried_deg, 0.0));
    if (rig->robot.action == action)
        return;
    figures->actions++;
    note_end(rig, figures, left_deg);
    note_begin(rig);
}

struct wheel_figures wheel_run(uint8_t profile, uint32_t seed, int32_t ticks, const struct wheel_traits *traits)
{
    struct rig rig = {.sign = 0};
    struct wheel_figures figures = {.stopped_tick = -1};
    const struct input start = {.command = {OPCODE_START, profile, seed}};

    robot_init(&rig.robot, seed);
    robot_respond(&rig.robot, INPUT_COMMAND, &start, &rig.out);
    for (int32_t tick = 0; tick < ticks; tick++) {
        live_a_tick(&rig, &figures, tick);
        if (figures.stopped_tick < 0 && !rig.robot.running)
            figures.stopped_tick = tick;
        real_wheel_turn(&rig.left, traits, rig.out.drive.left_mm_s, TICK_OF_20_MS);
        real_wheel_turn(&rig.right, traits, rig.out.drive.right_mm_s, TICK_OF_20_MS);
    }
    for (unsigned p = 0; p < CELL_COUNT; p++)
        figures.lessons += rig.robot.brain.memory.cell[p] != 0;
    figures.way_mm = (rig.left.motor_mm + rig.right.motor_mm) / 2.0;
    return figures;
}
