/* The core: whatever is sensed, commanded or stored, in whatever order and however long. Parameters may change at any
 * time; that they keep to their ranges is proved in config.c. */
#include "firmware/robot.h"
#include "tests/proof/any.h"

enum { FEEL_ALL = (1 << FEEL_COUNT) - 1 };

static void take_any_parameters(struct config *config)
{
#define TAKE(parameter, minimum, maximum, initial) config->value[parameter] = any_between(minimum, maximum);
    ROBOT_PARAMETERS(TAKE)
}

static void take_any_senses(struct senses *senses)
{
    senses->tick = any_u8();
    senses->feel = any_u8() & FEEL_ALL;
    senses->bump = any_bool();
    senses->look = any_bool();
    senses->beacon_mm = any_u16();
    senses->odometer_left = any_u16();
    senses->odometer_right = any_u16();
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        senses->range_mm[i] = any_u8();
}

static void take_any_command(struct command *command)
{
    uint8_t opcode = any_u8();

    command->opcode = opcode == OPCODE_SET ? OPCODE_REPORT : (enum opcode)opcode;
    command->which = any_u8();
    command->value = any_u32();
}

static void hear_any_memory(struct peer *peer)
{
    peer->upper = any_bool();
    for (unsigned i = 0; i < CELL_COUNT / 2; i++)
        peer->cell[i] = any_u8();
}

static void wake_with_any_memory(struct robot *robot)
{
    uint8_t cells[CELL_COUNT];

    for (unsigned p = 0; p < CELL_COUNT; p++)
        cells[p] = any_u8();
    robot_init(robot, any_u32());
    (void)brain_adopt(&robot->brain, cells);
}

void exercise(void)
{
    struct robot robot;
    struct input in;
    struct output out;

    wake_with_any_memory(&robot);
    while (any_more()) {
        take_any_parameters(&robot.config);
        take_any_senses(&in.senses);
        take_any_command(&in.command);
        hear_any_memory(&in.peer);
        robot_respond(&robot, (enum input_kind)any_between(INPUT_SILENCE, INPUT_PEER), &in, &out);
        //@ assert fits_the_wire: !out.has_drive || (-2047 <= out.drive.left_mm_s <= 2047 && -2047 <= out.drive.right_mm_s <= 2047);
    }
}
