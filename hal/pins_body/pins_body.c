/* A robot of its own: hal.h on the microcontroller's pins. */
#include "hal/can_body/port.h"
#include "hal/pins_body/button.h"
#include "hal/pins_body/guard.h"
#include "hal/pins_body/pins.h"
#include "hal/pins_body/proximity.h"
#include "hal/pins_body/telemetry.h"
#include "hal/pins_body/wheel.h"

enum {
    BEATS = 4,             /* in a tick of 20 ms: */
    BEAT_LIT = 0,          /* the LEDs have been on for a beat */
    BEAT_DARK = 1,         /* and off for one: all that is sensed is known */
    BEAT_SHINE = 3,
    BURSTS_SEEN = 3,       /* of the four strong bursts that the beacon sends in a tick */
    BURSTS_NEAR = 6,       /* those that it sends weakly arrive too */
    NEAR_MM = 100,         /* within reach */
    FAR_MM = 1000
};

struct hal {
    struct wheel wheels[PINS_SIDES];
    struct guard guard;
    struct proximity proximity;
    struct button button;
    int16_t told_mm_s[PINS_SIDES];
    uint8_t beat, tick;
    uint16_t bursts;       /* as of the last tick */
    bool running;
    bool asked;            /* the command under way came from outside */
    bool unstored;         /* storing memory was put off */
    uint8_t memory[CELL_COUNT];
};

int hal_open(struct hal **hal, int argc, char *const argv[])
{
    static struct hal body;   /* one to a program; main knows no size to make room for */
    struct port port;
    int result = port_open(&port, argc, argv);

    if (result == 0)
        result = telemetry_open(&port);
    if (result < 0)
        return result;
    proximity_init(&body.proximity);
    pins_open();
    port_ready(&port);
    *hal = &body;
    return 0;
}

/* What the controllers still wanted to make up for is forgotten. */
static void rest(struct hal *hal)
{
    for (unsigned side = 0; side < PINS_SIDES; side++) {
        hal->told_mm_s[side] = 0;
        hal->wheels[side].model_256 = hal->wheels[side].behind_um = 0;
    }
}

/* A beat of the wheels. What is not safe ends at once; the robot learns of it with the next senses. */
static void run_wheels(struct hal *hal)
{
    uint32_t battery_mv = pins_battery_mv();
    struct guard_look look = {.battery_mv = battery_mv, .bumped = pins_bumped(), .failed = pins_bridge_failed()};

    for (unsigned side = 0; side < PINS_SIDES; side++)
        look.counts[side] = pins_count(side);
    if (guard_stops(&hal->guard, &look))
        rest(hal);
    pins_wake_bridge(!guard_forbids(&hal->guard));
    for (unsigned side = 0; side < PINS_SIDES; side++) {
        int32_t duty = wheel_run(&hal->wheels[side], look.counts[side], hal->told_mm_s[side], battery_mv);

        hal->guard.duty[side] = guard_forbids(&hal->guard) ? 0 : duty;
        pins_push(side, hal->guard.duty[side]);
    }
}

static void fill_senses(struct hal *hal, struct senses *senses)
{
    uint16_t dark[FEEL_COUNT], bursts = pins_bursts(), seen = (uint16_t)(bursts - hal->bursts);

    pins_measure(dark);
    hal->bursts = bursts;
    hal->tick++;
    *senses = (struct senses){
        .tick = hal->tick,
        .feel = proximity_feel(&hal->proximity, dark),
        .bump = pins_bumped(),
        .look = seen >= BURSTS_SEEN,
        .beacon_mm = seen >= BURSTS_NEAR ? NEAR_MM : seen >= BURSTS_SEEN ? FAR_MM : 0,
        .odometer_left = wheel_odometer(&hal->wheels[0]),
        .odometer_right = wheel_odometer(&hal->wheels[1]),
    };
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        senses->range_mm[i] = RANGE_NONE;
    telemetry_senses(senses);
}

/* True once a tick, when all is known that there is to sense. */
static bool pass_beat(struct hal *hal)
{
    pins_wait();
    run_wheels(hal);
    hal->beat = (uint8_t)((hal->beat + 1) % BEATS);
    if (hal->beat == BEAT_LIT)
        pins_measure(hal->proximity.lit);
    if (hal->beat == BEAT_LIT || hal->beat == BEAT_SHINE)
        pins_shine(hal->beat == BEAT_SHINE);
    return hal->beat == BEAT_DARK;
}

static bool is_told(struct hal *hal, struct command *command)
{
    if (!button_look(&hal->button, pins_button(), hal->running, command))
        return false;
    if (command->opcode == OPCODE_START)
        command->value = hal_entropy(hal);
    return true;
}

/* Orders to a robot whose wheels rest come before its next tick: that begins with them, so that none is in between. */
static enum input_kind take_order(struct hal *hal, struct input *in)
{
    enum input_kind kind = telemetry_receive(in);

    hal->asked = kind == INPUT_COMMAND;
    if (hal->asked && hal->told_mm_s[0] == 0 && hal->told_mm_s[1] == 0)
        hal->beat = BEAT_DARK;
    return kind;
}

int hal_receive(struct hal *hal, struct input *in)
{
    do {
        enum input_kind kind = take_order(hal, in);

        if (kind != INPUT_SILENCE)
            return (int)kind;
    } while (!pass_beat(hal));
    port_alive(guard_forbids(&hal->guard));
    if (is_told(hal, &in->command))
        return INPUT_COMMAND;
    fill_senses(hal, &in->senses);
    return INPUT_SENSES;
}

/* An erase stops the machine for up to 40 ms: only where the wheels rest. */
static void store_later(struct hal *hal)
{
    if (hal->unstored && hal->told_mm_s[0] == 0 && hal->told_mm_s[1] == 0)
        hal->unstored = port_store(hal->memory, PORT_AT_REST) == PORT_LATER;
}

int hal_send(struct hal *hal, const struct output *out)
{
    telemetry_output(out, hal->asked);
    hal->running = out->report.running;
    if (!out->has_drive)
        return 0;
    if (out->drive.reason == REASON_STOP)
        rest(hal);
    hal->told_mm_s[0] = out->drive.left_mm_s;
    hal->told_mm_s[1] = out->drive.right_mm_s;
    store_later(hal);
    return 0;
}

int hal_load(struct hal *hal, uint8_t memory[CELL_COUNT])
{
    (void)hal;
    return port_load(memory);
}

int hal_store(struct hal *hal, const uint8_t memory[CELL_COUNT], bool at_rest)
{
    int result = port_store(memory, at_rest ? PORT_AT_REST : PORT_QUICKLY);

    for (unsigned p = 0; p < CELL_COUNT; p++)
        hal->memory[p] = memory[p];
    hal->unstored = result == PORT_LATER;
    return hal->unstored ? 0 : result;
}

uint32_t hal_entropy(struct hal *hal)
{
    uint16_t light[FEEL_COUNT];
    uint32_t noise = 0;

    (void)hal;
    pins_measure(light);
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        noise = noise * 31u + light[i];
    return port_entropy() + noise;
}
