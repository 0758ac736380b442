/* What the core executes is counted by its instructions: a program in the test's memory, in Thumb's half-words. */
#include "host_sim/emulator/models/core_blocks.h"

#include <string.h>

#include "tests/test.h"

enum { NARROW = 0xE7FF, WIDE = 0xE800, PROGRAM = 0x08000000, HALVES = 16, PERIOD_NS = 10 };

static struct {
    uint16_t halves[HALVES];
    unsigned readable;      /* bytes of it */
    unsigned reads, stops;
} emulator;

static struct board_clock board;
static struct core_blocks blocks;

static int stop(void *it)
{
    TEST_ASSERT_EQUAL_PTR(&emulator, it);
    emulator.stops++;
    return 0;
}

/* Unicorn gives the core's memory, lowest byte first; a program beyond BLOCKS_KEPT looks the same again. */
static int read_code(void *it, uint64_t address, void *bytes, uint64_t size)
{
    uint64_t at = address % (2 * BLOCKS_KEPT);
    uint16_t half = emulator.halves[at / 2 % HALVES];

    TEST_ASSERT_EQUAL_PTR(&emulator, it);
    TEST_ASSERT_EQUAL_UINT64(2, size);
    emulator.reads++;
    memcpy(bytes, (const uint8_t[]){(uint8_t)half, (uint8_t)(half >> 8)}, 2);
    return at < emulator.readable ? 0 : -1;
}

void setUp(void)
{
    memset(&emulator, 0, sizeof emulator);
    emulator.readable = 2 * HALVES;
    board = (struct board_clock){.period_fs = PERIOD_NS * UINT64_C(1000000), .horizon = {UINT64_MAX, 0}};
    memset(&blocks, 0, sizeof blocks);
    blocks.clock = &board;
    blocks.stop = stop;
    blocks.read = read_code;
}

static void execute(uint32_t offset, uint32_t size)
{
    core_on_block(&emulator, PROGRAM + offset, size, &blocks);
}

static void assert_instructions(uint64_t expected)
{
    TEST_ASSERT_EQUAL_UINT64(expected, blocks.instructions);
    TEST_ASSERT_EQUAL_UINT64(expected, board.cycles);
    TEST_ASSERT_EQUAL_UINT64(expected * PERIOD_NS, board.now.ns);
}

TEST(instructions_are_one_or_two_half_words_long)
{
    static const uint16_t program[] = {0xBF00, NARROW, WIDE, 0xBF00, 0xF3BF, 0x8F4F, 0x4770};   /* 5 instructions */

    memcpy(emulator.halves, program, sizeof program);
    execute(0, sizeof program);
    assert_instructions(5);
}

/* The second half of an instruction may look like the first one of a long one. */
TEST(the_second_half_of_an_instruction_begins_none)
{
    static const uint16_t program[] = {0xF000, 0xF800, 0xBF00};

    memcpy(emulator.halves, program, sizeof program);
    execute(0, sizeof program);
    assert_instructions(2);
}

TEST(a_block_is_read_once)
{
    for (unsigned n = 0; n < 3; n++)
        execute(0, 8);
    assert_instructions(12);
    TEST_ASSERT_EQUAL_UINT(4, emulator.reads);
}

TEST(a_block_of_another_length_is_another_block)
{
    execute(0, 8);
    execute(0, 4);
    assert_instructions(6);
    execute(0, 8);
    assert_instructions(10);
}

TEST(blocks_that_share_a_place_take_turns)
{
    emulator.halves[0] = WIDE;
    execute(0, 8);
    assert_instructions(3);
    execute(2 * BLOCKS_KEPT, 8);
    assert_instructions(6);
    TEST_ASSERT_EQUAL_UINT(6, emulator.reads);
}

TEST(what_cannot_be_read_is_not_counted)
{
    emulator.readable = 4;
    execute(0, 8);
    assert_instructions(2);
}

TEST(no_block_begins_after_a_stop)
{
    blocks.stopping = true;
    execute(0, 8);
    TEST_ASSERT_EQUAL_UINT(1, emulator.stops);
    assert_instructions(0);
}

TEST(no_block_begins_once_something_has_failed)
{
    board.failed = true;
    execute(0, 8);
    TEST_ASSERT_EQUAL_UINT(1, emulator.stops);
    assert_instructions(0);
}

/* A debugger has halted after two of four instructions, and lets the core execute one, then the rest. */
TEST(the_rest_of_a_block_in_which_a_debugger_halted_is_not_counted_again)
{
    execute(0, 8);
    TEST_ASSERT_EQUAL_UINT64(PROGRAM + 8, blocks.end);
    blocks.counted_to = blocks.end;
    blocks.stopping = true;
    execute(4, 2);
    execute(6, 2);
    TEST_ASSERT_EQUAL_UINT64(0, blocks.counted_to);
    TEST_ASSERT_EQUAL_UINT(0, emulator.stops);
    assert_instructions(4);
    execute(8, 2);
    TEST_ASSERT_EQUAL_UINT(1, emulator.stops);
}
