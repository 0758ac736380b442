#include "hal/port/cortex_m/systick.h"

#include <string.h>

#include "tests/test.h"
#include "hal/port/cortex_m/core.h"

enum { SPAN = 1 << 24, CORE_HZ = 168000000, PER_MS = CORE_HZ / 8 / 1000 };

volatile struct systick_registers SYSTICK;

static void advance_counts(uint32_t counts)
{
    SYSTICK.val = (SYSTICK.val - counts) & (SPAN - 1);
}

void setUp(void)
{
    memset((void *)&SYSTICK, 0, sizeof SYSTICK);
    systick_start(CORE_HZ, 8);
}

TEST(systick_runs_free_at_an_eighth_of_the_core_clock)
{
    TEST_ASSERT_EQUAL_HEX32(SPAN - 1, SYSTICK.load);
    TEST_ASSERT_EQUAL_HEX32(1, SYSTICK.ctrl);
}

TEST(systick_with_divisor_1_counts_the_core_clock)
{
    uint32_t start;

    systick_start(CORE_HZ, 1);
    TEST_ASSERT_EQUAL_HEX32(5, SYSTICK.ctrl);
    start = machine_ms();
    advance_counts(CORE_HZ / 1000 - 1);
    TEST_ASSERT_EQUAL_UINT32(0, machine_ms() - start);
    advance_counts(1);
    TEST_ASSERT_EQUAL_UINT32(1, machine_ms() - start);
}

TEST(systick_restarts_when_the_clock_changes)
{
    uint32_t start;

    advance_counts(10 * PER_MS + 1);
    start = machine_ms();
    SYSTICK.val = 0x123456;
    systick_start(CORE_HZ / 2, 8);
    TEST_ASSERT_EQUAL_HEX32(0, SYSTICK.val);
    TEST_ASSERT_EQUAL_UINT32(0, machine_ms() - start);
    advance_counts(PER_MS / 2);
    TEST_ASSERT_EQUAL_UINT32(1, machine_ms() - start);
}

/* The lowest bit of the count matters. */
TEST(odd_number_of_counts_makes_a_millisecond)
{
    uint32_t start;

    systick_start(8000 * 3, 8);
    start = machine_ms();
    advance_counts(3);
    TEST_ASSERT_EQUAL_UINT32(1, machine_ms() - start);
}

TEST(millisecond_passes_after_21000_counts)
{
    uint32_t start = machine_ms();

    advance_counts(PER_MS - 1);
    TEST_ASSERT_EQUAL_UINT32(0, machine_ms() - start);
    advance_counts(1);
    TEST_ASSERT_EQUAL_UINT32(1, machine_ms() - start);
}

TEST(frequent_reads_lose_no_count)
{
    uint32_t start = machine_ms();

    for (uint64_t counts = 0; counts < 100ull * SPAN; counts += 4999) {
        (void)machine_ms();
        advance_counts(4999);
    }
    TEST_ASSERT_UINT32_WITHIN(1, 100ull * SPAN / PER_MS, machine_ms() - start);
}

TEST(clock_counts_half_a_second_without_a_call)
{
    uint32_t start = machine_ms();

    advance_counts(500 * PER_MS);
    TEST_ASSERT_EQUAL_UINT32(500, machine_ms() - start);
}
