/* A robot with a body on pins sends the same frames on a CAN bus as a separate robot and body, so that the same tools
 * can follow it. */
#include "hal/pins_body/telemetry.h"

#include "hal/can_body/port.h"
#include "hal/protocol/wire.h"
#include "octet.h"

enum { COMMANDS_MAX = 4 };   /* frames handled per call */

static struct wire wire;     /* one robot per program */
static struct link *bus;
static struct frame boot;
static bool announced;
static struct frame frames[WIRE_FRAMES_MAX];   /* being sent */

int telemetry_open(const struct port *port)
{
    uint16_t ids[WIRE_LISTEN_COUNT];

    wire_init(&wire, port->node);
    wire.health.reset_cause = port->reset_cause;
    wire.health.crash = port->crash;
    wire.health.clock_exact = port->clock_exact;
    wire_ids(&wire, ids);
    if (link_open(&bus, port->link, ids, WIRE_LISTEN_COUNT) < 0)
        return HAL_E_BODY;
    wire_boot(&wire, &boot);
    announced = false;
    return 0;
}

static void say(const struct frame *frame)
{
    if (link_send(bus, frame) < 0)
        wire_count(&wire, FAULT_UNSENT);
}

/* Ignores senses from another body with our number: ours come from the pins. */
static enum input_kind read_frame(const struct frame *frame, struct input *in)
{
    enum input_kind kind;

    if (frame->id == wire_id(&wire, OCTET_SENSES_FRAME_ID) || frame->id == wire_id(&wire, OCTET_RANGES_FRAME_ID)) {
        wire_count(&wire, FAULT_FOREIGN);
        return INPUT_SILENCE;
    }
    kind = wire_read(&wire, frame, in);
    if (wire.again != NULL)
        say(wire.again);
    return kind;
}

enum input_kind telemetry_receive(struct input *in)
{
    enum input_kind kind = INPUT_SILENCE;

    for (unsigned i = 0; i < COMMANDS_MAX && kind == INPUT_SILENCE; i++) {
        struct frame frame;
        int result = link_receive(bus, &frame, 0);

        if (result == LINK_E_GARBLED)
            wire_count(&wire, FAULT_DAMAGED);
        else if (result != 1)
            break;
        else
            kind = read_frame(&frame, in);
    }
    return kind;
}

void telemetry_senses(const struct senses *senses)
{
    struct frame frame;

    if (!announced)
        announced = link_send(bus, &boot) == 0;
    wire_senses(&wire, senses, &frame);
    say(&frame);
}

bool telemetry_wants_ranges(void)
{
    return false;
}

void telemetry_stored(int result)
{
    wire.health.unstored = result == PORT_LATER;
    if (result == HAL_E_STORE)
        wire_count(&wire, FAULT_UNSAVED);
}

void telemetry_output(const struct output *out, bool asked)
{
    size_t count;

    if (out->has_report)
        link_health(bus, &wire.health.bus);
    wire.unasked = wire.unasked || (out->has_answer && !asked);
    count = wire_write(&wire, out, frames);
    for (size_t i = 0; i < count; i++)
        say(&frames[i]);
}
