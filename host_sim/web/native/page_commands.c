#include "host_sim/web/native/page_frames.h"

#include "hal/protocol/e2e.h"
#include "octet.h"

enum { OWNER = 1, HALF = 4, MASK = 0x0F };

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
    struct frame frame = {.id = wire_id(&page_octet(robot)->wire, OCTET_COMMAND_FRAME_ID), .len = OCTET_COMMAND_LENGTH};

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
    page_state()->robots[robot].known_count = 0;   /* after a command, even what was reported long ago may be news */
    while (page_take(robot, &frame))
        if (frame.id == wire_id(&page_octet(robot)->wire, OCTET_ANSWER_FRAME_ID)) {
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

uint32_t page_answer_value(void)
{
    return page_state()->answer_value;
}
