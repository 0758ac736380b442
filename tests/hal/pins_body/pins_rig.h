/* pins_rig.h: fake pins, telemetry and port of a robot with a body of its own. */
#ifndef OCTET_TEST_PINS_RIG_H
#define OCTET_TEST_PINS_RIG_H

#include <string.h>

#include "tests/test.h"
#include "hal/can_body/port.h"
#include "hal/pins_body/pins.h"
#include "hal/pins_body/telemetry.h"

enum { BEATS = 4, GOOD_MV = 7200, MOST = 4000 };

static struct fake_pins {
    uint16_t counts[PINS_SIDES], light, ambient, bursts;
    int32_t duty[PINS_SIDES];
    bool awake, shines, bumped, pressed, failed;
    unsigned beats;
    uint32_t battery_mv;
} pins;

static struct fake_telemetry {
    struct input in;
    enum input_kind next;
    unsigned from_beat;   /* when it comes */
    struct senses sent;
    unsigned outputs;
    struct output out;    /* the last */
    bool asked, wants_ranges;
    int opens, stored;
} telemetry;

static struct fake_port {
    unsigned stores, alive;
    unsigned more;        /* records of the body that were stored, bit by bit */
    int result;
    enum port_effort effort;
    bool pushed;          /* a motor was, as something was stored */
    bool outage;
    uint8_t memory[CELL_COUNT];
} port;

static struct hal *hal;
static struct input in;   /* what was received last */

const uint8_t PINS_SENSORS = 31;

void pins_open(void) { pins.beats = 0; }
uint16_t pins_count(unsigned side) { return pins.counts[side]; }
void pins_push(unsigned side, int32_t duty) { pins.duty[side] = duty; }
void pins_wake_bridge(bool awake) { pins.awake = awake; }
bool pins_bridge_failed(void) { return pins.failed; }
void pins_shine(bool on) { pins.shines = on; }
uint32_t pins_battery_mv(void) { return pins.battery_mv; }
uint16_t pins_bursts(void) { return pins.bursts; }
bool pins_bumped(void) { return pins.bumped; }
bool pins_button(void) { return pins.pressed; }

/* The converter samples with the LEDs as they were in the beat that ends. */
static uint16_t sampled;

void pins_wait(void)
{
    pins.beats++;
    sampled = (uint16_t)(pins.ambient + (pins.shines ? pins.light : 0));
}

void pins_measure(uint16_t light[FEEL_COUNT])
{
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        light[i] = sampled;
}

int telemetry_open(const struct port *opened) { (void)opened; return telemetry.opens; }
void telemetry_senses(const struct senses *senses) { telemetry.sent = *senses; }

bool telemetry_wants_ranges(void) { return telemetry.wants_ranges; }
void telemetry_stored(int result) { telemetry.stored = result; }

void telemetry_output(const struct output *out, bool asked)
{
    telemetry.out = *out;
    telemetry.outputs++;
    telemetry.asked = asked;
}

enum input_kind telemetry_receive(struct input *taken)
{
    enum input_kind kind = telemetry.next;

    if (pins.beats < telemetry.from_beat)
        return INPUT_SILENCE;
    telemetry.next = INPUT_SILENCE;
    if (kind != INPUT_SILENCE)
        *taken = telemetry.in;
    return kind;
}

int port_open(struct port *opened, int argc, char *const argv[])
{
    (void)argv;
    *opened = (struct port){.node = 1};
    return argc < 0 ? HAL_E_USAGE : 0;
}

void port_ready(const struct port *opened) { (void)opened; }
uint32_t port_clock_ms(void) { return 0; }
void port_alive(bool outage) { port.alive++; port.outage = outage; }
int port_load(uint8_t memory[CELL_COUNT]) { memory[0] = 7; return port.result < 0 ? port.result : 1; }
uint32_t port_entropy(void) { return 1000; }

int port_load_more(unsigned which, uint8_t bytes[CELL_COUNT]) { (void)which; (void)bytes; return 0; }

int port_store_more(unsigned which, const uint8_t bytes[CELL_COUNT])
{
    (void)bytes;
    port.more |= 1u << which;
    port.pushed = pins.duty[0] != 0 || pins.duty[1] != 0;
    return 0;
}

int port_store(const uint8_t memory[CELL_COUNT], enum port_effort effort)
{
    port.stores++;
    port.effort = effort;
    port.pushed = pins.duty[0] != 0 || pins.duty[1] != 0;
    memcpy(port.memory, memory, CELL_COUNT);
    return effort == PORT_AT_REST ? 0 : port.result;
}

static inline void send_rest(bool running)
{
    const struct output out = {.has_drive = true, .report.running = running, .drive = {.reason = REASON_STOP}};

    TEST_ASSERT_EQUAL_INT(0, hal_send(hal, &out));
}

/* There is one body to a program: each test goes on with a new tick of it. */
void setUp(void)
{
    memset(&pins, 0, sizeof pins);
    memset(&telemetry, 0, sizeof telemetry);
    memset(&port, 0, sizeof port);
    pins.battery_mv = GOOD_MV;
    TEST_ASSERT_EQUAL_INT(0, hal_open(&hal, 0, NULL));
    (void)hal_receive(hal, &in);
    send_rest(false);
    telemetry.outputs = 0;
}

static inline const struct senses *sense(void)
{
    TEST_ASSERT_EQUAL_INT(INPUT_SENSES, hal_receive(hal, &in));
    return &in.senses;
}

static inline void drive(int16_t left_mm_s, int16_t right_mm_s)
{
    const struct output out = {
        .has_drive = true, .report.running = true,
        .drive = {.left_mm_s = left_mm_s, .right_mm_s = right_mm_s,
                  .reason = left_mm_s != 0 || right_mm_s != 0 ? REASON_WANDER : REASON_STOP},
    };

    TEST_ASSERT_EQUAL_INT(0, hal_send(hal, &out));
}

static inline void run_ticks(unsigned ticks)
{
    for (unsigned i = 0; i < ticks; i++)
        (void)sense();
}

/* The button is held for ten ticks and let go: the opcode of the command that comes then. */
static inline int opcode_after_press_within(unsigned ticks)
{
    int kind = INPUT_SENSES;

    pins.pressed = true;
    run_ticks(10);
    pins.pressed = false;
    for (unsigned i = 0; i < ticks && kind == INPUT_SENSES; i++)
        kind = hal_receive(hal, &in);
    TEST_ASSERT_EQUAL_INT(INPUT_COMMAND, kind);
    return (int)in.command.opcode;
}

#endif
