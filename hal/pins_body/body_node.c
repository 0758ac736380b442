#include "hal/pins_body/body_node.h"

#include "hal/can_body/port.h"
#include "hal/pins_body/telemetry.h"
#include "hal/protocol/e2e.h"
#include "hal/protocol/wire.h"
#include "octet.h"

enum {
    TICK_MS_OF_BODY = 20,
    SILENT_TICKS = HAL_SILENCE_MS / TICK_MS_OF_BODY,
    FRAMES_MAX = 4,      /* handled per call */
    ORDERS = 2,
    JUMP = 7             /* counter step away from commands of an earlier session */
};

static struct wire wire;              /* one body per program */
static struct link *bus;
static struct command orders[ORDERS]; /* a queue; the first is in progress; opcode 0: empty */
static uint8_t counter;               /* of the first order */
static struct drive drive;
static uint8_t silent;                /* ticks since the last drive; stays at SILENT_TICKS */
static bool wants_ranges, running;

int telemetry_open(const struct port *port)
{
    uint16_t ids[2];

    wire_init(&wire, port->node);
    ids[0] = (uint16_t)wire_id(&wire, OCTET_DRIVE_FRAME_ID);
    ids[1] = (uint16_t)wire_id(&wire, OCTET_ANSWER_FRAME_ID);
    for (unsigned i = 0; i < ORDERS; i++)
        orders[i] = (struct command){.which = 0};
    counter = 0;
    silent = SILENT_TICKS;
    wants_ranges = running = false;
    return link_open(&bus, port->link, ids, 2) < 0 ? HAL_E_BODY : 0;
}

/* Accepts only the answer to the last senses: older drives are obsolete. */
static bool read_drive(const struct frame *frame)
{
    struct octet_drive_t got;

    if (!e2e_is_whole(frame, OCTET_DRIVE_LENGTH) || octet_drive_unpack(&got, frame->data, frame->len) != 0)
        return false;
    if (got.tick != wire.session.tick || got.counter != wire.session.counter || got.reason == REASON_SILENCE)
        return false;
    drive = (struct drive){.tick = got.tick, .left_mm_s = got.left, .right_mm_s = got.right,
                           .reason = (enum reason)got.reason, .eat = got.eat};
    silent = 0;
    return true;
}

static void read_answer(const struct frame *frame)
{
    struct octet_answer_t got;

    if (!e2e_is_whole(frame, OCTET_ANSWER_LENGTH) || octet_answer_unpack(&got, frame->data, frame->len) != 0
        || got.counter != counter || got.opcode != (uint8_t)orders[0].opcode)
        return;
    if (got.result == RESULT_OUT_OF_SEQUENCE) {
        counter = (uint8_t)((counter + JUMP) % E2E_COUNTERS);
        return;
    }
    if (got.opcode == OPCODE_START)
        wants_ranges = got.result == RESULT_DONE && (got.value & ANSWER_WANTS_RANGES) != 0;
    if (got.opcode == OPCODE_START || got.opcode == OPCODE_STOP)
        running = got.opcode == OPCODE_START && got.result == RESULT_DONE;
    orders[0] = orders[1];
    orders[1] = (struct command){.which = 0};
    counter = e2e_next(counter);
}

/* INPUT_PEER here means that a drive has arrived. */
enum input_kind telemetry_receive(struct input *in)
{
    (void)in;
    for (unsigned i = 0; i < FRAMES_MAX; i++) {
        struct frame frame;
        int result = link_receive(bus, &frame, 0);

        if (result != 1 && result != LINK_E_GARBLED)
            return INPUT_SILENCE;
        if (result == 1 && frame.id == wire_id(&wire, OCTET_ANSWER_FRAME_ID))
            read_answer(&frame);
        if (result == 1 && frame.id == wire_id(&wire, OCTET_DRIVE_FRAME_ID) && read_drive(&frame))
            return INPUT_PEER;
    }
    return INPUT_SILENCE;
}

static void say_order(void)
{
    const struct command *order = &orders[0];
    const struct octet_command_t command = {
        .counter = counter, .opcode = (uint8_t)order->opcode, .owner = BODY_NODE_OWNER,
        .profile = order->which, .seed = order->value, .parameter = order->which, .value = (uint16_t)order->value,
    };
    struct frame frame = {.id = wire_id(&wire, OCTET_COMMAND_FRAME_ID), .len = OCTET_COMMAND_LENGTH};

    (void)octet_command_pack(frame.data, &command, sizeof frame.data);
    e2e_protect(&frame);
    (void)link_send(bus, &frame);
}

static void say_ranges(const struct senses *senses, uint8_t with)
{
    const uint8_t *range_mm = senses->range_mm;
    const struct octet_ranges_t ranges = {
        .counter = with, .tick = senses->tick, .range_right = range_mm[0], .range_front_right = range_mm[1],
        .range_front = range_mm[2], .range_front_left = range_mm[3], .range_left = range_mm[4],
    };
    struct frame frame = {.id = wire_id(&wire, OCTET_RANGES_FRAME_ID), .len = OCTET_RANGES_LENGTH};

    (void)octet_ranges_pack(frame.data, &ranges, sizeof frame.data);
    e2e_protect(&frame);
    (void)link_send(bus, &frame);
}

/* A frame that the bus does not accept is not repeated: the next tick brings a newer one. */
void telemetry_senses(const struct senses *senses)
{
    struct frame frame;

    if (silent < SILENT_TICKS)
        silent++;
    if (orders[0].opcode != 0)
        say_order();
    wire_senses(&wire, senses, &frame);
    if (wants_ranges)
        say_ranges(senses, wire.session.counter);
    (void)link_send(bus, &frame);
}

bool telemetry_wants_ranges(void)
{
    return wants_ranges;
}

void telemetry_stored(int result)
{
    (void)result;
}

void telemetry_output(const struct output *out, bool asked)
{
    (void)out;
    (void)asked;
}

void body_node_order(const struct command *command)
{
    orders[orders[0].opcode == 0 ? 0 : 1] = *command;
}

void body_node_drive(struct output *out)
{
    *out = (struct output){.has_drive = true, .report.running = running, .drive = drive};
    if (silent == SILENT_TICKS)
        out->drive = (struct drive){.reason = REASON_STOP};
}
