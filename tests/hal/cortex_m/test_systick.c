#include "hal/port/cortex_m/systick.h"

#include <string.h>

#include "tests/test.h"
#include "hal/port/cortex_m/core.h"

enum { SPAN = 1 << 24, CORE_HZ = 168000000, PER_MS = CORE_HZ / 8 / 1000 };

volatile struct systick_registers SYSTICK;

static void passes(uint32_t counts)
{
    SYSTICK.val = (SYSTICK.val - counts) & (SPAN - 1);
}

void setUp(void)
{
    memset((void *)&SYSTICK, 0, sizeof SYSTICK);
    systick_start(CORE_HZ, 8);
}

TEST(the_timer_runs_free_from_an_eighth_of_the_clock)
{
    TEST_ASSERT_EQUAL_HEX32(SPAN - 1, SYSTICK.load);
    TEST_ASSERT_EQUAL_HEX32(1, SYSTICK.ctrl);
}

TEST(without_a_reference_the_timer_counts_the_core_clock)
{
    uint32_t start;

    systick_start(CORE_HZ, 1);
    TEST_ASSERT_EQUAL_HEX32(5, SYSTICK.ctrl);
    start = machine_ms();
    passes(CORE_HZ / 1000 - 1);
    TEST_ASSERT_EQUAL_UINT32(0, machine_ms() - start);
    passes(1);
    TEST_ASSERT_EQUAL_UINT32(1, machine_ms() - start);
}

TEST(it_starts_anew_when_the_clock_has_changed)
{
    uint32_t start;

    passes(10 * PER_MS + 1);
    start = machine_ms();
    SYSTICK.val = 0x123456;
    systick_start(CORE_HZ / 2, 8);
    TEST_ASSERT_EQUAL_HEX32(0, SYSTICK.val);
    TEST_ASSERT_EQUAL_UINT32(0, machine_ms() - start);
    passes(PER_MS / 2);
    TEST_ASSERT_EQUAL_UINT32(1, machine_ms() - start);
}

/* The last bit of the count decides. */
TEST(an_odd_number_of_counts_is_counted_too)
{
    uint32_t start;

    systick_start(8000 * 3, 8);
    start = machine_ms();
    passes(3);
    TEST_ASSERT_EQUAL_UINT32(1, machine_ms() - start);
}

TEST(a_millisecond_passes_after_21000_counts)
{
    uint32_t start = machine_ms();

    passes(PER_MS - 1);
    TEST_ASSERT_EQUAL_UINT32(0, machine_ms() - start);
    passes(1);
    TEST_ASSERT_EQUAL_UINT32(1, machine_ms() - start);
}

TEST(no_count_is_lost_however_often_it_is_asked)
{
    uint32_t start = machine_ms();

    for (uint64_t counts = 0; counts < 100ull * SPAN; counts += 4999) {
        (void)machine_ms();
        passes(4999);
    }
    TEST_ASSERT_UINT32_WITHIN(1, 100ull * SPAN / PER_MS, machine_ms() - start);
}

TEST(half_a_second_without_asking_is_noticed_in_full)
{
    uint32_t start = machine_ms();

    passes(500 * PER_MS);
    TEST_ASSERT_EQUAL_UINT32(500, machine_ms() - start);
}
