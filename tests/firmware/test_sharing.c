#include "firmware/sharing.h"

#include "firmware/memory/memory.h"
#include "firmware/robot.h"

#include <string.h>

#include "tests/test.h"

enum { CELL_FRONT = 2, TICKS_A_SECOND = 50 };

static struct robot robot;
static struct output out;

static void respond(enum input_kind kind, struct input in)
{
    robot_respond(&robot, kind, &in, &out);
}

static void start(enum profile profile, uint8_t share)
{
    respond(INPUT_COMMAND, (struct input){.command = {.opcode = OPCODE_START, .which = (uint8_t)profile}});
    respond(INPUT_COMMAND, (struct input){.command = {.opcode = OPCODE_SET, .which = SHARE, .value = share}});
}

static void hear(bool upper, const uint8_t cells[CELL_COUNT / 2])
{
    struct input in = {.peer.upper = upper};

    memcpy(in.peer.cell, cells, sizeof in.peer.cell);
    respond(INPUT_PEER, in);
}

static void hear_front(uint8_t cell)
{
    hear(false, (const uint8_t[]){0, 0, cell, 0});
}

static uint16_t rolled(uint16_t odometer, int16_t mm_s)
{
    return (uint16_t)((odometer + mm_s * ODOMETER_COUNTS_PER_MM / TICKS_A_SECOND) & (ODOMETER_SPAN - 1));
}

/* Runs on obeying wheels up to the tick with which the second ends. */
static void pass_second(void)
{
    static struct senses senses;

    do {
        respond(INPUT_SENSES, (struct input){.senses = senses});
        senses.tick++;
        senses.odometer_left = rolled(senses.odometer_left, out.drive.left_mm_s);
        senses.odometer_right = rolled(senses.odometer_right, out.drive.right_mm_s);
    } while (!out.has_report);
}

void setUp(void)
{
    robot_init(&robot, 1);
    start(PROFILE_ADAPTIVE, 1);
    pass_second();
}

static void assert_cell(uint8_t expected)
{
    TEST_ASSERT_EQUAL_HEX8(expected, robot.brain.memory.cell[CELL_FRONT]);
}

TEST(majority_fills_an_empty_cell_with_least_confidence)
{
    hear_front(confidence_cell(SIDE_RIGHT, 3));
    hear_front(confidence_cell(SIDE_LEFT, 1));
    hear_front(confidence_cell(SIDE_LEFT, 1));
    pass_second();
    assert_cell(confidence_cell(SIDE_LEFT, 1));
}

TEST(tied_votes_fill_no_cell)
{
    hear_front(confidence_cell(SIDE_RIGHT, 3));
    hear_front(confidence_cell(SIDE_LEFT, 1));
    pass_second();
    assert_cell(0);
}

TEST(votes_fill_cells_of_both_halves)
{
    static const uint8_t lower[] = {0, 1, 2, 1}, upper[] = {2, 1, 2, 1};
    static const uint8_t expected[CELL_COUNT] = {0, 5, 6, 5, 6, 5, 6, 5};

    hear(true, upper);
    hear(false, lower);
    pass_second();
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, robot.brain.memory.cell, CELL_COUNT);
}

TEST(votes_fill_a_sides_memory_without_confidence)
{
    start(PROFILE_ARTICLE, 1);
    pass_second();
    hear_front(confidence_cell(SIDE_RIGHT, 3));
    pass_second();
    assert_cell(SIDE_RIGHT);
}

TEST(invalid_cell_has_no_vote)
{
    static const uint8_t others[] = {0, 3, 4, 7, 8, 11, 15, 16, 17, 0x10, 0x80, 0xFF};

    for (unsigned i = 0; i < sizeof others; i++)
        hear_front(others[i]);
    pass_second();
    assert_cell(0);
}

TEST(votes_keep_a_filled_cell)
{
    robot.brain.memory.cell[CELL_FRONT] = confidence_cell(SIDE_RIGHT, 1);
    hear_front(SIDE_LEFT);
    pass_second();
    assert_cell(confidence_cell(SIDE_RIGHT, 1));
}

TEST(cell_emptied_by_boredom_ignores_votes_until_start)
{
    robot.brain.unlearned = 1u << CELL_FRONT;
    hear_front(SIDE_LEFT);
    pass_second();
    assert_cell(0);
    start(PROFILE_ADAPTIVE, 1);
    pass_second();
    hear_front(SIDE_LEFT);
    pass_second();
    assert_cell(confidence_cell(SIDE_LEFT, 1));
}

TEST(votes_are_counted_per_second)
{
    hear_front(SIDE_LEFT);
    hear_front(SIDE_LEFT);
    robot.brain.frozen = true;
    pass_second();
    robot.brain.frozen = false;
    hear_front(SIDE_RIGHT);
    pass_second();
    assert_cell(confidence_cell(SIDE_RIGHT, 1));
}

TEST(sharing_ignores_votes_from_before_the_start)
{
    start(PROFILE_ADAPTIVE, 1);
    hear_front(SIDE_LEFT);
    pass_second();
    assert_cell(0);
}

TEST(disabled_sharing_fills_no_cell)
{
    start(PROFILE_ADAPTIVE, 0);
    for (unsigned i = 0; i < 3; i++) {
        hear_front(SIDE_LEFT);
        pass_second();
    }
    assert_cell(0);
}

TEST(frozen_or_stopped_robot_takes_no_votes)
{
    robot.brain.frozen = true;
    hear_front(SIDE_LEFT);
    pass_second();
    assert_cell(0);
    robot.brain.frozen = false;
    respond(INPUT_COMMAND, (struct input){.command = {.opcode = OPCODE_STOP}});
    hear_front(SIDE_LEFT);
    pass_second();
    assert_cell(0);
}

TEST(profile_without_learning_or_pattern_cells_takes_no_votes)
{
    static const enum profile profiles[] = {PROFILE_NEVER, PROFILE_FIVE};
    static const uint8_t nothing[CELL_COUNT] = {0};

    for (unsigned i = 0; i < 2; i++) {
        start(profiles[i], 1);
        pass_second();
        hear_front(SIDE_LEFT);
        pass_second();
        TEST_ASSERT_EQUAL_HEX8_ARRAY(nothing, robot.brain.memory.cell, CELL_COUNT);
    }
}

TEST(filled_cell_is_stored_and_reported)
{
    hear_front(SIDE_LEFT);
    pass_second();
    TEST_ASSERT_TRUE(out.store);
    TEST_ASSERT_FALSE(out.has_memory);
    TEST_ASSERT_EQUAL_HEX8(confidence_cell(SIDE_LEFT, 1), out.memory[CELL_FRONT]);
    pass_second();
    TEST_ASSERT_FALSE(out.store);
}

TEST(peer_memory_causes_no_output)
{
    memset(&out, 0xA5, sizeof out);
    hear_front(SIDE_LEFT);
    TEST_ASSERT_FALSE(out.has_answer || out.has_report || out.has_memory || out.has_drive || out.store);
}

TEST(votes_are_dropped_in_the_second_of_switching_off)
{
    hear_front(SIDE_LEFT);
    respond(INPUT_COMMAND, (struct input){.command = {.opcode = OPCODE_SET, .which = SHARE}});
    pass_second();
    assert_cell(0);
}

TEST(votes_are_dropped_in_the_second_of_switching_on)
{
    respond(INPUT_COMMAND, (struct input){.command = {.opcode = OPCODE_SET, .which = SHARE}});
    pass_second();
    hear_front(SIDE_LEFT);
    respond(INPUT_COMMAND, (struct input){.command = {.opcode = OPCODE_SET, .which = SHARE, .value = 1}});
    pass_second();
    assert_cell(0);
}
