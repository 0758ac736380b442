/* A body on pins: implements hal.h on the microcontroller's pins. */
#include "hal/can_body/port.h"
#include "hal/pins_body/body_parameters.h"
#include "hal/pins_body/inputs.h"
#include "hal/pins_body/guard.h"
#include "hal/pins_body/pins.h"
#include "hal/pins_body/telemetry.h"

enum {
    BEATS = 4,             /* in a tick of 20 ms: */
    BEAT_LIT = 0,          /* the LEDs have been on for a beat */
    BEAT_DARK = 1,         /* and off for one: all senses are known */
    BEAT_SHINE = 3,
    FRONT = 2,             /* the bit of the front sensor in feel */
    BURSTS_SEEN = 3,       /* of the four strong bursts that the beacon sends in a tick */
    BURSTS_NEAR = 6,       /* the weak bursts arrive too */
    NEAR_MM = 100,         /* food is within reach */
    FAR_MM = 1000
};

struct hal {
    struct wheel wheels[PINS_SIDES];
    struct guard guard;
    struct proximity proximity;
    struct button button;
    struct body_parameters parameters;
    int16_t told_mm_s[PINS_SIDES];
    uint8_t beat, tick;
    uint16_t bursts;       /* as of the last tick */
    bool running;
    bool calibrates;       /* the button was pressed at power-up: presses select a measurement */
    bool told_track;       /* the robot started by the button must receive its track next */
    bool asked;            /* the current command came from outside */
    struct output told;    /* the robot's output with the body's answer; kept here to save stack */
    bool unstored;         /* storing memory was put off */
    uint8_t memory[CELL_COUNT];
};

int hal_open(struct hal **hal, int argc, char *const argv[])
{
    static struct hal body;   /* one per program: main does not know its size */
    struct port port;
    int result = port_open(&port, argc, argv);

    if (result == 0)
        result = telemetry_open(&port);
    if (result < 0)
        return result;
    calibration_load(&body.parameters.values);
    parameters_apply(&body.parameters, &body.proximity, body.wheels);
    pins_open();
    body.calibrates = pins_button();
    port_ready(&port);
    *hal = &body;
    return 0;
}

/* Resets the controllers, position errors included. */
static void rest(struct hal *hal)
{
    for (unsigned side = 0; side < PINS_SIDES; side++) {
        hal->told_mm_s[side] = 0;
        hal->wheels[side].model_256 = hal->wheels[side].behind_um = 0;
    }
}

/* Runs a beat of the current measurement, if there is one. */
static void measure(struct hal *hal, const struct guard_look *seen)
{
    struct calibration *calibration = &hal->parameters.calibration;
    const struct calibrate_look look = {
        .counts = {seen->counts[0], seen->counts[1]}, .battery_mv = seen->battery_mv,
        .senses = hal->beat == BEAT_DARK, .back = hal->proximity.back, .has = PINS_SENSORS,
        .wall = hal->proximity.feel >> FRONT & 1u,
    };

    if (guard_forbids(&hal->guard) || seen->bumped)
        calibrate_interrupt(calibration);
    if (calibration->measures == MEASURE_NOTHING)
        return;
    if (calibrate_beat(calibration, &look, &hal->parameters.values)) {
        rest(hal);
        parameters_apply(&hal->parameters, &hal->proximity, hal->wheels);
        hal->parameters.unstored = calibration->refused == 0;
    } else {
        hal->told_mm_s[0] = calibrate_mm_s(calibration);
        hal->told_mm_s[1] = (int16_t)-hal->told_mm_s[0];
    }
}

/* Runs a beat of the wheels. Unsafe motion ends at once; the robot is informed with the next senses. */
static void run_wheels(struct hal *hal)
{
    uint32_t battery_mv = pins_battery_mv();
    struct guard_look look = {.battery_mv = battery_mv, .bumped = pins_bumped(), .failed = pins_bridge_failed()};

    for (unsigned side = 0; side < PINS_SIDES; side++)
        look.counts[side] = pins_count(side);
    if (guard_stops(&hal->guard, &look))
        rest(hal);
    pins_wake_bridge(!guard_forbids(&hal->guard));
    measure(hal, &look);
    for (unsigned side = 0; side < PINS_SIDES; side++) {
        int32_t duty = wheel_run(&hal->wheels[side], look.counts[side], hal->told_mm_s[side], battery_mv);

        if (hal->parameters.calibration.measures == MEASURE_MOTORS)
            duty = calibrate_duty(&hal->parameters.calibration);
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
        senses->range_mm[i] = telemetry_wants_ranges() ? proximity_range_mm(&hal->proximity, i) : (uint8_t)RANGE_NONE;
    telemetry_senses(senses);
}

/* Returns true once per tick, when all senses are known. */
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

/* In calibration mode, a start selects a measurement instead. */
static bool is_told(struct hal *hal, struct command *command)
{
    struct calibration *calibration = &hal->parameters.calibration;
    bool busy = hal->running || calibration->measures != MEASURE_NOTHING;

    if (hal->told_track) {
        hal->told_track = false;
        *command = (struct command){OPCODE_SET, WHEEL_TRACK_MM, parameters_value(&hal->parameters, BODY_TRACK_MM)};
        return true;
    }
    if (!button_look(&hal->button, pins_button(), busy, command))
        return false;
    if (command->opcode == OPCODE_STOP)
        calibrate_interrupt(calibration);
    if (command->opcode != OPCODE_START)
        return true;
    if (hal->calibrates && command->which < MEASURE_ENDS - 1)
        calibrate_begin(calibration, (uint8_t)(command->which + 1));
    if (hal->calibrates)
        return false;
    command->value = hal_entropy(hal);
    hal->told_track = true;
    return true;
}

static void live(const struct hal *hal)
{
    port_alive(guard_forbids(&hal->guard) || (hal->parameters.calibration.refused != 0 && !hal->running));
}

/* For what may erase a page: that stalls the machine for up to 40 ms, during which no motor may be pushed. */
static void let_go(struct hal *hal)
{
    for (unsigned side = 0; side < PINS_SIDES; side++) {
        hal->guard.duty[side] = 0;
        pins_push(side, 0);
    }
}

/* Commands to a robot at rest are taken before its next tick, so that no tick comes in between. */
static enum input_kind take_order(struct hal *hal, struct input *in)
{
    enum input_kind kind = telemetry_receive(in);

    hal->asked = kind == INPUT_COMMAND;
    if (hal->asked && hal->told_mm_s[0] == 0 && hal->told_mm_s[1] == 0) {
        hal->beat = BEAT_DARK;
        live(hal);
    }
    if (hal->asked) {
        if (!hal->running && hal->parameters.calibration.measures == MEASURE_NOTHING)
            let_go(hal);
        parameters_serve(&hal->parameters, &in->command, hal->running);
        parameters_apply(&hal->parameters, &hal->proximity, hal->wheels);
    }
    return kind;
}

int hal_receive(struct hal *hal, struct input *in)
{
    do {
        enum input_kind kind = take_order(hal, in);

        if (kind != INPUT_SILENCE)
            return (int)kind;
    } while (!pass_beat(hal));
    live(hal);
    if (is_told(hal, &in->command))
        return INPUT_COMMAND;
    fill_senses(hal, &in->senses);
    return INPUT_SENSES;
}

static int store(struct hal *hal, enum port_effort effort)
{
    int result;

    if (effort == PORT_AT_REST)
        let_go(hal);
    result = port_store(hal->memory, effort);
    hal->unstored = result == PORT_LATER;
    telemetry_stored(result);
    return hal->unstored ? 0 : result;
}

/* Stores only while the wheels are told to rest. */
static void store_later(struct hal *hal)
{
    if (hal->told_mm_s[0] != 0 || hal->told_mm_s[1] != 0)
        return;
    if (hal->unstored)
        (void)store(hal, PORT_AT_REST);
    if (hal->parameters.unstored)
        let_go(hal);
    parameters_store(&hal->parameters);
}

static void tell(struct hal *hal, const struct output *out)
{
    hal->told = *out;
    if (hal->asked)
        parameters_answer(&hal->parameters, &hal->told);
    telemetry_output(&hal->told, hal->asked);
}

int hal_send(struct hal *hal, const struct output *out)
{
    tell(hal, out);
    hal->running = out->report.running;
    if (hal->running)
        calibrate_interrupt(&hal->parameters.calibration);
    if (!out->has_drive || hal->parameters.calibration.measures != MEASURE_NOTHING)
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
    int result = port_load(memory);

    (void)hal;
    if (result < 0)
        telemetry_stored(result);
    return result;
}

int hal_store(struct hal *hal, const uint8_t memory[CELL_COUNT], bool at_rest)
{
    bool rests = at_rest && hal->parameters.calibration.measures == MEASURE_NOTHING;

    for (unsigned p = 0; p < CELL_COUNT; p++)
        hal->memory[p] = memory[p];
    return store(hal, rests ? PORT_AT_REST : PORT_QUICKLY);
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
