#include "host_sim/web/native/page.h"

#include <string.h>

#include "firmware/memory_kind.h"
#include "firmware/memory_write.h"
#include "hal/protocol/e2e.h"
#include "octet.h"

enum { OWNER = 1, HALF = 4, MASK = 0x0F };

/* Room for a block's lines: the senses, the drive and a report of each tick, and all at once in one of them. */
enum { LINES_A_TICK = 3, LOG_LINES = PAGE_ROBOTS_MAX * (LINES_A_TICK * PAGE_TICKS_MAX + PAGE_WAITING_MAX) };

#define KIND(profile, name, kind) [profile] = kind,

static const uint8_t kind_of[PROFILE_COUNT] = {ROBOT_BEHAVIOURS(KIND)};

struct page *page_state(void)
{
    static struct page page;

    return &page;
}

static void bind(struct loop_robot *robot, struct octet *octet)
{
    static int16_t rows[PAGE_ROBOTS_MAX][PAGE_TICKS_MAX * LOOP_ROW];
    static double poses[PAGE_ROBOTS_MAX][PAGE_TICKS_MAX * LOOP_POSE];
    static uint32_t decisions[PAGE_ROBOTS_MAX][PAGE_TICKS_MAX];
    size_t index = (size_t)(robot - page_state()->robots);

    robot->octet = octet;
    robot->senses_id = wire_id(&octet->wire, OCTET_SENSES_FRAME_ID);
    robot->drive_id = wire_id(&octet->wire, OCTET_DRIVE_FRAME_ID);
    robot->heartbeat_id = wire_id(&octet->wire, OCTET_HEARTBEAT_FRAME_ID);
    robot->waiting = page_state()->waiting[index];
    robot->rows = rows[index];
    robot->poses = poses[index];
    robot->decisions = decisions[index];
}

/* As in host_sim/client/supervision.py: all that it has said but its drive, then its report. */
static bool ask(struct loop *loop, size_t index)
{
    struct loop_robot *robot = &loop->robots[index];
    const struct frame *answers = octet_answers(robot->octet);

    if (robot->octet->robot.running || robot->octet->robot.denials == 0)
        return false;
    for (size_t i = 0; i < robot->answer_count; i++)
        if (answers[i].id != robot->drive_id)
            log_lines_add(&loop->log, &answers[i]);
    (void)page_command((uint32_t)index, OPCODE_REPORT, 0, 0);
    page_take_reports((uint32_t)index);
    return true;
}

bool page_open(uint32_t robots)
{
    static const uint8_t nothing[CELL_COUNT];
    static char text[LOG_LINES * LOG_LINE_MAX];
    struct loop *loop = &page_state()->loop;

    *loop = (struct loop){.exchange = octet_exchange, .answers = octet_answers, .ask = ask, .robot_count = robots};
    loop->robots = page_state()->robots;
    loop->log.text = text;
    loop->log_size = sizeof text;
    log_lines_stamp(&loop->log, 0);
    for (uint8_t i = 0; i < robots; i++) {
        struct octet *octet = octet_open((uint8_t)(i + 1), nothing);

        if (!octet)
            return false;
        bind(&loop->robots[i], octet);
    }
    return true;
}

uint8_t *page_bytes(void)
{
    return page_state()->bytes;
}

static struct octet *octet_of(uint32_t robot)
{
    return page_state()->robots[robot].octet;
}

size_t page_exchange(uint32_t robot, uint32_t id, uint32_t len)
{
    struct frame frame = {.id = id, .len = (uint8_t)len};

    memcpy(frame.data, page_bytes(), sizeof frame.data);
    return octet_exchange(octet_of(robot), &frame);
}

const struct frame *page_answers(uint32_t robot)
{
    return octet_answers(octet_of(robot));
}

/* Adds to the frames of a robot that have not been taken yet. */
static void hear(uint32_t robot, const struct frame *frame)
{
    struct loop_robot *to = &page_state()->robots[robot];
    size_t count = octet_exchange(to->octet, frame);

    for (size_t i = 0; i < count && to->waiting_count < PAGE_WAITING_MAX; i++)
        page_state()->waiting[robot][to->waiting_count++] = octet_answers(to->octet)[i];
}

/* Takes and logs the oldest frame that waits; false if none does. */
static bool take(uint32_t robot, struct frame *out)
{
    struct loop_robot *from = &page_state()->robots[robot];
    struct frame *waiting = page_state()->waiting[robot];

    if (from->waiting_count == 0)
        return false;
    *out = waiting[0];
    memmove(waiting, waiting + 1, --from->waiting_count * sizeof *waiting);
    log_lines_add(&page_state()->loop.log, out);
    return true;
}

static struct octet_command_t message_of(uint32_t opcode, uint32_t which, uint32_t value)
{
    struct octet_command_t message = {.opcode = (uint8_t)opcode, .owner = OWNER};

    message.profile = message.parameter = (uint8_t)which;
    message.freeze = which != 0;
    message.mask = which & MASK;
    message.half = which >> HALF & 1u;
    message.lockstep = 1;
    message.seed = value;
    message.value = (uint16_t)value;
    message.byte_0 = (uint8_t)value;
    message.byte_1 = (uint8_t)(value >> 8);
    message.byte_2 = (uint8_t)(value >> 16);
    message.byte_3 = (uint8_t)(value >> 24);
    return message;
}

static void send(uint32_t robot, struct octet_command_t *message)
{
    uint8_t *counter = &page_state()->counters[robot];
    struct frame frame = {.id = wire_id(&octet_of(robot)->wire, OCTET_COMMAND_FRAME_ID), .len = OCTET_COMMAND_LENGTH};

    message->counter = *counter = e2e_next(*counter);
    (void)octet_command_pack(frame.data, message, sizeof frame.data);
    e2e_protect(&frame);
    log_lines_add(&page_state()->loop.log, &frame);
    hear(robot, &frame);
}

int32_t page_command(uint32_t robot, uint32_t opcode, uint32_t which, uint32_t value)
{
    struct octet_command_t message = message_of(opcode, which, value);
    struct octet_answer_t answer;
    struct frame frame;

    if (opcode == OPCODE_START)
        page_state()->robots[robot].halted = false;
    send(robot, &message);
    page_state()->robots[robot].known_count = 0;   /* after a command, even what was reported long ago may be news */
    while (take(robot, &frame))
        if (frame.id == wire_id(&octet_of(robot)->wire, OCTET_ANSWER_FRAME_ID)) {
            (void)octet_answer_unpack(&answer, frame.data, frame.len);
            page_state()->answer_value = answer.value;
            return answer.result;
        }
    return -1;
}

static struct command command_of(const struct octet_command_t *message)
{
    uint32_t bytes = message->byte_0 | (uint32_t)message->byte_1 << 8 | (uint32_t)message->byte_2 << 16
                     | (uint32_t)message->byte_3 << 24;
    struct command command = {.opcode = (enum opcode)message->opcode};

    if (command.opcode == OPCODE_START) {
        command.which = message->profile;
        command.value = message->seed;
    } else if (command.opcode == OPCODE_SET) {
        command.which = message->parameter;
        command.value = message->value;
    } else if (command.opcode == OPCODE_WRITE) {
        command.which = (uint8_t)(message->half << HALF | message->mask);
        command.value = bytes;
    } else if (command.opcode == OPCODE_FREEZE) {
        command.which = message->freeze;
    }
    return command;
}

uint32_t page_read_command(void)
{
    struct octet_command_t message = {0};

    (void)octet_command_unpack(&message, page_bytes(), OCTET_COMMAND_LENGTH);
    page_state()->command = command_of(&message);
    return page_state()->command.opcode;
}

uint32_t page_command_which(void)
{
    return page_state()->command.which;
}

uint32_t page_command_value(void)
{
    return page_state()->command.value;
}

void page_send_ranges(uint32_t robot, uint32_t tick)
{
    const struct loop_robot *to = &page_state()->robots[robot];
    const uint8_t *range = page_bytes();
    struct frame frame = {.id = wire_id(&octet_of(robot)->wire, OCTET_RANGES_FRAME_ID), .len = OCTET_RANGES_LENGTH};
    const struct octet_ranges_t message = {
        .counter = e2e_next(to->senses_counter),
        .tick = (uint8_t)(tick & (TICK_SPAN - 1)),
        .range_right = range[0],
        .range_front_right = range[1],
        .range_front = range[2],
        .range_front_left = range[3],
        .range_left = range[4],
    };

    (void)octet_ranges_pack(frame.data, &message, sizeof frame.data);
    e2e_protect(&frame);
    log_lines_add(&page_state()->loop.log, &frame);
    hear(robot, &frame);
}

uint32_t page_answer_value(void)
{
    return page_state()->answer_value;
}

void page_take_reports(uint32_t robot)
{
    struct frame frame;

    while (take(robot, &frame))
        continue;
}

const uint8_t *page_memory(uint32_t robot)
{
    return octet_of(robot)->robot.brain.memory.cell;
}

const uint8_t *page_sides(uint32_t robot)
{
    static struct memory sides;

    memcpy(sides.cell, page_memory(robot), sizeof sides.cell);
    (void)memory_translate(&sides, MEMORY_KIND_SIDES);
    return sides.cell;
}

static enum memory_kind kind_of_robot(uint32_t robot)
{
    return (enum memory_kind)kind_of[octet_of(robot)->robot.brain.profile];
}

void page_write_side(uint32_t robot, uint32_t pattern, uint32_t side)
{
    struct memory memory;

    memcpy(memory.cell, page_bytes(), sizeof memory.cell);
    memory_put(&memory, kind_of_robot(robot), (uint8_t)pattern, (enum side)side);
    memcpy(page_bytes(), memory.cell, sizeof memory.cell);
}

bool page_translate(uint32_t robot)
{
    struct memory memory;

    if (!memory_adopt(&memory, page_bytes()))
        return false;
    (void)memory_translate(&memory, kind_of_robot(robot));
    memcpy(page_bytes(), memory.cell, sizeof memory.cell);
    return true;
}

bool page_has_halted(uint32_t robot)
{
    return page_state()->robots[robot].halted;
}

void page_set_time(double time_us)
{
    log_lines_stamp(&page_state()->loop.log, (uint64_t)time_us);
}

const char *page_log(void)
{
    return page_state()->loop.log.text;
}

size_t page_log_used(void)
{
    return page_state()->loop.log.used;
}

void page_clear_log(void)
{
    page_state()->loop.log.used = 0;
}
