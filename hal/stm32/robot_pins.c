/* A body on the pins of an STM32F1 or G4 (RM0008, RM0440): TIM1 generates the PWM of both motors and the beat, TIM3
 * and TIM4 count the encoders, TIM2 the beacon's bursts, and the ADC fills samples continuously by DMA. */
#include "hal/pins_body/pins.h"

#include "hal/port/cortex_m/core.h"
#include "hal/stm32/gpio/gpio.h"
#include "hal/stm32/chip.h"
#include "hal/stm32/registers.h"

enum { LEFT_BACK, LEFT_PWM, RIGHT_PWM, RIGHT_BACK };   /* channels of TIM1, from 0 */

enum {
    PWM_HZ = 20000, PWM_PERIODS = 100,             /* per beat of 5 ms */
    CEN = 1u << 0, UIE = 1u << 0, UIF = 1u << 0, UG = 1u << 0, ARPE = 1u << 7,
    TIM1_UP = 25,                                  /* number of its interrupt */
    PWM_BOTH = 0x6060,                             /* in ccmr: mode 1; not preloaded: a duty takes effect at once */
    CC1_ON = 1u << 0, CC2N_ON = 1u << 6, CC3N_ON = 1u << 10, CC4_ON = 1u << 12,   /* in ccer */
    BREAK_LOW = 1u << 12, OUTPUTS_ON = 1u << 15, IDLE_LOW = 1u << 10,   /* in bdtr */
    BREAK_SEEN = 1u << 7,                          /* in sr */
    ENCODER = 3, FROM_INPUTS = 0x0101 | 0xF0F0,    /* both edges of both; pulses under 256 clocks are noise */
    EXTERNAL_BY_INPUT_1 = 7u | 5u << 4, FROM_INPUT_1 = 0x0031,
    TOP = 0xFFFF,
    CIRCULAR_HALVES = 1u << 0 | 1u << 5 | 1u << 7 | 1u << 8 | 1u << 10,   /* on, circular, to memory, 16 bits each */
    BATTERY = FEEL_COUNT,
    SUPPLY_MV = 3300, BATTERY_PARTS = 3, SAMPLE_SPAN = 4096
};

const uint8_t PINS_SENSORS = (1u << FEEL_COUNT) - 1;

static const uint8_t CHANNELS[CONVERTER_SAMPLES] = {
    BOARD_PROXIMITY_RIGHT_CHANNEL, BOARD_PROXIMITY_FRONT_RIGHT_CHANNEL, BOARD_PROXIMITY_FRONT_CHANNEL,
    BOARD_PROXIMITY_FRONT_LEFT_CHANNEL, BOARD_PROXIMITY_LEFT_CHANNEL, BOARD_BATTERY_CHANNEL,
};
static volatile uint16_t samples[CONVERTER_SAMPLES];   /* written by the ADC's DMA */

static const struct {
    uint8_t pin, mode, function;
} PINS[] = {
    {BOARD_BRIDGE_AWAKE, GPIO_OUTPUT, 0},
    {BOARD_INFRARED, GPIO_OUTPUT, 0},
    {BOARD_PROXIMITY_RIGHT, GPIO_ANALOGUE, 0},
    {BOARD_PROXIMITY_FRONT_RIGHT, GPIO_ANALOGUE, 0},
    {BOARD_PROXIMITY_FRONT, GPIO_ANALOGUE, 0},
    {BOARD_PROXIMITY_FRONT_LEFT, GPIO_ANALOGUE, 0},
    {BOARD_PROXIMITY_LEFT, GPIO_ANALOGUE, 0},
    {BOARD_BATTERY, GPIO_ANALOGUE, 0},
    {BOARD_BUMPER_LEFT, GPIO_PULLED_UP, 0},
    {BOARD_BUMPER_RIGHT, GPIO_PULLED_UP, 0},
    {BOARD_BUTTON, GPIO_PULLED_UP, 0},
    {BOARD_LEFT_ENCODER_A, GPIO_FROM, BOARD_LEFT_ENCODER_A_FUNCTION},
    {BOARD_LEFT_ENCODER_B, GPIO_FROM, BOARD_LEFT_ENCODER_B_FUNCTION},
    {BOARD_RIGHT_ENCODER_A, GPIO_FROM, BOARD_RIGHT_ENCODER_A_FUNCTION},
    {BOARD_RIGHT_ENCODER_B, GPIO_FROM, BOARD_RIGHT_ENCODER_B_FUNCTION},
    {BOARD_BEACON, GPIO_FROM, BOARD_BEACON_FUNCTION},
    {BOARD_BRIDGE_FAULT, GPIO_FROM, BOARD_BRIDGE_FAULT_FUNCTION},
    {BOARD_LEFT_PWM, GPIO_TO, BOARD_LEFT_PWM_FUNCTION},
    {BOARD_RIGHT_PWM, GPIO_TO, BOARD_RIGHT_PWM_FUNCTION},
    {BOARD_LEFT_BACK, GPIO_TO, BOARD_LEFT_BACK_FUNCTION},
    {BOARD_RIGHT_BACK, GPIO_TO, BOARD_RIGHT_BACK_FUNCTION},
};

static void start_counter(volatile struct timer_registers *timer, uint32_t inputs, uint32_t mode)
{
    timer->arr = TOP;
    timer->ccmr[0] = inputs;
    timer->smcr = mode;
    timer->cr1 = CEN;
}

/* An update event loads the preloaded period at once. The break input is the bridge's fault signal, active low;
 * what the chip can filter of it ends no run. */
static void start_motors(void)
{
    TIM1.arr = machine_clocks().core_hz / PWM_HZ - 1;
    TIM1.rcr = PWM_PERIODS - 1;
    TIM1.ccmr[0] = PWM_BOTH;
    TIM1.ccmr[1] = PWM_BOTH;
    TIM1.ccer = CC1_ON | CC2N_ON | CC3N_ON | CC4_ON;
    TIM1.egr = UG;
    TIM1.sr = 0;
    TIM1.dier = UIE;
    NVIC.iser[0] = 1u << TIM1_UP;
    TIM1.bdtr = BREAK_LOW | BREAK_FILTER | IDLE_LOW | OUTPUTS_ON;
    TIM1.cr1 = CEN | ARPE;
}

static void start_converter(const volatile uint32_t *data)
{
    DMA1.channel[0].cndtr = CONVERTER_SAMPLES;
    DMA1.channel[0].cpar = (uint32_t)(uintptr_t)data;
    DMA1.channel[0].cmar = (uint32_t)(uintptr_t)samples;
    DMA1.channel[0].ccr = CIRCULAR_HALVES;
    converter_start(CHANNELS);
}

void pins_open(void)
{
    const volatile uint32_t *data = converter_power();

    for (unsigned i = 0; i < sizeof PINS / sizeof *PINS; i++) {
        if (PINS[i].mode == GPIO_OUTPUT)
            gpio_write(PINS[i].pin, false);
        gpio_set(PINS[i].pin, (enum gpio_mode)PINS[i].mode, PINS[i].function);
    }
    start_counter(&TIM3, FROM_INPUTS, ENCODER);
    start_counter(&TIM4, FROM_INPUTS, ENCODER);
    start_counter(&TIM2, FROM_INPUT_1, EXTERNAL_BY_INPUT_1);
    start_converter(data);
    start_motors();
}

/* Bounded by the watchdog: without its timer the robot must not continue. */
void pins_wait(void)
{
    while (!(TIM1.sr & UIF))
        core_sleep();
    TIM1.sr = ~(uint32_t)UIF;
    (void)TIM1.sr;   /* its line is low now: else the bit below would be set again, and end the next sleep */
    NVIC.icpr[0] = 1u << TIM1_UP;
}

uint16_t pins_count(unsigned side)
{
    return (uint16_t)(side == 0 ? TIM3.cnt : TIM4.cnt);
}

/* Slow decay: both half-bridges are on, which brakes, but for the duty, in which one of them is off. So the motor's
 * current never ends, and its speed is proportional to the duty. */
void pins_push(unsigned side, int32_t duty)
{
    uint32_t top = TIM1.arr + 1;
    uint32_t off = (uint32_t)(duty < 0 ? -duty : duty) * top >> 16;

    TIM1.ccr[side == 0 ? LEFT_BACK : RIGHT_BACK] = duty < 0 ? top : top - off;
    TIM1.ccr[side == 0 ? LEFT_PWM : RIGHT_PWM] = duty < 0 ? top - off : top;
}

void pins_wake_bridge(bool awake)
{
    gpio_write(BOARD_BRIDGE_AWAKE, awake);
}

bool pins_bridge_failed(void)
{
    return TIM1.sr & BREAK_SEEN;
}

void pins_shine(bool on)
{
    gpio_write(BOARD_INFRARED, on);
}

void pins_measure(uint16_t light[FEEL_COUNT])
{
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        light[i] = samples[i];
}

uint32_t pins_battery_mv(void)
{
    return (uint32_t)samples[BATTERY] * SUPPLY_MV * BATTERY_PARTS / SAMPLE_SPAN;
}

uint16_t pins_bursts(void)
{
    return (uint16_t)TIM2.cnt;
}

bool pins_bumped(void)
{
    return !gpio_read(BOARD_BUMPER_LEFT) || !gpio_read(BOARD_BUMPER_RIGHT);
}

bool pins_button(void)
{
    return !gpio_read(BOARD_BUTTON);
}
