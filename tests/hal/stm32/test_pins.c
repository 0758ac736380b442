/* The pins of chips that have them as in gpio_f4.h. Built once for each chip, on one of its boards, with PINS_EXPECTED: the
 * header that says what is expected of it. */
#include <string.h>

#include "tests/test.h"
#include "hal/port/cortex_m/mcu.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/gpio/gpio.h"
#include "hal/stm32/gpio/gpio_f4.h"
#include PINS_EXPECTED

enum { PORTS = 3, PINS = 16, OUTPUT = 1, ALTERNATE = 2, PULLED_UP = 1 };

volatile struct gpio_port GPIO[PORTS];

static struct gpio_port before[PORTS];

void setUp(void)
{
    memset((void *)&RCC, 0, sizeof RCC);
    memset((void *)GPIO, 0, sizeof GPIO);
    GPIO[0].at.moder = MODES_A;
    GPIO[0].at.pupdr = 0x64000000;
    memcpy(before, (const void *)GPIO, sizeof before);
    begin();
    pins_start();
}

static uint32_t field(uint32_t reg, unsigned pin)
{
    return reg >> 2 * pin & 3u;
}

static void assert_connected(unsigned pin, uint32_t function, bool pulled_up)
{
    const volatile struct gpio_registers *gpio = &GPIO[pin / PINS].at;

    TEST_ASSERT_EQUAL_HEX32(ALTERNATE, field(gpio->moder, pin % PINS));
    TEST_ASSERT_EQUAL_HEX32(pulled_up ? PULLED_UP : 0, field(gpio->pupdr, pin % PINS));
    TEST_ASSERT_EQUAL_HEX32(function, gpio->afr[pin % PINS / 8] >> 4 * (pin % 8) & 15u);
}

static bool is_used(unsigned port, unsigned number)
{
    unsigned pin = port * PINS + number;

    return pin == BOARD_LED || pin == BOARD_CAN_RX || pin == BOARD_CAN_TX || pin == BOARD_UART_RX || pin == BOARD_UART_TX;
}

TEST(ports_are_1_kb_apart)
{
    TEST_ASSERT_EQUAL_HEX(0x400, sizeof(struct gpio_port));
}

TEST(can_and_uart_have_their_pins)
{
    assert_connected(BOARD_CAN_RX, CAN_FUNCTION, true);
    assert_connected(BOARD_CAN_TX, CAN_FUNCTION, false);
    assert_connected(BOARD_UART_RX, UART_FUNCTION, true);
    assert_connected(BOARD_UART_TX, UART_FUNCTION, false);
}

TEST(other_pins_are_unchanged)
{
    for (unsigned port = 0; port < PORTS; port++)
        for (unsigned pin = 0; pin < PINS; pin++) {
            if (is_used(port, pin))
                continue;
            TEST_ASSERT_EQUAL_HEX32(field(before[port].at.moder, pin), field(GPIO[port].at.moder, pin));
            TEST_ASSERT_EQUAL_HEX32(field(before[port].at.pupdr, pin), field(GPIO[port].at.pupdr, pin));
            TEST_ASSERT_EQUAL_HEX32(0, GPIO[port].at.afr[pin / 8] >> 4 * (pin % 8) & 15u);
        }
}

TEST(used_peripherals_are_clocked)
{
    assert_powered();
}

TEST(mcu_light_drives_the_led_pin)
{
    TEST_ASSERT_EQUAL_HEX32(OUTPUT, field(GPIO[BOARD_LED / PINS].at.moder, BOARD_LED % PINS));
    mcu_light(true);
    TEST_ASSERT_EQUAL_HEX32(LIT, GPIO[BOARD_LED / PINS].at.bsrr);
    mcu_light(false);
    TEST_ASSERT_EQUAL_HEX32(DARK, GPIO[BOARD_LED / PINS].at.bsrr);
}
