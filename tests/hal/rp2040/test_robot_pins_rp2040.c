/* A body on the pins of a Pico, on registers that lie in the test's memory; tests/judges/test_pico_pins.py runs the image. */
#include <string.h>

#include "hal/pins_body/pins.h"
#include "hal/port/cortex_m/core.h"
#include "hal/port/cortex_m/uart.h"
#include "hal/rp2040/machine.h"
#include "hal/rp2040/registers.h"
#include "tests/test.h"

enum { TOP = 6250, BEAT = 1 };

volatile struct io_registers IO_BANK0;
volatile struct pads_registers PADS_BANK0;
volatile struct sio_registers SIO;
volatile struct uart_registers UART0;
volatile struct pwm_registers PWM;
volatile struct adc_registers ADC;
volatile struct pio_registers PIO0;
volatile struct interrupt_registers NVIC;

static unsigned slept, pumped;
static bool adc_has_clock;
static uint32_t core_hz = 125000000, released;

struct clocks machine_clocks(void)
{
    return (struct clocks){core_hz, true};
}

bool clock_start_adc(void)
{
    return adc_has_clock;
}

void clock_release(uint32_t blocks)
{
    released |= blocks;
}

void line_pump(void)
{
    pumped++;
}

void core_sleep(void)
{
    slept++;
    PWM.intr = slept >= 2 ? BEAT : 0;   /* woken once by the serial port */
}

void setUp(void)
{
    memset((void *)&PWM, 0, sizeof PWM);
    memset((void *)&PIO0, 0, sizeof PIO0);
    memset((void *)&IO_BANK0, 0, sizeof IO_BANK0);
    memset((void *)&SIO, 0, sizeof SIO);
    slept = pumped = 0;
    released = 0;
    adc_has_clock = true;
    core_hz = 125000000;
    pins_open();
}

TEST(motors_start_with_20_khz_pwm_and_brake)
{
    for (unsigned slice = 1; slice <= 2; slice++) {
        TEST_ASSERT_EQUAL_HEX32(1, PWM.ch[slice].csr);
        TEST_ASSERT_EQUAL_UINT32(TOP - 1, PWM.ch[slice].top);
        TEST_ASSERT_EQUAL_UINT32(1 << 4, PWM.ch[slice].div);
        TEST_ASSERT_EQUAL_HEX32((uint32_t)TOP << 16 | TOP, PWM.ch[slice].cc);
    }
    for (unsigned pin = 2; pin <= 5; pin++)
        TEST_ASSERT_EQUAL_UINT32(4, IO_BANK0.gpio[pin].gpio_ctrl);
}

TEST(beat_is_5_ms_at_any_clock)
{
    const uint32_t clocks_hz[] = {125000000, 12000000, 6500000};

    for (unsigned i = 0; i < 3; i++) {
        core_hz = clocks_hz[i];
        pins_open();
        TEST_ASSERT_EQUAL_UINT32(core_hz / 200, (PWM.ch[0].top + 1) * (PWM.ch[0].div >> 4));
        TEST_ASSERT_LESS_THAN_UINT32(65536, PWM.ch[0].top);
    }
    TEST_ASSERT_EQUAL_HEX32(BEAT, PWM.inte);
    TEST_ASSERT_EQUAL_HEX32(1u << 4 | 1u << 20, NVIC.iser[0]);
    TEST_ASSERT_EQUAL_HEX32(1u << 4, UART0.uartimsc);
}

TEST(beacon_bursts_are_counted_at_their_falling_edge)
{
    TEST_ASSERT_EQUAL_HEX32(1 | 3 << 4, PWM.ch[6].csr);
    TEST_ASSERT_EQUAL_HEX32(0xFFFF, PWM.ch[6].top);
    TEST_ASSERT_EQUAL_UINT32(4, IO_BANK0.gpio[13].gpio_ctrl);
    PWM.ch[6].ctr = 9;
    TEST_ASSERT_EQUAL_UINT16(9, pins_bursts());
}

TEST(contacts_are_pulled_up_and_sensor_pins_are_analog)
{
    TEST_ASSERT_EQUAL_HEX32(0x5A, PADS_BANK0.gpio[14]);
    for (unsigned pin = 26; pin <= 29; pin++) {
        TEST_ASSERT_EQUAL_HEX32(0x80, PADS_BANK0.gpio[pin]);
        TEST_ASSERT_EQUAL_UINT32(31, IO_BANK0.gpio[pin].gpio_ctrl);
    }
    TEST_ASSERT_EQUAL_HEX32(1u << 0 | 1u << 10 | 1u << 14, released);
}

TEST(adc_without_a_clock_stays_in_reset)
{
    released = 0;
    adc_has_clock = false;
    pins_open();
    TEST_ASSERT_EQUAL_HEX32(1u << 10 | 1u << 14, released);
}

TEST(dead_adc_reads_as_no_light_and_empty_battery)
{
    uint16_t light[FEEL_COUNT];

    ADC.result = 4095;
    pins_measure(light);
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        TEST_ASSERT_EQUAL_UINT16(0, light[i]);
    TEST_ASSERT_EQUAL_UINT32(0, pins_battery_mv());
}

/* By the truth table of the DRV8833: 1/0 drives forward, 0/1 backward, 1/1 brakes; nothing is ever 0/0, which coasts. */
TEST(duty_drives_one_input_low_and_brakes_otherwise)
{
    pins_push(0, 16384);
    TEST_ASSERT_EQUAL_UINT32(TOP, PWM.ch[1].cc & 0xFFFF);
    TEST_ASSERT_EQUAL_UINT32(TOP - TOP / 4, PWM.ch[1].cc >> 16);
    pins_push(1, -65536);
    TEST_ASSERT_EQUAL_UINT32(0, PWM.ch[2].cc & 0xFFFF);
    TEST_ASSERT_EQUAL_UINT32(TOP, PWM.ch[2].cc >> 16);
}

TEST(pins_wait_sleeps_until_the_timer_and_serves_the_serial_line)
{
    PWM.intr = 0;
    pins_wait();
    TEST_ASSERT_EQUAL_UINT(2, slept);
    TEST_ASSERT_EQUAL_UINT(2, pumped);
    TEST_ASSERT_EQUAL_HEX32(BEAT, PWM.intr);
    pins_wait();
    TEST_ASSERT_EQUAL_UINT(2, slept);
}

TEST(outputs_are_set_and_cleared)
{
    TEST_ASSERT_EQUAL_UINT32(5, IO_BANK0.gpio[10].gpio_ctrl);
    pins_wake_bridge(true);
    TEST_ASSERT_EQUAL_HEX32(1u << 10, SIO.gpio_out_set);
    pins_wake_bridge(false);
    TEST_ASSERT_EQUAL_HEX32(1u << 10, SIO.gpio_out_clr);
    pins_shine(true);
    TEST_ASSERT_EQUAL_HEX32(1u << 12, SIO.gpio_out_set);
}

TEST(short_bridge_fault_is_latched)
{
    IO_BANK0.intr[1] = 0;
    TEST_ASSERT_FALSE(pins_bridge_failed());
    IO_BANK0.intr[1] = 1u << 12;
    TEST_ASSERT_TRUE(pins_bridge_failed());
    IO_BANK0.intr[1] = 1u << 14;
    TEST_ASSERT_TRUE(pins_bridge_failed());
}

TEST(pressed_contacts_read_low)
{
    SIO.gpio_in = 0xFFFFFFFF;
    TEST_ASSERT_FALSE(pins_bumped());
    TEST_ASSERT_FALSE(pins_button());
    SIO.gpio_in = ~(1u << 14);
    TEST_ASSERT_TRUE(pins_bumped());
    SIO.gpio_in = ~(1u << 15);
    TEST_ASSERT_TRUE(pins_bumped());
    SIO.gpio_in = ~(1u << 16);
    TEST_ASSERT_TRUE(pins_button());
}

TEST(encoder_returns_its_newest_count)
{
    PIO0.rxf[1] = 0x1FFFE;
    TEST_ASSERT_EQUAL_UINT16(0xFFFE, pins_count(1));
    TEST_ASSERT_EQUAL_HEX32(3, PIO0.ctrl);
    TEST_ASSERT_EQUAL_HEX32(6u << 15, PIO0.sm[0].pinctrl);
    TEST_ASSERT_EQUAL_HEX32(8u << 15, PIO0.sm[1].pinctrl);
}

TEST(silent_encoder_keeps_its_last_count)
{
    PIO0.rxf[0] = 7;
    TEST_ASSERT_EQUAL_UINT16(7, pins_count(0));
    PIO0.fstat = 1u << 8;
    PIO0.rxf[0] = 9;
    TEST_ASSERT_EQUAL_UINT16(7, pins_count(0));
}
