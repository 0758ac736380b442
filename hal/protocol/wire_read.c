#include "hal/protocol/wire.h"

#include "hal/protocol/crc8.h"
#include "octet.h"

static bool is_whole(const struct frame *frame, uint8_t len)
{
    return frame->len == len && frame->data[0] == crc8_of_frame(frame);
}

void wire_init(struct wire *wire, uint8_t node)
{
    *wire = (struct wire){.node = node};
}

void wire_ids(const struct wire *wire, uint16_t ids[WIRE_LISTEN_COUNT])
{
    ids[0] = (uint16_t)wire_id(wire, OCTET_SENSES_FRAME_ID);
    ids[1] = (uint16_t)wire_id(wire, OCTET_COMMAND_FRAME_ID);
}

uint32_t wire_id(const struct wire *wire, uint32_t id_of_node_1)
{
    return id_of_node_1 + wire->node - 1u;
}

static void count_many(struct wire *wire, enum fault fault, unsigned more)
{
    unsigned sum = wire->faults[fault] + more;

    wire->faults[fault] = (uint8_t)(sum < UINT8_MAX ? sum : UINT8_MAX);
}

void wire_count(struct wire *wire, enum fault fault)
{
    count_many(wire, fault, 1);
}

void wire_outage(struct wire *wire)
{
    if (wire->knows_tick)
        wire_count(wire, FAULT_SILENCE);
    wire->knows_tick = false;
}

static enum input_kind refused(struct wire *wire, enum fault fault)
{
    wire_count(wire, fault);
    return INPUT_SILENCE;
}

/* Fresh is up to half a span ahead of the last; what is behind it came twice, or too late. */
static bool is_fresh(struct wire *wire, uint16_t tick)
{
    unsigned ahead = (unsigned)(tick - wire->tick) % TICK_SPAN;

    if (wire->knows_tick && (ahead == 0 || ahead >= TICK_SPAN / 2))
        return false;
    if (wire->knows_tick)
        count_many(wire, FAULT_MISSED, ahead - 1);
    wire->tick = tick;
    wire->knows_tick = true;
    return true;
}

static enum input_kind read_senses(struct wire *wire, const struct frame *frame, struct senses *senses)
{
    struct octet_senses_t got;

    if (!is_whole(frame, OCTET_SENSES_LENGTH) || octet_senses_unpack(&got, frame->data, frame->len) != 0)
        return refused(wire, FAULT_DAMAGED);
    if (!is_fresh(wire, got.tick))
        return refused(wire, FAULT_STALE);
    *senses = (struct senses){
        .tick = got.tick,
        .feel = got.feel,
        .bump = got.bump,
        .look = got.look,
        .beacon_mm = got.beacon,
        .odometer_left = got.odometer_left,
        .odometer_right = got.odometer_right,
    };
    return INPUT_SENSES;
}

static struct command command_from(const struct octet_command_t *got)
{
    struct command command = {.opcode = (enum opcode)got->opcode};

    switch (got->opcode) {
    case OPCODE_START:
        command.which = got->profile;
        command.value = got->seed;
        break;
    case OPCODE_SET:
        command.which = got->parameter;
        command.value = got->value;
        break;
    case OPCODE_WRITE:
        command.which = got->mask;
        command.value = got->cells;
        break;
    case OPCODE_FREEZE:
        command.which = got->freeze;
        break;
    default:
        break;
    }
    return command;
}

static enum input_kind read_command(struct wire *wire, const struct frame *frame, struct command *command)
{
    struct octet_command_t got;

    if (!is_whole(frame, OCTET_COMMAND_LENGTH) || octet_command_unpack(&got, frame->data, frame->len) < 0)
        return refused(wire, FAULT_DAMAGED);
    if (wire->knows_counter && got.counter == wire->counter)
        return refused(wire, FAULT_STALE);
    wire->counter = got.counter;
    wire->knows_counter = true;
    wire->opcode = got.opcode;
    wire->lockstep = got.lockstep;
    /* Whoever stops or starts the robot may count its ticks from anywhere. */
    if (got.opcode == OPCODE_STOP || got.opcode == OPCODE_START)
        wire->knows_tick = false;
    *command = command_from(&got);
    return INPUT_COMMAND;
}

enum input_kind wire_read(struct wire *wire, const struct frame *frame, struct input *in)
{
    if (frame->id == wire_id(wire, OCTET_SENSES_FRAME_ID))
        return read_senses(wire, frame, &in->senses);
    if (frame->id == wire_id(wire, OCTET_COMMAND_FRAME_ID))
        return read_command(wire, frame, &in->command);
    return refused(wire, FAULT_FOREIGN);
}
