#include <stddef.h>
#include <string.h>

#include <unity.h>

#include "hal/port/cortex_m/mcu.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/gpio_f4.h"
#include "hal/stm32/stm32g431/registers.h"

enum { PORTS = 3, OUTPUT = 1, ALTERNATE = 2, ANALOG = 3, FDCAN1 = 9, USART2 = 7 };

volatile struct rcc_registers RCC;
volatile struct gpio_port GPIO[PORTS];

void setUp(void)
{
    memset((void *)&RCC, 0, sizeof RCC);
    memset((void *)GPIO, 0, sizeof GPIO);
    GPIO[0].at.moder = 0xABFFFFFF;   /* as after a reset: analog, but for the debugger's */
    GPIO[0].at.pupdr = 0x64000000;
    pins_start();
}

void tearDown(void) {}

static uint32_t field(uint32_t reg, unsigned pin)
{
    return reg >> 2 * pin & 3u;
}

static void assert_connected(unsigned pin, uint32_t function)
{
    TEST_ASSERT_EQUAL_HEX32(ALTERNATE, field(GPIO[0].at.moder, pin));
    TEST_ASSERT_EQUAL_HEX32(1, field(GPIO[0].at.pupdr, pin));
    TEST_ASSERT_EQUAL_HEX32(function, GPIO[0].at.afr[pin / 8] >> 4 * (pin % 8) & 15u);
}

static void test_the_registers_lie_where_the_manual_has_them(void)
{
    TEST_ASSERT_EQUAL_HEX(0x18, offsetof(struct gpio_registers, bsrr));
    TEST_ASSERT_EQUAL_HEX(0x20, offsetof(struct gpio_registers, afr));
    TEST_ASSERT_EQUAL_HEX(0x400, sizeof(struct gpio_port));
}

static void test_can_and_the_serial_port_have_their_pins(void)
{
    assert_connected(11, FDCAN1);
    assert_connected(12, FDCAN1);
    assert_connected(2, USART2);
    assert_connected(3, USART2);
}

static void test_no_other_pin_is_touched(void)
{
    TEST_ASSERT_EQUAL_HEX32(ALTERNATE, field(GPIO[0].at.moder, 13));   /* the debugger's */
    TEST_ASSERT_EQUAL_HEX32(ANALOG, field(GPIO[0].at.moder, 4));
    TEST_ASSERT_EQUAL_HEX32(ANALOG, field(GPIO[0].at.moder, 6));
    TEST_ASSERT_EQUAL_HEX32(0, GPIO[1].at.moder | GPIO[2].at.moder);
}

static void test_what_is_used_has_power_and_can_runs_from_the_bus_clock(void)
{
    TEST_ASSERT_EQUAL_HEX32(7, RCC.ahb2enr);
    TEST_ASSERT_EQUAL_HEX32(1 << 25 | 1 << 17, RCC.apb1enr1);
    TEST_ASSERT_EQUAL_HEX32(2u << 24, RCC.ccipr);   /* and nothing else does not */
}

static void test_the_led_is_lit_by_a_high_pin(void)
{
    TEST_ASSERT_EQUAL_HEX32(OUTPUT, field(GPIO[0].at.moder, 5));
    mcu_light(true);
    TEST_ASSERT_EQUAL_HEX32(1 << 5, GPIO[0].at.bsrr);
    mcu_light(false);
    TEST_ASSERT_EQUAL_HEX32(1 << 21, GPIO[0].at.bsrr);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_the_registers_lie_where_the_manual_has_them);
    RUN_TEST(test_can_and_the_serial_port_have_their_pins);
    RUN_TEST(test_no_other_pin_is_touched);
    RUN_TEST(test_what_is_used_has_power_and_can_runs_from_the_bus_clock);
    RUN_TEST(test_the_led_is_lit_by_a_high_pin);
    return UNITY_END();
}
