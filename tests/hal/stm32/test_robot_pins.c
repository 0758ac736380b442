/* The pins of a robot of its own, on registers that lie in the test's memory. Built once for each chip that has one, on one of its
 * boards, with ROBOT_EXPECTED: the header that says what is expected of it. */
#include <stddef.h>
#include <string.h>

#include "hal/pins_body/pins.h"
#include "hal/port/cortex_m/core.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/registers.h"
#include "tests/test.h"

enum { PORTS = 5, A = 0, B = 1, C = 2 };

#include ROBOT_EXPECTED

enum { TOP = CORE_HZ / 20000 };

volatile struct rcc_registers RCC;
volatile struct gpio_port GPIO[PORTS];
volatile struct timer_registers TIM1, TIM2, TIM3, TIM4;
volatile struct adc_registers ADC1;
volatile struct dma_registers DMA1;
volatile struct interrupt_registers NVIC;

static unsigned slept;

struct clocks machine_clocks(void)
{
    return (struct clocks){.core_hz = CORE_HZ};
}

void core_sleep(void)
{
    slept++;
    TIM1.sr = slept >= 2 ? 1 : 0;   /* woken once by another interrupt */
}

void setUp(void)
{
    memset((void *)&RCC, 0, sizeof RCC);
    memset((void *)&ADC1, 0, sizeof ADC1);
    memset((void *)GPIO, 0, sizeof GPIO);
    pins_after_reset();
    TIM1.sr = 1 << 7;   /* of before */
    slept = 0;
    pins_open();
}

TEST(interrupt_registers_match_the_manual)
{
    TEST_ASSERT_EQUAL_HEX(0x180, offsetof(struct interrupt_registers, icpr));
}

TEST(pins_have_their_modes_and_functions)
{
    assert_pins();
}

/* Power for all that is used; a beat of 5 ms of PWM at 20 kHz, which the bridge can break; encoders and bursts counted by
 * timers; a converter that goes round six channels into memory. */
TEST(pins_open_sets_up_timers_adc_and_dma)
{
    const struct {
        const char *name;
        uint32_t wanted, is;
    } cases[] = {
        {"TIM1 arr", TOP - 1, TIM1.arr},
        {"TIM1 rcr", 20000 / 200 - 1, TIM1.rcr},
        {"TIM1 ccmr1", 0x6060, TIM1.ccmr[0]},   /* a duty takes effect at once */
        {"TIM1 ccmr2", 0x6060, TIM1.ccmr[1]},
        {"TIM1 ccer", 1 | 1 << 6 | 1 << 10 | 1 << 12, TIM1.ccer},
        {"TIM1 egr", 1, TIM1.egr},
        {"TIM1 sr", 0, TIM1.sr},
        {"TIM1 dier", 1, TIM1.dier},
        {"TIM1 cr1", 1 << 7 | 1, TIM1.cr1},
        {"NVIC iser", 1 << 25, NVIC.iser[0]},
        {"TIM2 arr", 0xFFFF, TIM2.arr},
        {"TIM2 ccmr1", 0x0031, TIM2.ccmr[0]},
        {"TIM2 smcr", 7 | 5 << 4, TIM2.smcr},
        {"TIM2 cr1", 1, TIM2.cr1},
        {"TIM3 ccmr1", 0xF1F1, TIM3.ccmr[0]},
        {"TIM3 smcr", 3, TIM3.smcr},
        {"TIM4 ccmr1", 0xF1F1, TIM4.ccmr[0]},
        {"TIM4 smcr", 3, TIM4.smcr},
        {"DMA1 cndtr", 6, DMA1.channel[0].cndtr},
        {"DMA1 ccr", 0x5A1, DMA1.channel[0].ccr},
        {"DMA1 cpar", (uint32_t)(uintptr_t)&ADC1.dr, DMA1.channel[0].cpar},
        CHIP_REGISTERS
    };

    for (unsigned i = 0; i < sizeof cases / sizeof *cases; i++)
        TEST_ASSERT_EQUAL_HEX32_MESSAGE(cases[i].wanted, cases[i].is, cases[i].name);
}

TEST(encoder_and_burst_counts_come_from_timers)
{
    TIM3.cnt = 0xFFFF;
    TIM4.cnt = 5;
    TIM2.cnt = 9;
    TEST_ASSERT_EQUAL_UINT16(0xFFFF, pins_count(0));
    TEST_ASSERT_EQUAL_UINT16(5, pins_count(1));
    TEST_ASSERT_EQUAL_UINT16(9, pins_bursts());
}

TEST(pins_wait_sleeps_until_the_timer_and_clears_its_flag)
{
    pins_wait();
    TEST_ASSERT_EQUAL_UINT(2, slept);
    TEST_ASSERT_EQUAL_HEX32(~1u, TIM1.sr);
    TEST_ASSERT_EQUAL_HEX32(1 << 25, NVIC.icpr[0]);
    TIM1.sr = 1;
    pins_wait();
    TEST_ASSERT_EQUAL_UINT(2, slept);
}

/* By the truth table of the DRV8833: 1/0 drives forward, 0/1 backward, 1/1 brakes; nothing is ever 0/0, which coasts. */
TEST(duty_drives_one_input_low_and_brakes_otherwise)
{
    pins_push(0, 16384);
    TEST_ASSERT_EQUAL_UINT32(TOP, TIM1.ccr[1]);
    TEST_ASSERT_EQUAL_UINT32(TOP - TOP / 4, TIM1.ccr[0]);
    pins_push(1, -16384);
    TEST_ASSERT_EQUAL_UINT32(TOP - TOP / 4, TIM1.ccr[2]);
    TEST_ASSERT_EQUAL_UINT32(TOP, TIM1.ccr[3]);
    pins_push(1, 0);
    TEST_ASSERT_EQUAL_UINT32(TOP, TIM1.ccr[2]);
    TEST_ASSERT_EQUAL_UINT32(TOP, TIM1.ccr[3]);
}

TEST(outputs_are_set_and_cleared)
{
    pins_wake_bridge(true);
    TEST_ASSERT_EQUAL_HEX32(1 << 5, GPIO[B].at.bsrr);
    pins_wake_bridge(false);
    TEST_ASSERT_EQUAL_HEX32(1 << 21, GPIO[B].at.bsrr);
    pins_shine(true);
    TEST_ASSERT_EQUAL_HEX32(1 << 13, GPIO[B].at.bsrr);
}

TEST(pressed_contacts_read_low)
{
    GPIO[A].at.idr = GPIO[B].at.idr = 0xFFFF;
    TEST_ASSERT_FALSE(pins_bumped() || pins_button());
    GPIO[B].at.idr = 0xFFFF & ~(1u << 10);
    TEST_ASSERT_TRUE(pins_bumped());
    GPIO[B].at.idr = 0xFFFF & ~(1u << 11);
    TEST_ASSERT_TRUE(pins_bumped());
    GPIO[B].at.idr = 0xFFFF & ~(1u << 0);
    TEST_ASSERT_TRUE(pins_button());
}

TEST(timer_break_reports_a_bridge_fault)
{
    TEST_ASSERT_FALSE(pins_bridge_failed());
    TIM1.sr = 1;   /* a beat */
    TEST_ASSERT_FALSE(pins_bridge_failed());
    TIM1.sr = 1 << 7;
    TEST_ASSERT_TRUE(pins_bridge_failed());
}

/* DMA has the low 32 bits of the samples' address; the upper half is that of a neighbouring variable. */
TEST(adc_samples_are_light_and_battery)
{
    uint32_t apart = DMA1.channel[0].cmar - (uint32_t)(uintptr_t)&RCC;
    volatile uint16_t *samples = (volatile uint16_t *)((intptr_t)&RCC + (int32_t)apart);
    uint16_t light[FEEL_COUNT] = {1, 1, 1, 1, 1};

    pins_measure(light);
    TEST_ASSERT_EACH_EQUAL_UINT16(0, light, FEEL_COUNT);   /* before the first sample */
    for (uint16_t i = 0; i < FEEL_COUNT; i++)
        samples[i] = i;
    samples[FEEL_COUNT] = 2979;
    pins_measure(light);
    for (uint16_t i = 0; i < FEEL_COUNT; i++)
        TEST_ASSERT_EQUAL_UINT16(i, light[i]);
    TEST_ASSERT_EQUAL_UINT32(7200, pins_battery_mv());
}
