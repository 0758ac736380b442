/* The core's instructions are counted block by block, here of a Thumb program in the test's memory. */
#include "tests/test.h"
#include "host_sim/emulator/models/core_blocks.h"

#include <string.h>

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

BEFORE_EACH(core_blocks)
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
TEST(second_half_word_starts_no_instruction)
{
    static const uint16_t program[] = {0xF000, 0xF800, 0xBF00};

    memcpy(emulator.halves, program, sizeof program);
    execute(0, sizeof program);
    assert_instructions(2);
}

TEST(repeated_block_is_read_from_memory_once)
{
    for (unsigned n = 0; n < 3; n++)
        execute(0, 8);
    assert_instructions(12);
    TEST_ASSERT_EQUAL_UINT(4, emulator.reads);
}

TEST(block_of_another_length_is_counted_anew)
{
    execute(0, 8);
    execute(0, 4);
    assert_instructions(6);
    execute(0, 8);
    assert_instructions(10);
}

TEST(blocks_of_one_cache_entry_replace_each_other)
{
    emulator.halves[0] = WIDE;
    execute(0, 8);
    assert_instructions(3);
    execute(2 * BLOCKS_KEPT, 8);
    assert_instructions(6);
    TEST_ASSERT_EQUAL_UINT(6, emulator.reads);
}

TEST(unreadable_instructions_are_not_counted)
{
    emulator.readable = 4;
    execute(0, 8);
    assert_instructions(2);
}

TEST(core_executes_no_block_when_stopping)
{
    blocks.stopping = true;
    execute(0, 8);
    TEST_ASSERT_EQUAL_UINT(1, emulator.stops);
    assert_instructions(0);
}

TEST(core_executes_no_block_after_a_failure)
{
    board.failed = true;
    execute(0, 8);
    TEST_ASSERT_EQUAL_UINT(1, emulator.stops);
    assert_instructions(0);
}

/* A debugger has halted after two of four instructions, and lets the core execute one, then the rest. */
TEST(block_resumed_after_a_halt_is_counted_once)
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

/* The model of SysTick against PM0214 4.5. */

static struct systick timer;

BEFORE_EACH(systick_model)
{
    board = (struct board_clock){.cycles = 1000};
    timer = (struct systick){.clock = &board, .ctrl = SYSTICK_ENABLE | SYSTICK_CLKSOURCE, .load = 9, .since_cycles = 1000};
}

static uint32_t value_after(uint64_t cycles)
{
    board.cycles = timer.since_cycles + cycles;
    return systick_value(&timer);
}

TEST(systick_counts_core_cycles_since_restart)
{
    TEST_ASSERT_EQUAL_UINT64(0, systick_counted(&timer));
    board.cycles = 1007;
    TEST_ASSERT_EQUAL_UINT64(7, systick_counted(&timer));
}

TEST(systick_external_clock_counts_every_eighth_cycle)
{
    timer.ctrl = SYSTICK_ENABLE;
    board.cycles = 1007;
    TEST_ASSERT_EQUAL_UINT64(0, systick_counted(&timer));
    board.cycles = 1008;
    TEST_ASSERT_EQUAL_UINT64(1, systick_counted(&timer));
    board.cycles = 1800;
    TEST_ASSERT_EQUAL_UINT64(100, systick_counted(&timer));
}

TEST(disabled_systick_does_not_count)
{
    timer.ctrl = SYSTICK_CLKSOURCE;
    board.cycles = 1007;
    TEST_ASSERT_EQUAL_UINT64(0, systick_counted(&timer));
    TEST_ASSERT_EQUAL_UINT32(0, systick_value(&timer));
}

/* From 0 it goes to LOAD, so that a turn takes LOAD + 1 counts. */
TEST(systick_value_wraps_from_0_to_load)
{
    static const uint32_t values[] = {0, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0, 9, 8};

    for (unsigned count = 0; count < sizeof values / sizeof *values; count++)
        TEST_ASSERT_EQUAL_UINT32(values[count], value_after(count));
}

TEST(systick_accepts_load_of_0_and_32_bits)
{
    timer.load = 0;
    TEST_ASSERT_EQUAL_UINT32(0, value_after(5));
    timer.load = UINT32_MAX;
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, value_after(1));
    TEST_ASSERT_EQUAL_UINT32(1, value_after(UINT32_MAX));
    TEST_ASSERT_EQUAL_UINT32(0, value_after(UINT64_C(1) << 32));
}
