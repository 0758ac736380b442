#include "hal/protocol/wire.h"

#include "hal/protocol/e2e.h"
#include "octet.h"

static uint16_t faults_in_all(const struct wire *wire)
{
    unsigned sum = 0;

    for (unsigned i = 0; i < FAULT_COUNT; i++)
        sum += wire->faults[i];
    return (uint16_t)sum;
}

static void write_emergency(struct wire *wire, struct frames *frames)
{
    struct frame *frame = frames_add(frames, wire, OCTET_EMERGENCY_FRAME_ID, OCTET_EMERGENCY_LENGTH);
    struct octet_emergency_t emergency = {
        .counter = frames_count_up(wire, COUNTED_EMERGENCY),
        .first = wire->first_news,
        .tick = wire->session.tick,
        .kinds = wire->news,
        .faults = faults_in_all(wire),
    };

    (void)octet_emergency_pack(frame->data, &emergency, sizeof frame->data);
    e2e_protect(frame);
    wire->news = 0;
}

static void write_answer(struct wire *wire, const struct output *out, struct frames *frames)
{
    const struct request *request = &wire->session.request;
    enum opcode opcode = request->command.opcode;
    struct frame *frame = frames_add(frames, wire, OCTET_ANSWER_FRAME_ID, OCTET_ANSWER_LENGTH);
    struct octet_answer_t answer = {
        .counter = request->counter,
        .opcode = (uint8_t)opcode,
        .result = (uint8_t)out->answer,
        .which = opcode == OPCODE_GET ? request->command.which : 0,
        .value = out->answer_value,
    };

    if (opcode == OPCODE_STOP) {
        answer.which = wire->session.told_opcodes;
        answer.value = wire->session.told;
    }
    (void)octet_answer_pack(frame->data, &answer, sizeof frame->data);
    e2e_protect(frame);
    wire->answer = *frame;
}

static void write_drive(struct wire *wire, const struct output *out, struct frames *frames)
{
    struct frame *frame = frames_add(frames, wire, OCTET_DRIVE_FRAME_ID, OCTET_DRIVE_LENGTH);
    const struct drive *drive = &out->drive;
    struct octet_drive_t packed = {
        .counter = wire->session.counter,
        .tick = drive->tick,
        .reason = (uint8_t)drive->reason,
        .left = drive->left_mm_s,
        .right = drive->right_mm_s,
        .repeat_count = drive->repeat_count,
        .eat = drive->eat,
        .action = drive->action,
    };

    (void)octet_drive_pack(frame->data, &packed, sizeof frame->data);
    e2e_protect(frame);
    if (!out->silent)
        wire->drive = *frame;
}

static void note(struct wire *wire, const struct output *out)
{
    if (out->contradiction)
        wire_count(wire, FAULT_CONTRADICTION);
    if (out->denied)
        wire_count(wire, FAULT_DENIED);
    if (out->has_answer && out->answer != RESULT_DONE)
        wire_count(wire, FAULT_REFUSED);
}

/* Writes the answer to a command; what the wire itself or a button asked for has none. */
static void write_result(struct wire *wire, const struct output *out, struct frames *frames)
{
    bool begins;

    if (wire->unasked) {
        wire->unasked = false;
        wire->twin = wire->twin && !out->report.running;   /* a button may have started it */
        session_end(&wire->session);
        return;
    }
    begins = wire->session.owner == 0;
    write_answer(wire, out, frames);
    session_executed(&wire->session, out->answer);
    if (out->answer == RESULT_DONE && wire->session.request.command.opcode == OPCODE_START) {
        wire->twin = wire->has_ranges = false;
        wire->strangers = 0;
        if (begins)
            wire_report_start(wire);
        wire->wants_ranges = out->answer_value & ANSWER_WANTS_RANGES;
    }
}

void wire_senses(struct wire *wire, const struct senses *senses, struct frame *frame)
{
    struct session *session = &wire->session;
    struct octet_senses_t packed = {
        .counter = (uint8_t)((session->counter + 1) % E2E_COUNTERS),
        .tick = senses->tick,
        .feel = senses->feel,
        .bump = senses->bump,
        .look = senses->look,
        .beacon = senses->beacon_mm,
        .odometer_left = senses->odometer_left,
        .odometer_right = senses->odometer_right,
    };

    session->counter = packed.counter;
    session->tick = packed.tick;
    session->knows_tick = session->hears = true;
    *frame = (struct frame){.id = wire_id(wire, OCTET_SENSES_FRAME_ID), .len = OCTET_SENSES_LENGTH};
    (void)octet_senses_pack(frame->data, &packed, sizeof frame->data);
    e2e_protect(frame);
}

size_t wire_write(struct wire *wire, const struct output *out, struct frame frames[WIRE_FRAMES_MAX])
{
    struct frames written = {.first = frames};

    note(wire, out);
    if (out->has_answer)
        write_result(wire, out, &written);
    if (wire->news && (out->has_answer || out->has_report || out->has_drive))
        write_emergency(wire, &written);
    wire_report(wire, out, &written);
    if (out->has_drive)
        write_drive(wire, out, &written);
    return written.count;
}
