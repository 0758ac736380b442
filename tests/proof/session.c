/* Sessions as a simulator holds them, with all that may go wrong in one: most frames are the next ones, so that the robot
 * starts, learns and is stopped among frames that are lost, doubled, damaged or another sender's. What holds in each of
 * them is checked after every frame. */
#include <octet.h>
#include <string.h>

#include "hal/library/exchange.h"
#include "hal/protocol/e2e.h"
#include "tests/proof/any/any.h"
#include "tests/proof/any/command.h"

enum { OWNER = 1, ANOTHER = 2, EVENTS = 12 };

static struct octet *octet;
static unsigned ticks, commands;   /* sent so far */
static uint16_t odometer_left, odometer_right;

/* Wheels roll a little way in a tick, ahead or back. */
static uint16_t rolled(uint16_t odometer)
{
    return (uint16_t)((odometer + ODOMETER_SPAN + (int8_t)any_u8()) % ODOMETER_SPAN);
}

static struct frame next_senses(void)
{
    struct octet_senses_t senses = {.counter = (uint8_t)(ticks % E2E_COUNTERS), .tick = (uint8_t)ticks};
    struct frame frame = {.id = OCTET_SENSES_FRAME_ID, .len = OCTET_SENSES_LENGTH};

    senses.feel = any_u8() % (1u << FEEL_COUNT);
    senses.look = any_bool();
    senses.beacon = senses.look ? 1u + any_u8() : 0u;
    senses.odometer_left = odometer_left = rolled(odometer_left);
    senses.odometer_right = odometer_right = rolled(odometer_right);
    (void)octet_senses_pack(frame.data, &senses, sizeof frame.data);
    e2e_protect(&frame);
    return frame;
}

/* Any robot's but ours. */
static struct frame another_robots_memory(void)
{
    struct frame frame = {.id = OCTET_MEMORY_FRAME_ID + any_between(1, NODE_MAX - 1), .len = OCTET_MEMORY_LENGTH};

    for (unsigned i = 0; i < frame.len; i++)
        frame.data[i] = any_u8();
    e2e_protect(&frame);
    return frame;
}

static struct frame next_frame(uint8_t event)
{
    switch (event) {
    case 0:
        ticks += any_between(1, 40);   /* lost on the way */
        return next_senses();
    case 1:
        commands++;
        return any_command(OWNER, commands);
    case 2:
        return any_command(ANOTHER, commands);
    case 3:
        return another_robots_memory();
    default:
        ticks++;
        return next_senses();
    }
}

static bool may_change_the_memory(const struct frame *frame, const struct robot *before)
{
    unsigned opcode;

    if (frame->id == OCTET_SENSES_FRAME_ID)
        return before->running && !before->brain.frozen;
    opcode = octet->wire.session.request.command.opcode;
    return frame->id == OCTET_COMMAND_FRAME_ID
        && (opcode == OPCODE_START || opcode == OPCODE_WRITE || opcode == OPCODE_ERASE);
}

static void check_drive(const struct frame *frame)
{
    struct octet_drive_t drive;

    if (frame->id != OCTET_DRIVE_FRAME_ID)
        return;
    must(octet_drive_unpack(&drive, frame->data, frame->len) == 0);
    must(octet->robot.running || (drive.left == 0 && drive.right == 0));
}

static void give(const struct frame *frame)
{
    const struct robot before = octet->robot;
    size_t count = octet_exchange(octet, frame);

    must(count <= WIRE_FRAMES_MAX);
    for (size_t i = 0; i < count; i++) {
        must(e2e_is_whole(&octet->answers[i], octet->answers[i].len));
        if (!octet->wire.again)
            check_drive(&octet->answers[i]);
    }
    must(memcmp(&before.brain.memory, &octet->robot.brain.memory, sizeof before.brain.memory) == 0
         || may_change_the_memory(frame, &before));
}

/* It is counted and nothing else. */
static void give_damaged(struct frame frame)
{
    const struct robot before = octet->robot;
    unsigned bit = any_between(0, 63);

    frame.data[bit / 8] ^= (uint8_t)(1u << bit % 8);
    must(octet_exchange(octet, &frame) == 0);
    must(memcmp(&before, &octet->robot, sizeof before) == 0);
}

static void fall_silent(void)
{
    struct input nothing;
    struct output output;

    wire_outage(&octet->wire);
    robot_respond(&octet->robot, INPUT_SILENCE, &nothing, &output);
    must(output.drive.left_mm_s == 0 && output.drive.right_mm_s == 0);
    (void)wire_write(&octet->wire, &output, octet->answers);
}

void exercise(void)
{
    static const uint8_t nothing[CELL_COUNT];
    struct frame frame = {.id = 0};

    octet = octet_open(1, nothing);
    ticks = commands = 0;
    odometer_left = odometer_right = 0;
    while (octet && any_more()) {
        uint8_t event = any_u8() % EVENTS;

        if (event == EVENTS - 1)
            fall_silent();
        else if (event == EVENTS - 2)
            give_damaged(next_frame(4));
        else if (event == EVENTS - 3)
            give(&frame);   /* once more */
        else {
            frame = next_frame(event);
            give(&frame);
        }
    }
    octet_close(octet);
}
