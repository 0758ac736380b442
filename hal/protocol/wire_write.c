#include "hal/protocol/wire.h"

#include "hal/protocol/e2e.h"
#include "build_id.h"
#include "octet.h"

/* What a report is made of, in the order in which it is sent. */
enum part { PART_HEARTBEAT, PART_MEMORY, PART_FAULTS_0, PART_FAULTS_1, PART_CRASH, PART_HEALTH, PART_COUNT };

struct frames {
    struct frame *first;
    size_t count;
};

static struct frame *frame_for(const struct wire *wire, struct frames *frames, uint32_t id, uint8_t len)
{
    struct frame *frame = &frames->first[frames->count++];

    *frame = (struct frame){.id = wire_id(wire, id), .len = len};
    return frame;
}

static uint8_t count_up(struct wire *wire, enum counted kind)
{
    uint8_t counter = wire->counters[kind];

    wire->counters[kind] = e2e_next(counter);
    return counter;
}

static uint16_t faults_in_all(const struct wire *wire)
{
    unsigned sum = 0;

    for (unsigned i = 0; i < FAULT_COUNT; i++)
        sum += wire->faults[i];
    return (uint16_t)sum;
}

static void write_emergency(struct wire *wire, struct frames *frames)
{
    struct frame *frame = frame_for(wire, frames, OCTET_EMERGENCY_FRAME_ID, OCTET_EMERGENCY_LENGTH);
    struct octet_emergency_t emergency = {
        .counter = count_up(wire, COUNTED_EMERGENCY),
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
    const struct frame *command = &wire->session.command;
    struct frame *frame = frame_for(wire, frames, OCTET_ANSWER_FRAME_ID, OCTET_ANSWER_LENGTH);
    struct octet_answer_t answer = {
        .counter = e2e_counter(command),
        .opcode = command->data[1] >> 4,
        .result = (uint8_t)out->answer,
        .which = command->data[1] >> 4 == OPCODE_GET ? command->data[3] : 0,
        .value = out->answer_value,
    };

    (void)octet_answer_pack(frame->data, &answer, sizeof frame->data);
    e2e_protect(frame);
    wire->answer = *frame;
}

static void write_heartbeat(struct wire *wire, const struct output *out, struct frames *frames)
{
    struct frame *frame = frame_for(wire, frames, OCTET_HEARTBEAT_FRAME_ID, OCTET_HEARTBEAT_LENGTH);
    struct octet_heartbeat_t heartbeat = {
        .counter = wire->counters[COUNTED_HEARTBEAT],
        .state = out->report.running ? OCTET_HEARTBEAT_STATE_RUNNING_CHOICE : OCTET_HEARTBEAT_STATE_STOPPED_CHOICE,
        .frozen = out->report.frozen,
        .lockstep = wire->session.lockstep,
        .silent = out->silent,
        .profile = out->report.profile,
        .owner = wire->session.owner,
        .uptime = out->report.uptime_s,
        .layout = LAYOUT_HASH,
    };

    if (!out->silent)
        (void)count_up(wire, COUNTED_HEARTBEAT);
    wire->strangers = 0;
    (void)octet_heartbeat_pack(frame->data, &heartbeat, sizeof frame->data);
    e2e_protect(frame);
}

static void write_memory(struct wire *wire, const uint8_t memory[CELL_COUNT], struct frames *frames)
{
    uint8_t counter = count_up(wire, COUNTED_MEMORY);

    for (unsigned half = 0; half < 2; half++) {
        struct frame *frame = frame_for(wire, frames, OCTET_MEMORY_FRAME_ID, OCTET_MEMORY_LENGTH);

        frame->data[1] = (uint8_t)(half << 4 | counter);
        for (unsigned i = 0; i < CELL_COUNT / 2; i++)
            frame->data[2 + i] = memory[CELL_COUNT / 2 * half + i];
        e2e_protect(frame);
    }
}

static void fill_boot(struct wire *wire, struct frame *frame)
{
    struct octet_boot_t boot = {
        .counter = count_up(wire, COUNTED_BOOT),
        .reset_cause = (uint8_t)wire->health.reset_cause,
        .modified = OCTET_BUILD_MODIFIED,
        .version_major = OCTET_VERSION_MAJOR,
        .version_minor = OCTET_VERSION_MINOR,
        .commit = OCTET_BUILD_COMMIT,
    };

    (void)octet_boot_pack(frame->data, &boot, sizeof frame->data);
    e2e_protect(frame);
}

void wire_boot(struct wire *wire, struct frame *frame)
{
    struct frames frames = {.first = frame};

    fill_boot(wire, frame_for(wire, &frames, OCTET_BOOT_FRAME_ID, OCTET_BOOT_LENGTH));
}

/* Six counters a page; page 0 those of the link, page 1 the rest. */
static void write_faults(struct wire *wire, unsigned page, struct frames *frames)
{
    struct frame *frame = frame_for(wire, frames, OCTET_FAULTS_FRAME_ID, OCTET_FAULTS_LENGTH);
    const unsigned per_page = OCTET_FAULTS_LENGTH - 2u;
    uint8_t counter = page == 0 ? wire->counters[COUNTED_FAULTS] : count_up(wire, COUNTED_FAULTS);

    frame->data[1] = (uint8_t)(page << 4 | counter);
    for (unsigned i = 0; i < per_page && page * per_page + i < FAULT_COUNT; i++)
        frame->data[2 + i] = wire->faults[page * per_page + i];
    e2e_protect(frame);
}

static void write_health(struct wire *wire, struct frames *frames)
{
    struct frame *frame = frame_for(wire, frames, OCTET_HEALTH_FRAME_ID, OCTET_HEALTH_LENGTH);
    struct octet_health_t health = {
        .counter = count_up(wire, COUNTED_HEALTH),
        .bus_state = (uint8_t)wire->health.bus.state,
        .unstored = wire->health.unstored,
        .clock = wire->health.clock_exact,
        .tx_errors = wire->health.bus.tx_errors,
        .rx_errors = wire->health.bus.rx_errors,
        .bus_offs = wire->health.bus.bus_offs,
        .dropped = wire->health.bus.dropped,
    };

    (void)octet_health_pack(frame->data, &health, sizeof frame->data);
    e2e_protect(frame);
}

/* One value with each report, round and round. */
static void write_crash(struct wire *wire, struct frames *frames)
{
    struct frame *frame = frame_for(wire, frames, OCTET_CRASH_FRAME_ID, OCTET_CRASH_LENGTH);
    struct octet_crash_t crash = {
        .counter = count_up(wire, COUNTED_CRASH),
        .cause = wire->health.crash->cause,
        .name = wire->crash_value,
        .value = wire->health.crash->values[wire->crash_value],
    };

    (void)octet_crash_pack(frame->data, &crash, sizeof frame->data);
    e2e_protect(frame);
    if (++wire->crash_value >= wire->health.crash->count)
        wire->crash_value = 0;
}

static void write_drive(struct wire *wire, const struct output *out, struct frames *frames)
{
    struct frame *frame = frame_for(wire, frames, OCTET_DRIVE_FRAME_ID, OCTET_DRIVE_LENGTH);
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

static void write_part(struct wire *wire, const struct output *out, enum part part, struct frames *frames)
{
    switch (part) {
    case PART_HEARTBEAT:
        write_heartbeat(wire, out, frames);
        break;
    case PART_MEMORY:
        write_memory(wire, out->memory, frames);
        break;
    case PART_FAULTS_0:
        write_faults(wire, 0, frames);
        break;
    case PART_FAULTS_1:
        write_faults(wire, 1, frames);
        break;
    case PART_CRASH:
        if (wire->health.crash)
            write_crash(wire, frames);
        break;
    case PART_HEALTH:
    case PART_COUNT:
        write_health(wire, frames);
        break;
    }
}

static void write_whole_report(struct wire *wire, const struct output *out, struct frames *frames)
{
    write_heartbeat(wire, out, frames);
    fill_boot(wire, frame_for(wire, frames, OCTET_BOOT_FRAME_ID, OCTET_BOOT_LENGTH));
    for (unsigned part = PART_MEMORY; part < PART_COUNT; part++)
        write_part(wire, out, (enum part)part, frames);
    wire->part = PART_COUNT;
}

/* In silence, a sign of life only: the rest would differ with how long it lasts. */
static void write_report(struct wire *wire, const struct output *out, struct frames *frames)
{
    if (out->has_report && out->silent) {
        write_heartbeat(wire, out, frames);
        return;
    }
    if (out->has_report && out->whole_report) {
        write_whole_report(wire, out, frames);
        return;
    }
    if (out->has_report)
        wire->part = 0;
    if (out->has_memory)
        write_memory(wire, out->memory, frames);
    if (wire->part < PART_COUNT && !out->silent && out->has_drive)
        write_part(wire, out, (enum part)wire->part++, frames);
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

/* The answer to what was asked; a stop of the wire's own was not asked for. */
static void write_result(struct wire *wire, const struct output *out, struct frames *frames)
{
    if (wire->unasked) {
        wire->unasked = false;
        session_end(&wire->session);
        return;
    }
    write_answer(wire, out, frames);
    session_executed(&wire->session, out->answer);
    if (out->answer == RESULT_DONE && frames->first[frames->count - 1].data[1] >> 4 == OPCODE_START) {
        wire->twin = wire->has_ranges = false;
        wire->strangers = 0;
        wire->wants_ranges = out->answer_value & ANSWER_WANTS_RANGES;
    }
}

size_t wire_write(struct wire *wire, const struct output *out, struct frame frames[WIRE_FRAMES_MAX])
{
    struct frames written = {.first = frames};

    note(wire, out);
    if (out->has_answer)
        write_result(wire, out, &written);
    if (wire->news)
        write_emergency(wire, &written);
    write_report(wire, out, &written);
    if (out->has_drive)
        write_drive(wire, out, &written);
    return written.count;
}
