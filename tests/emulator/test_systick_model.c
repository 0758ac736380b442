/* The model of SysTick against PM0214 4.5. */
#include "host_sim/emulator/models/systick_model.h"
#include "tests/test.h"

static struct board_clock board;
static struct systick timer;

void setUp(void)
{
    board = (struct board_clock){.cycles = 1000};
    timer = (struct systick){.clock = &board, .ctrl = SYSTICK_ENABLE | SYSTICK_CLKSOURCE, .load = 9, .since_cycles = 1000};
}

static uint32_t value_after(uint64_t cycles)
{
    board.cycles = timer.since_cycles + cycles;
    return systick_value(&timer);
}

TEST(it_counts_the_cores_cycles_since_it_was_restarted)
{
    TEST_ASSERT_EQUAL_UINT64(0, systick_counted(&timer));
    board.cycles = 1007;
    TEST_ASSERT_EQUAL_UINT64(7, systick_counted(&timer));
}

TEST(from_the_other_source_it_counts_each_eighth)
{
    timer.ctrl = SYSTICK_ENABLE;
    board.cycles = 1007;
    TEST_ASSERT_EQUAL_UINT64(0, systick_counted(&timer));
    board.cycles = 1008;
    TEST_ASSERT_EQUAL_UINT64(1, systick_counted(&timer));
    board.cycles = 1800;
    TEST_ASSERT_EQUAL_UINT64(100, systick_counted(&timer));
}

TEST(a_timer_that_is_off_counts_nothing)
{
    timer.ctrl = SYSTICK_CLKSOURCE;
    board.cycles = 1007;
    TEST_ASSERT_EQUAL_UINT64(0, systick_counted(&timer));
    TEST_ASSERT_EQUAL_UINT32(0, systick_value(&timer));
}

/* From 0 it goes to LOAD, so that a turn takes LOAD + 1 counts. */
TEST(it_counts_down_from_load_to_0_over_and_over)
{
    static const uint32_t values[] = {0, 9, 8, 7, 6, 5, 4, 3, 2, 1, 0, 9, 8};

    for (unsigned count = 0; count < sizeof values / sizeof *values; count++)
        TEST_ASSERT_EQUAL_UINT32(values[count], value_after(count));
}

TEST(load_may_be_0_and_as_great_as_a_word)
{
    timer.load = 0;
    TEST_ASSERT_EQUAL_UINT32(0, value_after(5));
    timer.load = UINT32_MAX;
    TEST_ASSERT_EQUAL_UINT32(UINT32_MAX, value_after(1));
    TEST_ASSERT_EQUAL_UINT32(1, value_after(UINT32_MAX));
    TEST_ASSERT_EQUAL_UINT32(0, value_after(UINT64_C(1) << 32));
}
