/* The pins of an STM32F103, which has them in its own way (RM0008 9), on a Blue Pill. */
#include <string.h>

#include "tests/test.h"
#include "hal/port/cortex_m/mcu.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/stm32f103/registers.h"

enum { PORTS = 5, FLOATING = 4, PULLED = 8, OUTPUT_2_MHZ = 2, ALTERNATE_50_MHZ = 11 };

static const uint32_t ALL_FLOATING = 0x44444444;   /* as after a reset */

volatile struct rcc_registers RCC;
volatile struct power_registers PWR;
volatile struct gpio_port GPIO[PORTS];
volatile struct afio_registers AFIO;

void setUp(void)
{
    memset((void *)&RCC, 0, sizeof RCC);
    memset((void *)GPIO, 0, sizeof GPIO);
    AFIO.mapr = 0;
    for (unsigned port = 0; port < PORTS; port++)
        GPIO[port].at.cr[0] = GPIO[port].at.cr[1] = ALL_FLOATING;
    pins_start();
}

static uint32_t mode(unsigned port, unsigned pin)
{
    return GPIO[port].at.cr[pin / 8] >> 4 * (pin % 8) & 15u;
}

TEST(ports_are_1_kb_apart)
{
    TEST_ASSERT_EQUAL_HEX(0x400, sizeof(struct gpio_port));
}

TEST(can_and_uart_have_their_pins)
{
    TEST_ASSERT_EQUAL_HEX32(PULLED, mode(1, 8));
    TEST_ASSERT_EQUAL_HEX32(ALTERNATE_50_MHZ, mode(1, 9));
    TEST_ASSERT_EQUAL_HEX32(PULLED, mode(0, 10));
    TEST_ASSERT_EQUAL_HEX32(ALTERNATE_50_MHZ, mode(0, 9));
    TEST_ASSERT_EQUAL_HEX32(2 << 13, AFIO.mapr & 3 << 13);
}

TEST(remap_routes_the_beacon_timer_and_disables_jtag)
{
    TEST_ASSERT_EQUAL_HEX32(1 << 8, AFIO.mapr & 3 << 8);
    TEST_ASSERT_EQUAL_HEX32(2 << 24, AFIO.mapr & 7 << 24);
}

TEST(open_receive_pins_are_pulled_up)
{
    TEST_ASSERT_EQUAL_HEX32(1 << 8, GPIO[1].at.bsrr);
    TEST_ASSERT_EQUAL_HEX32(1 << 10, GPIO[0].at.bsrr);
}

TEST(other_pins_are_unchanged)
{
    unsigned floating = 0;

    for (unsigned port = 0; port < PORTS; port++)
        for (unsigned pin = 0; pin < 16; pin++)
            floating += mode(port, pin) == FLOATING;
    TEST_ASSERT_EQUAL_UINT(PORTS * 16 - 5, floating);
}

TEST(used_peripherals_are_clocked)
{
    TEST_ASSERT_EQUAL_HEX32(1 << 0 | 7 << 2 | 1 << 14, RCC.apb2enr);
    TEST_ASSERT_EQUAL_HEX32(1 << 25 | 1 << 28, RCC.apb1enr);
    TEST_ASSERT_EQUAL_HEX32(7 << 5 | 1 << 4, PWR.cr);
}

TEST(led_is_lit_by_a_low_pin)
{
    TEST_ASSERT_EQUAL_HEX32(OUTPUT_2_MHZ, mode(2, 13));
    mcu_light(true);
    TEST_ASSERT_EQUAL_HEX32(1 << 29, GPIO[2].at.bsrr);
    mcu_light(false);
    TEST_ASSERT_EQUAL_HEX32(1 << 13, GPIO[2].at.bsrr);
}
