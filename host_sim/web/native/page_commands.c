#include "host_sim/web/native/page_frames.h"

#include <string.h>

#include "hal/protocol/e2e.h"
#include "octet.h"

enum { OWNER = 1, HALF = 4, MASK = 0x0F };

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
    while (page_take(robot, &frame))
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
