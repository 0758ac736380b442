#include "hal/protocol/wire.h"

#include "build_id.h"
#include "hal/flash_store/crc32.h"
#include "hal/protocol/e2e.h"
#include "octet.h"

struct frame *frames_add(struct frames *frames, const struct wire *wire, uint32_t id_of_node_1, uint8_t len)
{
    struct frame *frame = &frames->first[frames->count++];

    *frame = (struct frame){.id = wire_id(wire, id_of_node_1), .len = len};
    return frame;
}

uint8_t frames_count_up(struct wire *wire, enum counted kind)
{
    uint8_t counter = wire->counters[kind];

    wire->counters[kind] = e2e_next(counter);
    return counter;
}

/* The parts of a report, in the order of sending. */
enum part { PART_NONE, PART_HEARTBEAT, PART_MEMORY, PART_FAULTS_0, PART_FAULTS_1, PART_CRASH, PART_HEALTH };

static void write_heartbeat(struct wire *wire, const struct output *out, struct frames *frames)
{
    struct frame *frame = frames_add(frames, wire, OCTET_HEARTBEAT_FRAME_ID, OCTET_HEARTBEAT_LENGTH);
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
        (void)frames_count_up(wire, COUNTED_HEARTBEAT);
    wire->strangers = 0;
    wire->noisy = false;
    (void)octet_heartbeat_pack(frame->data, &heartbeat, sizeof frame->data);
    e2e_protect(frame);
}

static void write_memory(struct wire *wire, const uint8_t memory[CELL_COUNT], struct frames *frames)
{
    uint8_t counter = frames_count_up(wire, COUNTED_MEMORY);

    for (unsigned half = 0; half < 2; half++) {
        struct frame *frame = frames_add(frames, wire, OCTET_MEMORY_FRAME_ID, OCTET_MEMORY_LENGTH);

        frame->data[1] = (uint8_t)(half << 4 | counter);
        for (unsigned i = 0; i < CELL_COUNT / 2; i++)
            frame->data[2 + i] = memory[CELL_COUNT / 2 * half + i];
        e2e_protect(frame);
    }
}

static void fill_boot(struct wire *wire, struct frame *frame)
{
    struct octet_boot_t boot = {
        .counter = frames_count_up(wire, COUNTED_BOOT),
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

    fill_boot(wire, frames_add(&frames, wire, OCTET_BOOT_FRAME_ID, OCTET_BOOT_LENGTH));
}

/* Six counters per page: page 0 those of the link, page 1 the rest. */
static void write_faults(struct wire *wire, unsigned page, struct frames *frames)
{
    struct frame *frame = frames_add(frames, wire, OCTET_FAULTS_FRAME_ID, OCTET_FAULTS_LENGTH);
    const unsigned per_page = OCTET_FAULTS_LENGTH - 2u;
    uint8_t counter = page == 0 ? wire->counters[COUNTED_FAULTS] : frames_count_up(wire, COUNTED_FAULTS);

    frame->data[1] = (uint8_t)(page << 4 | counter);
    for (unsigned i = 0; i < per_page && page * per_page + i < FAULT_COUNT; i++)
        frame->data[2 + i] = wire->faults[page * per_page + i];
    e2e_protect(frame);
}

/* On its own clock the robot may miss senses, and the owner cannot tell which. */
static uint16_t held(const struct session *session, const uint8_t memory[CELL_COUNT])
{
    uint32_t told = crc32_more(session->told, memory, session->owner ? 0 : CELL_COUNT);

    return (uint16_t)(session->lockstep ? told ^ session->heard : told);
}

static void write_health(struct wire *wire, const uint8_t memory[CELL_COUNT], struct frames *frames)
{
    struct frame *frame = frames_add(frames, wire, OCTET_HEALTH_FRAME_ID, OCTET_HEALTH_LENGTH);
    struct octet_health_t health = {
        .counter = frames_count_up(wire, COUNTED_HEALTH),
        .bus_state = (uint8_t)wire->health.bus.state,
        .unstored = wire->health.unstored,
        .clock = wire->health.clock_exact,
        .tx_errors = wire->health.bus.tx_errors,
        .rx_errors = wire->health.bus.rx_errors,
        .bus_offs = wire->health.bus.bus_offs,
        .dropped = wire->health.bus.dropped,
        .held = held(&wire->session, memory),
    };

    (void)octet_health_pack(frame->data, &health, sizeof frame->data);
    e2e_protect(frame);
}

/* One value per report, in turn. */
static void write_crash(struct wire *wire, struct frames *frames)
{
    struct frame *frame = frames_add(frames, wire, OCTET_CRASH_FRAME_ID, OCTET_CRASH_LENGTH);
    struct octet_crash_t crash = {
        .counter = frames_count_up(wire, COUNTED_CRASH),
        .cause = wire->health.crash->cause,
        .name = wire->crash_value,
        .value = wire->health.crash->values[wire->crash_value],
    };

    (void)octet_crash_pack(frame->data, &crash, sizeof frame->data);
    e2e_protect(frame);
    if (++wire->crash_value >= wire->health.crash->count)
        wire->crash_value = 0;
}

static void write_part(struct wire *wire, const struct output *out, enum part part, struct frames *frames)
{
    switch (part) {
    case PART_NONE:
        break;
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
        write_health(wire, out->memory, frames);
        break;
    }
}

static void write_whole_report(struct wire *wire, const struct output *out, struct frames *frames)
{
    write_heartbeat(wire, out, frames);
    fill_boot(wire, frames_add(frames, wire, OCTET_BOOT_FRAME_ID, OCTET_BOOT_LENGTH));
    for (unsigned part = PART_MEMORY; part <= PART_HEALTH; part++)
        write_part(wire, out, (enum part)part, frames);
    wire->part = PART_NONE;
}

static void write_next_part(struct wire *wire, const struct output *out, struct frames *frames)
{
    enum part part = (enum part)wire->part;

    write_part(wire, out, part, frames);
    wire->part = (uint8_t)(part == PART_NONE || part == PART_HEALTH ? PART_NONE : part + 1);
}

void wire_report_start(struct wire *wire)
{
    wire->part = PART_NONE;
    wire->told_lower = wire->told_upper = 0;
}

/* In silence, only a sign of life: everything else would depend on its duration. In a tick that sends a new memory,
   the report waits. */
void wire_report(struct wire *wire, const struct output *out, struct frames *frames)
{
    if (out->has_report && out->silent) {
        write_heartbeat(wire, out, frames);
        return;
    }
    if (out->has_report && out->whole_report) {
        write_whole_report(wire, out, frames);
        return;
    }
    if (out->has_report) {
        wire_report_start(wire);
        wire->part = PART_HEARTBEAT;
    }
    if (out->has_memory)
        write_memory(wire, out->memory, frames);
    else if (out->has_drive && !out->silent)
        write_next_part(wire, out, frames);
}
