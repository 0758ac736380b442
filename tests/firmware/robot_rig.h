/* robot_rig.h: a robot, started with the article's behaviour before each test, and its output. */
#ifndef OCTET_ROBOT_RIG_H
#define OCTET_ROBOT_RIG_H

#include <string.h>

#include "tests/test.h"
#include "firmware/robot.h"

enum { CLEAR = 0, FRONT = 4, PATTERN_FRONT = 2, TICKS_PER_SECOND = 50, MANY = 1000 };

static struct robot robot;
static struct output out;   /* of the last response */
static struct senses wheels;   /* of a body that obeys */

static inline void respond_to(enum input_kind kind, const struct input *in)
{
    memset(&out, 0xA5, sizeof out);   /* so that each member must be set */
    robot_respond(&robot, kind, in, &out);
}

static inline void sense(struct senses senses)
{
    const struct input in = {.senses = senses};

    respond_to(INPUT_SENSES, &in);
}

/* Responds to senses with only these sensors triggered. */
static inline void feel(uint8_t feel)
{
    sense((struct senses){.feel = feel});
}

static inline void silence(void)
{
    static const struct input nothing;

    respond_to(INPUT_SILENCE, &nothing);
}

/* The robot responds to one input. */
static inline void command(enum opcode opcode, uint8_t which, uint32_t value)
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

/* Puts the side into the cell of an obstacle in front. */
static inline void teach(enum side side)
{
    memory_learn(&robot.brain.memory, PATTERN_FRONT, side);
}

/* Checks that the last output stops the wheels. */
static inline void assert_at_rest(void)
{
    TEST_ASSERT_TRUE(out.has_drive);
    TEST_ASSERT_EQUAL_INT16(0, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL_INT16(0, out.drive.right_mm_s);
    TEST_ASSERT_FALSE(out.drive.eat);
}

/* Responds to the next tick: the wheels have followed the last drive, and these sensors are triggered. Wheels that
 * obey: 0.2 counts per tick and mm/s. */
static inline void obey(uint8_t feel)
{
    wheels.tick++;
    wheels.feel = feel;
    wheels.odometer_left = (uint16_t)((wheels.odometer_left + out.drive.left_mm_s / 5) & (ODOMETER_SPAN - 1));
    wheels.odometer_right = (uint16_t)((wheels.odometer_right + out.drive.right_mm_s / 5) & (ODOMETER_SPAN - 1));
    sense(wheels);
}

#endif
