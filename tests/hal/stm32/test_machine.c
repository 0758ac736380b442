#include "hal/port/cortex_m/mcu.h"
#include "hal/stm32/chip.h"

#include <string.h>

#include "tests/test.h"
#include "hal/stm32/registers.h"

enum { PIN = 1 << 26, POWER_ON = 1 << 27, SOFTWARE = 1 << 28, INDEPENDENT = 1 << 29, WINDOW = 1 << 30 };

volatile struct watchdog_registers IWDG;

static bool pins_started, exact;
static uint32_t reset_flags;

uint32_t chip_reset_flags(void)
{
    return reset_flags;
}

struct clocks clock_start(void)
{
    TEST_ASSERT_EQUAL_HEX32(0xAAAA, IWDG.kr);   /* the watchdog watches the clocks start */
    return (struct clocks){168000000, 42000000, 84000000, exact};
}

void pins_start(void)
{
    pins_started = true;
}

void setUp(void)
{
    memset((void *)&IWDG, 0, sizeof IWDG);
    pins_started = false;
    exact = true;
    (void)mcu_start();
}

TEST(watchdog_resets_after_2_seconds)
{
    TEST_ASSERT_EQUAL_UINT32(3, IWDG.pr);   /* by 32 */
    TEST_ASSERT_EQUAL_UINT32(2000, IWDG.rlr);
}

TEST(busy_watchdog_does_not_block_the_start)
{
    IWDG.sr = 3;
    (void)mcu_start();
    TEST_ASSERT_TRUE(pins_started);
}

TEST(machine_reports_the_started_clocks)
{
    TEST_ASSERT_EQUAL_UINT32(168000000, mcu_start());
    TEST_ASSERT_EQUAL_UINT32(42000000, machine_clocks().can_hz);
    TEST_ASSERT_TRUE(mcu_clock_is_exact());
    exact = false;
    (void)mcu_start();
    TEST_ASSERT_FALSE(mcu_clock_is_exact());
}

TEST(reset_flags_map_to_reset_causes)
{
    static const struct {
        uint32_t flags;
        enum reset_cause cause;
    } known[] = {
        {PIN, RESET_PIN},           {INDEPENDENT | PIN, RESET_WATCHDOG}, {WINDOW | PIN, RESET_WATCHDOG},
        {SOFTWARE | PIN, RESET_SOFTWARE}, {POWER_ON | PIN, RESET_POWER_ON},    {0, RESET_POWER_ON},
    };

    for (unsigned i = 0; i < sizeof known / sizeof known[0]; i++) {
        reset_flags = known[i].flags;
        TEST_ASSERT_EQUAL(known[i].cause, mcu_reset_cause());
    }
}

/* The other bits of this register are not about resets: the low-speed oscillator is on while the watchdog runs. */
TEST(other_reset_register_bits_are_ignored)
{
    for (unsigned other = 0; other < 26; other++) {
        reset_flags = PIN | 1u << other;
        TEST_ASSERT_EQUAL(RESET_PIN, mcu_reset_cause());
        reset_flags = 1u << other;
        TEST_ASSERT_EQUAL(RESET_POWER_ON, mcu_reset_cause());
    }
}

TEST(systick_counts_an_eighth_of_the_core_clock)
{
    TEST_ASSERT_EQUAL_UINT32(8, mcu_systick_divisor());
}

TEST(mcu_feed_reloads_the_watchdog)
{
    IWDG.kr = 0;
    mcu_feed();
    TEST_ASSERT_EQUAL_HEX32(0xAAAA, IWDG.kr);
}
