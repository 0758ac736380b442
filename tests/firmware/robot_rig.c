#include "robot_rig.h"

#include <string.h>

#include "tests/test.h"

struct robot robot;
struct output out;
struct senses wheels;

void respond_to(enum input_kind kind, const struct input *in)
{
    memset(&out, 0xA5, sizeof out);   /* so that each member must be set */
    robot_respond(&robot, kind, in, &out);
}

void sense(struct senses senses)
{
    const struct input in = {.senses = senses};

    respond_to(INPUT_SENSES, &in);
}

void feel(uint8_t feel)
{
    sense((struct senses){.feel = feel});
}

void silence(void)
{
    static const struct input nothing;

    respond_to(INPUT_SILENCE, &nothing);
}

void command(enum opcode opcode, uint8_t which, uint32_t value)
{
    const struct input in = {.command = {.opcode = opcode, .which = which, .value = value}};

    respond_to(INPUT_COMMAND, &in);
}

void setUp(void)
{
    wheels = (struct senses){.tick = 0};
    robot_init(&robot, 1);
    command(OPCODE_START, PROFILE_ARTICLE, 1);
}

void teach(enum side side)
{
    memory_learn(&robot.brain.memory, PATTERN_FRONT, side);
}

void assert_at_rest(void)
{
    TEST_ASSERT_TRUE(out.has_drive);
    TEST_ASSERT_EQUAL_INT16(0, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(0, out.drive.right_mm_s);
    TEST_ASSERT_FALSE(out.drive.eat);
}

/* Wheels that obey: 0.2 counts per tick and mm/s. */
void obey(uint8_t feel)
{
    wheels.tick++;
    wheels.feel = feel;
    wheels.odometer_left = (uint16_t)((wheels.odometer_left + out.drive.left_mm_s / 5) & (ODOMETER_SPAN - 1));
    wheels.odometer_right = (uint16_t)((wheels.odometer_right + out.drive.right_mm_s / 5) & (ODOMETER_SPAN - 1));
    sense(wheels);
}
