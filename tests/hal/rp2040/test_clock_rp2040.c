#include "hal/rp2040/machine.h"

#include <string.h>

#include "tests/test.h"
#include "hal/rp2040/registers.h"

#define READY (1u << 31)

volatile struct clocks_registers CLOCKS;
volatile struct resets_registers RESETS;
volatile struct xosc_registers XOSC;
volatile struct pll_registers PLL_SYS, PLL_USB;

/* Everything is ready at the first poll. */
void setUp(void)
{
    memset((void *)&CLOCKS, 0, sizeof CLOCKS);
    CLOCKS.clk_ref.selected = 1u << 2;
    CLOCKS.clk_sys.selected = 1u << 0 | 1u << 1;
    RESETS = (struct resets_registers){.reset = 0x01FFFFFF, .reset_done = 0x01FFFFFF};
    XOSC = (struct xosc_registers){.status = READY};
    PLL_SYS = (struct pll_registers){.cs = 1u | READY, .pwr = 0x2D};
    PLL_USB = (struct pll_registers){.cs = 1u | READY, .pwr = 0x2D};
}

TEST(core_runs_at_125_mhz_from_the_crystal)
{
    struct clocks clocks = clock_start();

    TEST_ASSERT_EQUAL_UINT32(125000000, clocks.core_hz);
    TEST_ASSERT_TRUE(clocks.exact);
    TEST_ASSERT_EQUAL_HEX32(0x00FABAA0, XOSC.ctrl);
    TEST_ASSERT_EQUAL_UINT32(2, CLOCKS.clk_ref.ctrl);
    TEST_ASSERT_EQUAL_UINT32(1, CLOCKS.clk_sys.ctrl);
    TEST_ASSERT_EQUAL_HEX32(1u << 11, CLOCKS.clk_peri.ctrl);
}

TEST(pll_makes_125_mhz_from_12_mhz)
{
    uint32_t prim;

    (void)clock_start();
    prim = PLL_SYS.prim;
    TEST_ASSERT_EQUAL_UINT32(125, 12 * PLL_SYS.fbdiv_int / ((prim >> 16 & 7) * (prim >> 12 & 7)));
    TEST_ASSERT_EQUAL_HEX32(0x04, PLL_SYS.pwr);   /* of all parts, only the modulator is off */
    TEST_ASSERT_EQUAL_HEX32(0, RESETS.reset & 1u << 12);
}

TEST(core_runs_from_the_crystal_without_a_pll)
{
    CLOCKS.clk_sys.selected = 1u << 0;
    TEST_ASSERT_EQUAL_UINT32(12000000, clock_start().core_hz);
    TEST_ASSERT_TRUE(clock_start().exact);
}

TEST(core_runs_from_the_ring_oscillator_without_a_crystal)
{
    struct clocks clocks;

    XOSC.status = 0;
    clocks = clock_start();
    TEST_ASSERT_EQUAL_UINT32(6500000, clocks.core_hz);
    TEST_ASSERT_FALSE(clocks.exact);
    TEST_ASSERT_EQUAL_UINT32(0, CLOCKS.clk_ref.ctrl);
}

TEST(failed_reference_switch_makes_the_clock_inexact)
{
    CLOCKS.clk_ref.selected = 1;
    TEST_ASSERT_FALSE(clock_start().exact);
}

TEST(pll_without_lock_is_not_used)
{
    /* Its register reads as written: not locked. */
    PLL_SYS.cs = 1;
    TEST_ASSERT_EQUAL_UINT32(12000000, clock_start().core_hz);
    TEST_ASSERT_EQUAL_UINT32(0, CLOCKS.clk_sys.ctrl);
}

TEST(block_stuck_in_reset_does_not_block_the_start)
{
    RESETS.reset_done = 0;
    clock_release(1u << 22);
    TEST_ASSERT_EQUAL_HEX32(0x01FFFFFF & ~(1u << 22), RESETS.reset);
}

TEST(adc_gets_48_mhz_from_the_usb_pll)
{
    uint32_t prim;

    TEST_ASSERT_TRUE(clock_start_adc());
    prim = PLL_USB.prim;
    TEST_ASSERT_EQUAL_UINT32(48, 12 * PLL_USB.fbdiv_int / ((prim >> 16 & 7) * (prim >> 12 & 7)));
    TEST_ASSERT_EQUAL_HEX32(1u << 11, CLOCKS.clk_adc.ctrl);
    TEST_ASSERT_EQUAL_HEX32(0, RESETS.reset & 1u << 13);
}

TEST(adc_has_no_clock_without_the_usb_pll)
{
    PLL_USB.cs = 1;
    TEST_ASSERT_FALSE(clock_start_adc());
    TEST_ASSERT_EQUAL_HEX32(0, CLOCKS.clk_adc.ctrl);
}
