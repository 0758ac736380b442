#include "hal/protocol/wire.h"

#include "hal/protocol/crc8.h"
#include "build_id.h"
#include "octet.h"

static struct frame *frame_for(const struct wire *wire, struct frame frames[], size_t *count, uint32_t id, uint8_t len)
{
    struct frame *frame = &frames[(*count)++];

    *frame = (struct frame){.id = wire_id(wire, id), .len = len};
    return frame;
}

static void write_answer(const struct wire *wire, const struct output *out, struct frame *frame)
{
    struct octet_answer_t answer = {
        .counter = wire->counter,
        .opcode = wire->opcode,
        .result = (uint8_t)out->answer,
    };

    (void)octet_answer_pack(frame->data, &answer, sizeof frame->data);
    frame->data[0] = crc8_of_frame(frame);
}

static uint8_t faults_in_all(const struct wire *wire)
{
    unsigned sum = 0;

    for (unsigned i = 0; i < FAULT_COUNT; i++)
        sum += wire->faults[i];
    return (uint8_t)(sum < UINT8_MAX ? sum : UINT8_MAX);
}

static void write_heartbeat(const struct wire *wire, const struct output *out, struct frame *frame)
{
    struct octet_heartbeat_t heartbeat = {
        .state = out->report.running ? OCTET_HEARTBEAT_STATE_RUNNING_CHOICE : OCTET_HEARTBEAT_STATE_STOPPED_CHOICE,
        .frozen = out->report.frozen,
        .lockstep = wire->lockstep,
        .profile = out->report.profile,
        .faults = faults_in_all(wire),
        .uptime = out->report.uptime_s,
        .version_major = OCTET_VERSION_MAJOR,
        .version_minor = OCTET_VERSION_MINOR,
        .dbc_hash = LAYOUT_HASH,
    };

    (void)octet_heartbeat_pack(frame->data, &heartbeat, sizeof frame->data);
}

static void write_faults(const struct wire *wire, struct frame *frame)
{
    struct octet_faults_t faults = {
        .silences = wire->faults[FAULT_SILENCE],
        .missed = wire->faults[FAULT_MISSED],
        .stale = wire->faults[FAULT_STALE],
        .damaged = wire->faults[FAULT_DAMAGED],
        .foreign = wire->faults[FAULT_FOREIGN],
        .unsent = wire->faults[FAULT_UNSENT],
        .refused = wire->faults[FAULT_REFUSED],
        .unsaved = wire->faults[FAULT_UNSAVED],
    };

    (void)octet_faults_pack(frame->data, &faults, sizeof frame->data);
}

static void write_health(const struct wire *wire, struct frame *frame)
{
    struct octet_health_t health = {
        .reset_cause = (uint8_t)wire->health.reset_cause,
        .bus_state = (uint8_t)wire->health.bus.state,
        .modified = OCTET_BUILD_MODIFIED,
        .tx_errors = wire->health.bus.tx_errors,
        .rx_errors = wire->health.bus.rx_errors,
        .bus_offs = wire->health.bus.bus_offs,
        .dropped = wire->health.bus.dropped,
        .commit = OCTET_BUILD_COMMIT,
    };

    (void)octet_health_pack(frame->data, &health, sizeof frame->data);
}

/* One value with each report, round and round. */
static void write_crash(struct wire *wire, struct frame *frame)
{
    struct octet_crash_t crash = {
        .cause = wire->health.crash->cause,
        .name = wire->crash_value,
        .value = wire->health.crash->values[wire->crash_value],
    };

    (void)octet_crash_pack(frame->data, &crash, sizeof frame->data);
    if (++wire->crash_value >= wire->health.crash->count)
        wire->crash_value = 0;
}

static void write_drive(const struct drive *drive, struct frame *frame)
{
    struct octet_drive_t packed = {
        .tick = drive->tick,
        .reason = (uint8_t)drive->reason,
        .left = drive->left_mm_s,
        .right = drive->right_mm_s,
        .repeat_count = drive->repeat_count,
        .eat = drive->eat,
        .action = drive->action,
    };

    (void)octet_drive_pack(frame->data, &packed, sizeof frame->data);
    frame->data[0] = crc8_of_frame(frame);
}

/* A memory frame is the eight bytes and nothing else. */
static void write_memory(const uint8_t memory[CELL_COUNT], struct frame *frame)
{
    for (unsigned p = 0; p < CELL_COUNT; p++)
        frame->data[p] = memory[p];
}

size_t wire_write(struct wire *wire, const struct output *out, struct frame frames[WIRE_FRAMES_MAX])
{
    size_t count = 0;

    if (out->has_answer && out->answer != RESULT_DONE)
        wire_count(wire, FAULT_REFUSED);
    if (out->has_answer)
        write_answer(wire, out, frame_for(wire, frames, &count, OCTET_ANSWER_FRAME_ID, OCTET_ANSWER_LENGTH));
    if (out->has_report) {
        write_heartbeat(wire, out, frame_for(wire, frames, &count, OCTET_HEARTBEAT_FRAME_ID, OCTET_HEARTBEAT_LENGTH));
        write_health(wire, frame_for(wire, frames, &count, OCTET_HEALTH_FRAME_ID, OCTET_HEALTH_LENGTH));
        if (wire->health.crash)
            write_crash(wire, frame_for(wire, frames, &count, OCTET_CRASH_FRAME_ID, OCTET_CRASH_LENGTH));
        write_faults(wire, frame_for(wire, frames, &count, OCTET_FAULTS_FRAME_ID, OCTET_FAULTS_LENGTH));
    }
    if (out->has_memory)
        write_memory(out->memory, frame_for(wire, frames, &count, OCTET_MEMORY_FRAME_ID, OCTET_MEMORY_LENGTH));
    if (out->has_drive)
        write_drive(&out->drive, frame_for(wire, frames, &count, OCTET_DRIVE_FRAME_ID, OCTET_DRIVE_LENGTH));
    return count;
}
