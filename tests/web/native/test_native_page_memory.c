/* Memories of a page's robots: bytes, turns, and translation between memory kinds. */
#include "page_rig.h"

#include <string.h>
#include <stddef.h>

#include "firmware/memory/memory.h"
#include "tests/test.h"

enum { ALL_FOUR = 15, UPPER = 1 << 4 };

TEST(new_robot_has_an_empty_memory)
{
    static const uint8_t nothing[CELL_COUNT] = {0};

    TEST_ASSERT_EQUAL_HEX8_ARRAY(nothing, page_memory(0), CELL_COUNT);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(nothing, page_sides(0), CELL_COUNT);
}

TEST(write_command_sets_its_cells)
{
    static const uint8_t expected[CELL_COUNT] = {0, SIDE_LEFT, SIDE_RIGHT, 0, 0, 0, 0, SIDE_LEFT};

    start(0, PROFILE_ARTICLE);
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_WRITE, 1 << 1 | 1 << 2, SIDE_LEFT << 8 | SIDE_RIGHT << 16));
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_WRITE, UPPER | 1 << 3, (uint32_t)SIDE_LEFT << 24));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, page_memory(0), CELL_COUNT);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, page_sides(0), CELL_COUNT);
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_ERASE, 0, 0));
    TEST_ASSERT_EACH_EQUAL_HEX8(0, page_memory(0), CELL_COUNT);
}

TEST(written_side_has_the_memory_kind_of_the_behaviour)
{
    static const uint8_t sides[PAGE_BYTES] = {0, 0, SIDE_LEFT}, none[PAGE_BYTES] = {0};
    static const uint8_t expected[PAGE_BYTES] = {0, 0, SIDE_LEFT, SIDE_RIGHT};

    start(0, PROFILE_ARTICLE);
    put_bytes(sides);
    page_write_side(0, 3, SIDE_RIGHT);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, page_bytes(), PAGE_BYTES);
    start(1, PROFILE_FIVE);
    put_bytes(none);
    TEST_ASSERT_TRUE(page_translate(1));
    page_write_side(1, 3, SIDE_RIGHT);
    TEST_ASSERT_TRUE(feel_memory_is(page_bytes()));
}

TEST(bytes_of_another_memory_kind_are_translated)
{
    static const uint8_t sides[PAGE_BYTES] = {0, 0, SIDE_LEFT, SIDE_RIGHT};

    start(0, PROFILE_FIVE);
    put_bytes(sides);
    TEST_ASSERT_TRUE(page_translate(0));
    TEST_ASSERT_TRUE(feel_memory_is(page_bytes()));
    start(1, PROFILE_ARTICLE);
    TEST_ASSERT_TRUE(page_translate(1));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(sides, page_bytes(), PAGE_BYTES);
}

TEST(translation_leaves_invalid_bytes_unchanged)
{
    static const uint8_t garbage[PAGE_BYTES] = {1, 2, 3, 255, 255, 255, 255, 255};

    start(0, PROFILE_ARTICLE);
    put_bytes(garbage);
    TEST_ASSERT_FALSE(page_translate(0));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(garbage, page_bytes(), PAGE_BYTES);
}

TEST(page_returns_turns_for_each_kind_of_memory)
{
    static const uint8_t sides[PAGE_BYTES] = {0, 0, SIDE_LEFT, SIDE_RIGHT};

    for (uint8_t profile = 0; profile < PROFILE_COUNT; profile++) {
        const uint8_t *bytes = page_bytes();

        start(0, (enum profile)profile);
        if (profile == PROFILE_FIXED)   /* its turns are given */
            continue;
        put_bytes(sides);
        TEST_ASSERT_TRUE(page_translate(0));
        for (uint32_t half = 0; half < 2; half++, bytes += 4) {
            uint32_t word = bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;

            page_state()->robots[0].octet->robot.brain.memory.cell[0] = page_bytes()[0];
            TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_WRITE, half << 4 | ALL_FOUR, word));
        }
        TEST_ASSERT_EQUAL_HEX8_ARRAY(sides, page_sides(0), CELL_COUNT);
    }
}

/* Robots of a page whose brain is a program. */

static const double *load(const char *text)
{
    memcpy(page_program_text(), text, strlen(text));
    TEST_ASSERT_TRUE(page_program(0, (uint32_t)strlen(text)));
    return page_program_state(0);
}

TEST(program_decides_the_actions_of_a_robot)
{
    const double *state = load("xyString 1, 2, \"on\"\nrForward 5");
    struct input in = {.senses = {.tick = 1}};
    struct output out;

    start(0, PROFILE_ARTICLE);
    page_state()->robots[0].octet->respond(&page_state()->robots[0].octet->robot, INPUT_SENSES, &in, &out);
    state = page_program_state(0);
    TEST_ASSERT_EQUAL(REASON_WANDER, out.drive.reason);
    TEST_ASSERT_EQUAL_DOUBLE(0, state[PAGE_PROGRAM_ENDED]);
    TEST_ASSERT_EQUAL_DOUBLE(EXPECTED_NOTHING, state[PAGE_PROGRAM_EXPECTED]);
    TEST_ASSERT_EQUAL_DOUBLE(2, state[PAGE_PROGRAM_STEPS]);
    TEST_ASSERT_EQUAL_DOUBLE(1, state[PAGE_PROGRAM_NUMBERS]);
    TEST_ASSERT_EQUAL_DOUBLE(1, state[PAGE_PROGRAM_SHOWN]);
    TEST_ASSERT_EQUAL_STRING("on", page_program_shown(0, 0));
}

TEST(page_reports_the_mistake_of_a_program)
{
    const double *state = load("x = 1\nrTrun 5");

    TEST_ASSERT_EQUAL_DOUBLE(0, state[PAGE_PROGRAM_ENDED]);
    TEST_ASSERT_EQUAL_DOUBLE(2, state[PAGE_PROGRAM_LINE]);
    TEST_ASSERT_EQUAL_STRING("rTrun", page_program_word(0));
    TEST_ASSERT_EQUAL_STRING("a command, a label, or a variable with = after it",
                             page_program_expected((uint32_t)state[PAGE_PROGRAM_EXPECTED]));
    TEST_ASSERT_EQUAL_DOUBLE(0, state[PAGE_PROGRAM_SHOWN]);
}

TEST(page_reports_the_variables_of_a_program)
{
    const double *state = load("ab = 5\nlabel:\ndim c[3]"), *variables = state + PAGE_PROGRAM_NUMBERS;

    TEST_ASSERT_EQUAL_DOUBLE(2, state[PAGE_PROGRAM_VARIABLES]);
    TEST_ASSERT_EQUAL_DOUBLE(2, variables[3]);
    TEST_ASSERT_EQUAL_DOUBLE(3, variables[5]);
    TEST_ASSERT_EQUAL_DOUBLE(18, variables[6]);
    TEST_ASSERT_EQUAL_DOUBLE(4, state[PAGE_PROGRAM_CELLS]);
    TEST_ASSERT_EQUAL_DOUBLE(0, page_program_cells(0)[0]);
}

/* What a robot of a page has learned, from the rows of its last block. */

static void fill(uint32_t tick, int16_t action, enum reason reason, int16_t feel)
{
    int16_t *at = page_state()->robots[1].rows + tick * ROW_COUNT;

    at[ROW_FEEL] = feel;
    at[ROW_LEFT_MM_S] = -200;
    at[ROW_RIGHT_MM_S] = 200;
    at[ROW_REASON] = (int16_t)reason;
    at[ROW_ACTION] = action;
    page_state()->loop.ticks = tick + 1;
}

/* The robot's own memory is empty, whatever the history contains. */
static void begin(void)
{
    page_history_begin(1);
    fill(0, 1, REASON_TRIAL, 6 << 1);
    fill(1, 2, REASON_WANDER, 0);
}

TEST(history_take_returns_the_notes_of_a_block)
{
    begin();
    page_history_freeze(1, 1);
    TEST_ASSERT_EQUAL_UINT32(2, page_history_take(1, 100.0));
    TEST_ASSERT_EQUAL_DOUBLE(100.0, page_notes()[0].tick);
    TEST_ASSERT_EQUAL_INT32(REASON_TRIAL, page_notes()[0].reason);
    TEST_ASSERT_EQUAL_INT32(6, page_notes()[0].cell);
    TEST_ASSERT_EQUAL_DOUBLE(101.0, page_notes()[1].tick);
    TEST_ASSERT_EQUAL_INT32(1, page_notes()[1].trial.helped);
    TEST_ASSERT_EQUAL_INT32(1, page_notes()[1].trial.frozen);
    TEST_ASSERT_EQUAL_UINT32(0, page_lesson_count(1));
}

TEST(notes_and_lessons_have_the_layout_that_javascript_reads)
{
    TEST_ASSERT_EQUAL_size_t(14 * sizeof(int32_t), sizeof(struct history_note));
    TEST_ASSERT_EQUAL_size_t(8, offsetof(struct history_note, reason));
    TEST_ASSERT_EQUAL_size_t(24, offsetof(struct history_note, learned));
    TEST_ASSERT_EQUAL_size_t(32, offsetof(struct history_note, trial));
    TEST_ASSERT_EQUAL_size_t(4 * sizeof(int32_t), sizeof(struct history_lesson));
}

TEST(cell_that_becomes_empty_is_a_lesson)
{
    begin();
    page_state()->histories[1].sides[3] = SIDE_RIGHT;
    (void)page_history_take(1, 100.0);
    TEST_ASSERT_EQUAL_UINT32(1, page_lesson_count(1));
    TEST_ASSERT_EQUAL_INT32(3, page_lessons(1)->cell);
    TEST_ASSERT_EQUAL_INT32(1, page_lessons(1)->by_hand);
    TEST_ASSERT_EQUAL_UINT32(0, page_lesson_count(0));
}

TEST(change_between_ticks_is_a_lesson_by_hand)
{
    begin();
    page_state()->histories[1].sides[3] = SIDE_RIGHT;
    page_history_relearn(1, 50.0);
    TEST_ASSERT_EQUAL_INT32(3, page_lessons(1)->cell);
    TEST_ASSERT_EQUAL_DOUBLE(50.0, page_state()->histories[1].learned[3]);
    page_history_restart(1);
    TEST_ASSERT_EQUAL_UINT32(0, page_lesson_count(1));
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, page_state()->histories[1].learned[3]);
}
