#include "host_sim/web/native/page.h"

#include <string.h>

#include "hal/protocol/e2e.h"
#include "octet.h"

enum { OWNER = 1, HALF = 4, MASK = 0x0F };

struct page *page_state(void)
{
    static struct page page;

    return &page;
}

uint8_t *page_bytes(void)
{
    return page_state()->bytes;
}

double *page_numbers(void)
{
    return page_state()->numbers;
}

char *page_text(void)
{
    return page_state()->text;
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

struct octet *page_octet(uint32_t robot)
{
    return page_state()->robots[robot].octet;
}

size_t page_exchange(uint32_t robot, uint32_t id, uint32_t len)
{
    struct frame frame = {.id = id, .len = (uint8_t)len};

    memcpy(frame.data, page_bytes(), sizeof frame.data);
    return octet_exchange(page_octet(robot), &frame);
}

const struct frame *page_answers(uint32_t robot)
{
    return octet_answers(page_octet(robot));
}

void page_hear(uint32_t robot, const struct frame *frame)
{
    struct loop_robot *to = &page_state()->robots[robot];
    size_t count = octet_exchange(to->octet, frame);

    for (size_t i = 0; i < count && to->waiting_count < PAGE_WAITING_MAX; i++)
        page_state()->waiting[robot][to->waiting_count++] = octet_answers(to->octet)[i];
}

/* Takes and logs the oldest waiting frame. False if there is none. */
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

void page_take_reports(uint32_t robot)
{
    struct frame frame;

    while (take(robot, &frame))
        continue;
}

static struct octet_command_t message_of(uint32_t opcode, uint32_t which, uint32_t value)
{
    struct octet_command_t message = {.opcode = (uint8_t)opcode, .owner = OWNER};

    message.profile = message.parameter = message.wanted = (uint8_t)which;
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
    struct frame frame = {.id = wire_id(&page_octet(robot)->wire, OCTET_COMMAND_FRAME_ID),
                          .len = OCTET_COMMAND_LENGTH};

    message->counter = *counter = e2e_next(*counter);
    (void)octet_command_pack(frame.data, message, sizeof frame.data);
    e2e_protect(&frame);
    log_lines_add(&page_state()->loop.log, &frame);
    page_hear(robot, &frame);
}

int32_t page_command(uint32_t robot, uint32_t opcode, uint32_t which, uint32_t value)
{
    struct octet_command_t message = message_of(opcode, which, value);
    struct octet_answer_t answer;
    struct frame frame;

    if (opcode == OPCODE_START)
        page_state()->robots[robot].halted = false;
    send(robot, &message);
    page_state()->robots[robot].known_count = 0;   /* after a command, even an old report may be news */
    while (take(robot, &frame))
        if (frame.id == wire_id(&page_octet(robot)->wire, OCTET_ANSWER_FRAME_ID)) {
            (void)octet_answer_unpack(&answer, frame.data, frame.len);
            page_state()->answer_value = answer.value;
            return answer.result;
        }
    return -1;
}

uint32_t page_read_command(uint32_t robot)
{
    struct input in = {.command = {0}};
    struct frame frame = {.len = OCTET_COMMAND_LENGTH};
    struct wire wire;

    wire_init(&wire, page_octet(robot)->wire.node);
    frame.id = wire_id(&wire, OCTET_COMMAND_FRAME_ID);
    memcpy(frame.data, page_bytes(), sizeof frame.data);
    (void)wire_read(&wire, &frame, &in);
    page_state()->command = in.command;
    return in.command.opcode;
}

uint32_t page_command_which(void)
{
    return page_state()->command.which;
}

uint32_t page_command_value(void)
{
    return page_state()->command.value;
}

uint32_t page_answer_value(void)
{
    return page_state()->answer_value;
}
