/* pins_rig.h: fake pins, telemetry and port of a robot with a body of its own. */
#ifndef OCTET_TEST_PINS_RIG_H
#define OCTET_TEST_PINS_RIG_H

#include "hal/can_body/port.h"
#include "hal/pins_body/pins.h"

enum { BEATS = 4, GOOD_MV = 7200, MOST = 4000 };

extern struct fake_pins {
    uint16_t counts[PINS_SIDES], light, ambient, bursts;
    int32_t duty[PINS_SIDES];
    bool awake, shines, bumped, pressed, failed;
    unsigned beats;
    uint32_t battery_mv;
} pins;

extern struct fake_telemetry {
    struct input in;
    enum input_kind next;
    unsigned from_beat;   /* when it comes */
    struct senses sent;
    unsigned outputs;
    struct output out;    /* the last */
    bool asked, wants_ranges;
    int opens, stored;
} telemetry;

extern struct fake_port {
    unsigned stores, alive;
    unsigned more;        /* records of the body that were stored, bit by bit */
    int result;
    enum port_effort effort;
    bool pushed;          /* a motor was, as something was stored */
    bool outage;
    uint8_t memory[CELL_COUNT];
} port;

extern struct hal *hal;
extern struct input in;   /* what was received last */

const struct senses *sense(void);
void run_ticks(unsigned ticks);
void send_rest(bool running);
void drive(int16_t left_mm_s, int16_t right_mm_s);

int opcode_after_press_within(unsigned ticks);
        /* The button is held for ten ticks and let go: the opcode of the command that comes then. */

#endif
