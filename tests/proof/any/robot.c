#include "tests/proof/any/robot.h"

struct robot robot;
struct input in;
struct output out;

enum { FEEL_ALL = (1 << FEEL_COUNT) - 1, AWAITS_ALL = 7 };

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

void take_any_input(void)
{
    take_any_senses(&in.senses);
    take_any_command(&in.command);
    hear_any_memory(&in.peer);
}

void take_any_parameters(void)
{
#define TAKE(parameter, minimum, maximum, initial) robot.config.value[parameter] = any_between(minimum, maximum);
    ROBOT_PARAMETERS(TAKE)
}

static void take_any_brain(struct brain *brain)
{
    for (unsigned p = 0; p < CELL_COUNT; p++)
        brain->memory.cell[p] = any_u8();
    brain->profile = any_between(0, PROFILE_COUNT - 1);
    brain->repeat_count = any_u8();
    brain->awaits = any_u8() & AWAITS_ALL;
    brain->tried_feel = any_u8() & FEEL_ALL;
    brain->tried_side = any_between(SIDE_NOTHING, SIDE_RIGHT);
    brain->used = any_u8();
    brain->unlearned = any_u8();
    brain->chasing = any_bool();
    brain->ate = any_bool();
    brain->lost = any_bool();
    brain->since_mm = any_u16();
    brain->learns = any_bool();
    brain->wants_ranges = any_bool();
    brain->frozen = any_bool();
    brain->changed = any_bool();
}

static void take_any_backlog(struct backlog *backlog)
{
    backlog->counts = (int16_t)(any_u16() % 32001u - 16000);
    backlog->rolled = (int16_t)any_u16();
    backlog->commanded[0] = (int16_t)any_u16();
    backlog->commanded[1] = (int16_t)any_u16();
    backlog->same = any_u8();
}

static void take_any_motion(struct motion *motion)
{
    motion->turn_left = (int32_t)(any_u32() % 2000000001u) - 1000000000;
    motion->way_left = (int16_t)(any_u16() % 32001u - 16000);
    motion->odometer_left = any_u16();
    motion->odometer_right = any_u16();
    motion->ticks_left = any_u16();
    motion->pace_left = any_u16();
    motion->astray = any_u16();
    motion->tick = any_u8();
    motion->kind = any_between(0, 4);
    motion->referenced = any_bool();
    motion->rest_ticks = any_u8();
    take_any_backlog(&motion->apart);
    take_any_backlog(&motion->together);
}

static void take_any_perception(struct perception *perception)
{
    for (unsigned i = 0; i < sizeof perception->before; i++)
        perception->before[i] = any_u8() & FEEL_ALL;
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        perception->in_a_row[i] = any_u8();
}

static void take_any_votes(struct sharing *sharing)
{
    for (unsigned p = 0; p < CELL_COUNT; p++)
        sharing->votes[p] = (int8_t)any_u8();
    sharing->whole = any_bool();
}

void take_any_state(void)
{
    robot_init(&robot, any_u32());
    take_any_parameters();
    take_any_brain(&robot.brain);
    take_any_motion(&robot.motion);
    robot.running = any_bool();
    robot.reason = any_between(0, REASON_SILENCE);
    robot.action = any_between(0, ACTION_SPAN - 1);
    robot.silences = any_u8();
    robot.denials = any_u8();
    robot.turn_denied = any_bool();
    robot.tick = any_u8();
    take_any_perception(&robot.perception);
    take_any_votes(&robot.sharing);
    robot.part_ms = any_u16() % 1000u;
    robot.uptime_s = any_u16();
}
