#include "hal/protocol/wire.h"

#include "hal/flash_store/crc32.h"
#include "hal/protocol/e2e.h"
#include "octet.h"

enum {
    STRANGERS_MIN = 2,   /* within a second indicate a twin: one noisy frame in some thousands has a valid CRC */
    MEMORY_FAMILY = (int)OCTET_MEMORY_FRAME_ID - 1,
    HALF = CELL_COUNT / 2
};

typedef char a_family_holds_the_memories_of_all_nodes
    [((int)MEMORY_FAMILY & (int)LINK_FAMILY_BITS) == 0 && (int)NODE_MAX == (int)LINK_FAMILY_BITS ? 1 : -1];

void wire_init(struct wire *wire, uint8_t node)
{
    *wire = (struct wire){.node = node};
}

void wire_ids(const struct wire *wire, uint16_t ids[WIRE_LISTEN_COUNT])
{
    static const uint16_t of_node_1[WIRE_LISTEN_COUNT - 1] = {
        OCTET_SENSES_FRAME_ID, OCTET_RANGES_FRAME_ID, OCTET_COMMAND_FRAME_ID, OCTET_DRIVE_FRAME_ID,
        OCTET_HEARTBEAT_FRAME_ID,
    };

    for (unsigned i = 0; i < WIRE_LISTEN_COUNT - 1; i++)
        ids[i] = (uint16_t)wire_id(wire, of_node_1[i]);
    ids[WIRE_LISTEN_COUNT - 1] = LINK_FAMILY | MEMORY_FAMILY;
}

uint32_t wire_id(const struct wire *wire, uint32_t id_of_node_1)
{
    return id_of_node_1 + wire->node - 1u;
}

static void count_many(struct wire *wire, enum fault fault, unsigned more)
{
    unsigned sum = wire->faults[fault] + more;

    if (more == 0)
        return;
    wire->noisy = wire->noisy || fault == FAULT_DAMAGED;
    wire->faults[fault] = (uint8_t)(sum < UINT8_MAX ? sum : UINT8_MAX);
    if (wire->news == 0)
        wire->first_news = (uint8_t)fault;
    wire->news = (uint16_t)(wire->news | 1u << fault);
}

void wire_count(struct wire *wire, enum fault fault)
{
    count_many(wire, fault, 1);
}

void wire_outage(struct wire *wire)
{
    wire->session.hears = false;
    if (wire->session.lockstep)
        return;
    if (wire->session.knows_tick)
        wire_count(wire, FAULT_SILENCE);
    wire->session.knows_tick = false;
}

static enum input_kind refused(struct wire *wire, enum fault fault)
{
    wire_count(wire, fault);
    return INPUT_SILENCE;
}

static enum input_kind say_again(struct wire *wire, const struct frame *frame)
{
    if (frame->len != 0)
        wire->again = frame;
    return INPUT_SILENCE;
}

static bool have_ranges(const struct wire *wire, uint8_t tick)
{
    return wire->has_ranges && wire->ranges_tick == tick;
}

static void fill_senses(const struct wire *wire, const struct octet_senses_t *got, struct senses *senses)
{
    *senses = (struct senses){
        .tick = got->tick,
        .feel = got->feel,
        .bump = got->bump,
        .look = got->look,
        .beacon_mm = got->beacon,
        .odometer_left = got->odometer_left,
        .odometer_right = got->odometer_right,
    };
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        senses->range_mm[i] = have_ranges(wire, got->tick) ? wire->range_mm[i] : RANGE_NONE;
}

/* Two different SENSES for one tick cannot both be the owner's, so held must no longer match what the owner computes.
 * On a noisy line one in 256 damaged frames has a valid CRC, but hardly the same one twice. */
static void note_other(struct wire *wire, const struct frame *frame, uint8_t tick)
{
    uint8_t crc = frame->data[0];

    if (!wire->session.knows_tick || tick != wire->session.tick || crc == wire->senses_crc)
        return;
    if (!wire->noisy || crc == wire->other_crc)
        wire->session.told = crc32_more(wire->session.told, &frame->data[1], OCTET_SENSES_LENGTH - 1u);
    wire->other_crc = crc;
}

/* Each byte of the senses is combined with that of the drive that answered those before. */
static void hold(struct wire *wire, const struct frame *senses, bool are_first)
{
    static const uint8_t none[OCTET_DRIVE_LENGTH];
    const uint8_t *drive = are_first ? none : wire->drive.data;
    uint8_t both[OCTET_SENSES_LENGTH];

    if (wire->session.owner == 0)
        return;
    for (unsigned i = 1; i < OCTET_SENSES_LENGTH; i++)
        both[i] = senses->data[i] ^ drive[i];
    wire->session.heard = crc32_more(wire->session.heard, &both[1], OCTET_SENSES_LENGTH - 1u);
}

static enum input_kind read_senses(struct wire *wire, const struct frame *frame, struct senses *senses)
{
    struct octet_senses_t got;
    unsigned missed = 0;
    bool are_first = !wire->session.knows_tick;

    if (!e2e_is_whole(frame, OCTET_SENSES_LENGTH) || octet_senses_unpack(&got, frame->data, frame->len) != 0)
        return refused(wire, FAULT_DAMAGED);
    note_other(wire, frame, got.tick);
    /* In lockstep the owner sends RANGES and SENSES again. */
    if (wire->session.lockstep && wire->wants_ranges && !have_ranges(wire, got.tick))
        return refused(wire, FAULT_MISSED);
    switch (session_senses(&wire->session, got.tick, got.counter, &missed)) {
    case ARRIVAL_AGAIN:
        return say_again(wire, &wire->drive);
    case ARRIVAL_STALE:
        return refused(wire, FAULT_STALE);
    case ARRIVAL_FRESH:
        break;
    }
    count_many(wire, FAULT_MISSED, missed);
    hold(wire, frame, are_first);
    wire->senses_crc = wire->other_crc = frame->data[0];
    fill_senses(wire, &got, senses);
    return INPUT_SENSES;
}

static enum input_kind read_ranges(struct wire *wire, const struct frame *frame)
{
    struct octet_ranges_t got;

    if (!e2e_is_whole(frame, OCTET_RANGES_LENGTH) || octet_ranges_unpack(&got, frame->data, frame->len) != 0)
        return refused(wire, FAULT_DAMAGED);
    if (!wire->wants_ranges)
        return refused(wire, FAULT_FOREIGN);
    wire->has_ranges = true;
    wire->ranges_tick = got.tick;
    wire->range_mm[0] = got.range_right;
    wire->range_mm[1] = got.range_front_right;
    wire->range_mm[2] = got.range_front;
    wire->range_mm[3] = got.range_front_left;
    wire->range_mm[4] = got.range_left;
    return INPUT_SILENCE;
}

static struct request request_from(const struct octet_command_t *got)
{
    struct request request = {.counter = got->counter, .owner = got->owner};
    struct command *command = &request.command;

    command->opcode = (enum opcode)got->opcode;
    switch (got->opcode) {
    case OPCODE_START:
        command->which = got->profile;
        command->value = got->seed;
        request.lockstep = got->lockstep;
        break;
    case OPCODE_SET:
        command->which = got->parameter;
        command->value = got->value;
        break;
    case OPCODE_GET:
        command->which = got->wanted;
        break;
    case OPCODE_WRITE:
        command->which = (uint8_t)(got->half << 4 | got->mask);
        command->value = (uint32_t)got->byte_0 | (uint32_t)got->byte_1 << 8 | (uint32_t)got->byte_2 << 16
            | (uint32_t)got->byte_3 << 24;
        break;
    case OPCODE_FREEZE:
        command->which = got->freeze;
        break;
    default:
        break;
    }
    return request;
}

static enum input_kind refuse_command(struct wire *wire, const struct request *request, enum result why)
{
    const struct octet_answer_t answer = {
        .counter = request->counter,
        .opcode = (uint8_t)request->command.opcode,
        .result = (uint8_t)why,
    };

    wire->refusal = (struct frame){.id = wire_id(wire, OCTET_ANSWER_FRAME_ID), .len = OCTET_ANSWER_LENGTH};
    (void)octet_answer_pack(wire->refusal.data, &answer, sizeof wire->refusal.data);
    e2e_protect(&wire->refusal);
    wire_count(wire, why == RESULT_OWNED ? FAULT_REFUSED : FAULT_STALE);
    return say_again(wire, &wire->refusal);
}

static enum input_kind read_command(struct wire *wire, const struct frame *frame, struct command *command)
{
    struct octet_command_t got = {0};
    struct request request;
    enum result why = RESULT_DONE;

    if (!e2e_is_whole(frame, OCTET_COMMAND_LENGTH) || octet_command_unpack(&got, frame->data, frame->len) < 0)
        return refused(wire, FAULT_DAMAGED);
    request = request_from(&got);
    switch (session_request(&wire->session, &request, &why)) {
    case ARRIVAL_AGAIN:
        return say_again(wire, &wire->answer);
    case ARRIVAL_STALE:
        return refuse_command(wire, &request, why);
    case ARRIVAL_FRESH:
        break;
    }
    wire->session.telling = crc32_more(wire->session.told, &frame->data[1], OCTET_COMMAND_LENGTH - 1u);
    *command = request.command;
    return INPUT_COMMAND;
}

/* Two robots have the same number: the wheels rest until one of them is gone and the other is started. */
static enum input_kind meet_twin(struct wire *wire, const struct frame *frame, uint8_t len, struct command *command)
{
    if (!e2e_is_whole(frame, len))
        return refused(wire, FAULT_DAMAGED);
    wire_count(wire, FAULT_TWIN);
    wire->strangers++;
    if (wire->twin || wire->strangers < STRANGERS_MIN)
        return INPUT_SILENCE;
    wire->twin = wire->unasked = true;
    *command = (struct command){.opcode = OPCODE_STOP};
    return INPUT_COMMAND;
}

/* The first byte indicates the kind of memory: with a cell per pattern, that of pattern 0 is empty. */
static bool is_news_of_peer(struct wire *wire, const struct frame *frame)
{
    uint32_t node = 1u << ((frame->id & LINK_FAMILY_BITS) - 1);
    bool upper = frame->data[1] >> 4;
    uint32_t *told = upper ? &wire->told_upper : &wire->told_lower;

    if ((*told & node) || (upper ? !(wire->told_lower & node) : frame->data[2] != 0))
        return false;
    *told |= node;
    return true;
}

static enum input_kind read_peer(struct wire *wire, const struct frame *frame, struct peer *peer)
{
    if (!e2e_is_whole(frame, OCTET_MEMORY_LENGTH))
        return refused(wire, FAULT_DAMAGED);
    if (!is_news_of_peer(wire, frame))
        return INPUT_SILENCE;
    peer->upper = frame->data[1] >> 4;
    for (unsigned i = 0; i < HALF; i++)
        peer->cell[i] = frame->data[2 + i];
    return INPUT_PEER;
}

enum input_kind wire_read(struct wire *wire, const struct frame *frame, struct input *in)
{
    wire->again = NULL;
    if (frame->id == wire_id(wire, OCTET_SENSES_FRAME_ID))
        return read_senses(wire, frame, &in->senses);
    if (frame->id == wire_id(wire, OCTET_RANGES_FRAME_ID))
        return read_ranges(wire, frame);
    if (frame->id == wire_id(wire, OCTET_COMMAND_FRAME_ID))
        return read_command(wire, frame, &in->command);
    if (frame->id == wire_id(wire, OCTET_DRIVE_FRAME_ID))
        return meet_twin(wire, frame, OCTET_DRIVE_LENGTH, &in->command);
    if (frame->id == wire_id(wire, OCTET_HEARTBEAT_FRAME_ID))
        return meet_twin(wire, frame, OCTET_HEARTBEAT_LENGTH, &in->command);
    if (frame->id == wire_id(wire, OCTET_MEMORY_FRAME_ID))
        return meet_twin(wire, frame, OCTET_MEMORY_LENGTH, &in->command);
    if (frame->id > MEMORY_FAMILY && frame->id <= MEMORY_FAMILY + NODE_MAX)
        return read_peer(wire, frame, &in->peer);
    return refused(wire, FAULT_FOREIGN);
}
