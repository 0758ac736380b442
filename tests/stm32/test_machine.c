#include "hal/stm32/machine.h"

#include <string.h>

#include <unity.h>

#include "hal/stm32/registers.h"

enum { SPAN = 1 << 24, PER_MS = 21000 };

volatile struct watchdog_registers IWDG;
volatile struct systick_registers SYSTICK;

static bool pins_started;

struct clocks clock_start(void)
{
    TEST_ASSERT_EQUAL_HEX32(0xAAAA, IWDG.kr);   /* the watchdog watches the clocks start */
    return (struct clocks){168000000, 42000000, 84000000, true};
}

void pins_start(void)
{
    pins_started = true;
}

static void passes(uint32_t counts)
{
    SYSTICK.val = (SYSTICK.val - counts) & (SPAN - 1);
}

void setUp(void)
{
    memset((void *)&IWDG, 0, sizeof IWDG);
    memset((void *)&SYSTICK, 0, sizeof SYSTICK);
    pins_started = false;
    machine_start();
}

void tearDown(void) {}

static void test_it_starts_the_watchdog_for_2_seconds(void)
{
    TEST_ASSERT_EQUAL_UINT32(3, IWDG.pr);   /* by 32 */
    TEST_ASSERT_EQUAL_UINT32(2000, IWDG.rlr);
}

static void test_a_watchdog_that_stays_busy_does_not_hold_up_the_start(void)
{
    IWDG.sr = 3;
    machine_start();
    TEST_ASSERT_TRUE(pins_started);
}

static void test_the_timer_runs_free_from_an_eighth_of_the_clock(void)
{
    TEST_ASSERT_EQUAL_HEX32(SPAN - 1, SYSTICK.load);
    TEST_ASSERT_EQUAL_HEX32(1, SYSTICK.ctrl);
}

static void test_the_clocks_are_as_they_started(void)
{
    TEST_ASSERT_EQUAL_UINT32(42000000, machine_clocks().can_hz);
}

static void test_a_millisecond_passes_after_21000_counts(void)
{
    uint32_t start = machine_ms();

    passes(PER_MS - 1);
    TEST_ASSERT_EQUAL_UINT32(0, machine_ms() - start);
    passes(1);
    TEST_ASSERT_EQUAL_UINT32(1, machine_ms() - start);
}

static void test_no_count_is_lost_however_often_it_is_asked(void)
{
    uint32_t start = machine_ms();

    for (uint64_t counts = 0; counts < 100ull * SPAN; counts += 4999) {
        (void)machine_ms();
        passes(4999);
    }
    TEST_ASSERT_UINT32_WITHIN(1, 100ull * SPAN / PER_MS, machine_ms() - start);
}

static void test_half_a_second_without_asking_is_noticed_in_full(void)
{
    uint32_t start = machine_ms();

    passes(500 * PER_MS);
    TEST_ASSERT_EQUAL_UINT32(500, machine_ms() - start);
}

static void test_feeding_feeds(void)
{
    IWDG.kr = 0;
    machine_feed();
    TEST_ASSERT_EQUAL_HEX32(0xAAAA, IWDG.kr);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_starts_the_watchdog_for_2_seconds);
    RUN_TEST(test_a_watchdog_that_stays_busy_does_not_hold_up_the_start);
    RUN_TEST(test_the_timer_runs_free_from_an_eighth_of_the_clock);
    RUN_TEST(test_the_clocks_are_as_they_started);
    RUN_TEST(test_a_millisecond_passes_after_21000_counts);
    RUN_TEST(test_no_count_is_lost_however_often_it_is_asked);
    RUN_TEST(test_half_a_second_without_asking_is_noticed_in_full);
    RUN_TEST(test_feeding_feeds);
    return UNITY_END();
}
