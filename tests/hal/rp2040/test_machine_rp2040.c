#include "hal/rp2040/machine.h"

#include <string.h>

#include "tests/test.h"
#include "hal/port/cortex_m/mcu.h"
#include "hal/rp2040/registers.h"

enum { LED = 25, TIMER = 1, FORCED = 2 };

volatile struct psm_registers PSM;
volatile struct chip_reset_registers CHIP_RESET;
volatile struct io_registers IO_BANK0;
volatile struct pads_registers PADS_BANK0;
volatile struct sio_registers SIO;
volatile struct watchdog_registers WATCHDOG;

static uint32_t released;
static bool exact;

struct clocks clock_start(void)
{
    TEST_ASSERT_EQUAL_HEX32(1u << 30, WATCHDOG.ctrl);   /* it watches the clocks start */
    return (struct clocks){125000000, exact};
}

void clock_release(uint32_t blocks)
{
    released |= blocks;
}

void setUp(void)
{
    memset((void *)&PSM, 0, sizeof PSM);
    memset((void *)&WATCHDOG, 0, sizeof WATCHDOG);
    memset((void *)&IO_BANK0, 0, sizeof IO_BANK0);
    memset((void *)&SIO, 0, sizeof SIO);
    CHIP_RESET.chip_reset = 1u << 8;
    released = 0;
    exact = true;
    (void)mcu_start();
}

TEST(watchdog_resets_after_2_seconds)
{
    TEST_ASSERT_EQUAL_UINT32(12, WATCHDOG.tick & 0x1FF);      /* a microsecond of the crystal, */
    TEST_ASSERT_TRUE(WATCHDOG.tick & 1u << 9);
    TEST_ASSERT_EQUAL_UINT32(4000000, WATCHDOG.load);         /* which counts twice: RP2040-E1 */
    TEST_ASSERT_EQUAL_HEX32(0x1FFFC, PSM.wdsel);              /* all but the oscillators */
}

TEST(mcu_feed_reloads_the_watchdog)
{
    WATCHDOG.load = 0;
    mcu_feed();
    TEST_ASSERT_EQUAL_UINT32(4000000, WATCHDOG.load);
}

TEST(machine_reports_the_started_clocks)
{
    TEST_ASSERT_EQUAL_UINT32(125000000, mcu_start());
    TEST_ASSERT_EQUAL_UINT32(125000000, machine_clocks().core_hz);
    TEST_ASSERT_TRUE(mcu_clock_is_exact());
    TEST_ASSERT_EQUAL_UINT32(1, mcu_systick_divisor());
    exact = false;
    (void)mcu_start();
    TEST_ASSERT_FALSE(mcu_clock_is_exact());
}

TEST(gpio_and_uart_are_released_from_reset)
{
    TEST_ASSERT_EQUAL_HEX32(1u << 5 | 1u << 8 | 1u << 22, released);
}

TEST(gpio_pins_have_their_functions)
{
    TEST_ASSERT_EQUAL_UINT32(2, IO_BANK0.gpio[0].gpio_ctrl);
    TEST_ASSERT_EQUAL_UINT32(2, IO_BANK0.gpio[1].gpio_ctrl);
    TEST_ASSERT_EQUAL_UINT32(5, IO_BANK0.gpio[LED].gpio_ctrl);
    TEST_ASSERT_EQUAL_HEX32(1u << LED, SIO.gpio_oe_set);
    TEST_ASSERT_EQUAL_HEX32(0x5A, PADS_BANK0.gpio[1]);   /* an input, pulled up: an open line is idle */
}

TEST(mcu_light_switches_the_led)
{
    mcu_light(true);
    TEST_ASSERT_EQUAL_HEX32(1u << LED, SIO.gpio_out_set);
    TEST_ASSERT_EQUAL_HEX32(0, SIO.gpio_out_clr);
    mcu_light(false);
    TEST_ASSERT_EQUAL_HEX32(1u << LED, SIO.gpio_out_clr);
}

TEST(mcu_reports_the_reset_cause)
{
    TEST_ASSERT_EQUAL(RESET_POWER_ON, mcu_reset_cause());
    CHIP_RESET.chip_reset = 1u << 16;
    TEST_ASSERT_EQUAL(RESET_PIN, mcu_reset_cause());
    WATCHDOG.reason = TIMER;
    TEST_ASSERT_EQUAL(RESET_WATCHDOG, mcu_reset_cause());
    WATCHDOG.reason = FORCED;
    TEST_ASSERT_EQUAL(RESET_SOFTWARE, mcu_reset_cause());
}
