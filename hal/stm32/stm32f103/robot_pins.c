/* A robot of its own on an STM32F103 (RM0008): TIM1 makes the PWM of both motors and the beat, TIM3 and TIM4 count the encoders,
 * TIM2 the beacon's bursts, and the converter fills samples by DMA, over and over. */
#include "hal/pins_body/pins.h"

#include "hal/port/cortex_m/core.h"
#include "hal/stm32/board.h"
#include "hal/stm32/machine.h"
#include "hal/stm32/stm32f103/gpio.h"
#include "hal/stm32/stm32f103/registers.h"

enum {
    DMA1_ON = 1u << 0,                             /* in ahbenr */
    ADC1_TIM1_ON = 1u << 9 | 1u << 11,             /* in apb2enr */
    TIM2_TO_4_ON = 7u << 0,                        /* in apb1enr */
    ADC_BY_6 = 2u << 14,                           /* in cfgr: at most 14 MHz */
    PWM_HZ = 20000, PWM_PERIODS = 100,             /* in a beat of 5 ms */
    CEN = 1u << 0, UIE = 1u << 0, UIF = 1u << 0, UG = 1u << 0, ARPE = 1u << 7,
    TIM1_UP = 25,                                  /* its interrupt */
    PWM_2 = 0x6800, PWM_3 = 0x0068,                /* in ccmr: mode 1, preloaded */
    CC2N_ON = 1u << 6, CC3N_ON = 1u << 10,         /* in ccer */
    BREAK_LOW = 1u << 12, OUTPUTS_ON = 1u << 15, IDLE_LOW = 1u << 10, BREAK_SEEN = 1u << 7,   /* in bdtr; the last in sr */
    ENCODER = 3, FROM_INPUTS = 0x0101 | 0x3030,    /* both edges of both inputs, which last 8 counts of the clock */
    EXTERNAL_BY_INPUT_1 = 7u | 5u << 4, FROM_INPUT_1 = 0x0031,
    TOP = 0xFFFF,
    ADC_ON = 1u << 0, CONTINUOUS = 1u << 1, CALIBRATE = 1u << 2, RESET_CALIBRATION = 1u << 3, BY_DMA = 1u << 8,
    BY_SOFTWARE = 7u << 17 | 1u << 20, BEGIN = 1u << 22,
    SCAN = 1u << 8, LONGEST_SAMPLE = 7,            /* in cr1; 239.5 cycles of 12 MHz */
    CALIBRATION_WAIT_MAX = 20000,                  /* looks; it takes some 90 cycles of the converter */
    CIRCULAR_HALVES = 1u << 0 | 1u << 5 | 1u << 7 | 1u << 8 | 1u << 10,   /* on, round and round, to memory, 16 bits each */
    SAMPLES = FEEL_COUNT + 1, BATTERY = FEEL_COUNT,
    SUPPLY_MV = 3300, BATTERY_PARTS = 3, SAMPLE_SPAN = 4096
};

static const uint8_t CHANNELS[SAMPLES] = {
    BOARD_PROXIMITY_RIGHT_CHANNEL, BOARD_PROXIMITY_FRONT_RIGHT_CHANNEL, BOARD_PROXIMITY_FRONT_CHANNEL,
    BOARD_PROXIMITY_FRONT_LEFT_CHANNEL, BOARD_PROXIMITY_LEFT_CHANNEL, BOARD_BATTERY_CHANNEL,
};
static volatile uint16_t samples[SAMPLES];   /* the converter's */

static void set_modes(void)
{
    const struct pin analogue[SAMPLES] = {
        BOARD_PROXIMITY_RIGHT, BOARD_PROXIMITY_FRONT_RIGHT, BOARD_PROXIMITY_FRONT, BOARD_PROXIMITY_FRONT_LEFT,
        BOARD_PROXIMITY_LEFT, BOARD_BATTERY,
    };
    const struct pin pulled_up[] = {
        BOARD_LEFT_ENCODER_A, BOARD_LEFT_ENCODER_B, BOARD_RIGHT_ENCODER_A, BOARD_RIGHT_ENCODER_B, BOARD_BEACON,
        BOARD_BRIDGE_FAULT, BOARD_BUMPER_LEFT, BOARD_BUMPER_RIGHT, BOARD_BUTTON,
    };
    const struct pin outputs[] = {BOARD_BRIDGE_AWAKE, BOARD_LEFT_BACK, BOARD_RIGHT_BACK, BOARD_INFRARED};

    for (unsigned i = 0; i < sizeof outputs / sizeof *outputs; i++) {
        gpio_write(outputs[i], false);
        gpio_mode(outputs[i], GPIO_OUTPUT);
    }
    for (unsigned i = 0; i < SAMPLES; i++)
        gpio_mode(analogue[i], GPIO_ANALOGUE);
    for (unsigned i = 0; i < sizeof pulled_up / sizeof *pulled_up; i++)
        gpio_pull_up(pulled_up[i]);
    gpio_mode(BOARD_LEFT_PWM, GPIO_ALTERNATE);
    gpio_mode(BOARD_RIGHT_PWM, GPIO_ALTERNATE);
}

static void start_counter(volatile struct timer_registers *timer, uint32_t inputs, uint32_t mode)
{
    timer->arr = TOP;
    timer->ccmr[0] = inputs;
    timer->smcr = mode;
    timer->cr1 = CEN;
}

/* An update at once takes over what is preloaded. The break input is the bridge's fault, low. */
static void start_motors(void)
{
    TIM1.arr = machine_clocks().core_hz / PWM_HZ - 1;
    TIM1.rcr = PWM_PERIODS - 1;
    TIM1.ccmr[0] = PWM_2;
    TIM1.ccmr[1] = PWM_3;
    TIM1.ccer = CC2N_ON | CC3N_ON;
    TIM1.egr = UG;
    TIM1.sr = 0;
    TIM1.dier = UIE;
    NVIC.iser[0] = 1u << TIM1_UP;
    TIM1.bdtr = BREAK_LOW | IDLE_LOW | OUTPUTS_ON;
    TIM1.cr1 = CEN | ARPE;
}

static void await_clear(uint32_t bit)
{
    ADC1.cr2 = ADC_ON | bit;
    for (unsigned i = 0; i < CALIBRATION_WAIT_MAX && (ADC1.cr2 & bit); i++)
        continue;
}

static void start_converter(void)
{
    uint32_t order = 0;

    for (unsigned i = 0; i < SAMPLES; i++) {
        order |= (uint32_t)CHANNELS[i] << 5 * i;
        ADC1.smpr[1] |= (uint32_t)LONGEST_SAMPLE << 3 * CHANNELS[i];
    }
    DMA1.channel[0].cndtr = SAMPLES;
    DMA1.channel[0].cpar = (uint32_t)(uintptr_t)&ADC1.dr;
    DMA1.channel[0].cmar = (uint32_t)(uintptr_t)samples;
    DMA1.channel[0].ccr = CIRCULAR_HALVES;
    ADC1.sqr[0] = (SAMPLES - 1u) << 20;
    ADC1.sqr[2] = order;
    ADC1.cr1 = SCAN;
    ADC1.cr2 = ADC_ON;
    await_clear(RESET_CALIBRATION);
    await_clear(CALIBRATE);
    ADC1.cr2 = ADC_ON | CONTINUOUS | BY_DMA | BY_SOFTWARE;
    ADC1.cr2 = ADC_ON | CONTINUOUS | BY_DMA | BY_SOFTWARE | BEGIN;
}

void pins_open(void)
{
    RCC.ahbenr |= DMA1_ON;
    RCC.apb2enr |= ADC1_TIM1_ON;
    RCC.apb1enr |= TIM2_TO_4_ON;
    RCC.cfgr |= ADC_BY_6;
    set_modes();
    start_counter(&TIM3, FROM_INPUTS, ENCODER);
    start_counter(&TIM4, FROM_INPUTS, ENCODER);
    start_counter(&TIM2, FROM_INPUT_1, EXTERNAL_BY_INPUT_1);
    start_converter();
    start_motors();
}

/* The watchdog bounds this: without its timer the robot must not go on. */
void pins_wait(void)
{
    while (!(TIM1.sr & UIF))
        core_sleep();
    TIM1.sr = ~(uint32_t)UIF;
    NVIC.icpr[0] = 1u << TIM1_UP;
}

uint16_t pins_count(unsigned side)
{
    return (uint16_t)(side == 0 ? TIM3.cnt : TIM4.cnt);
}

/* Backward, the other half of the bridge is on for as long as this one is off. */
void pins_push(unsigned side, int32_t duty)
{
    uint32_t top = TIM1.arr + 1;
    uint32_t high = (uint32_t)(duty < 0 ? -duty : duty) * top >> 16;

    gpio_write(side == 0 ? BOARD_LEFT_BACK : BOARD_RIGHT_BACK, duty < 0);
    TIM1.ccr[side + 1] = duty < 0 ? top - high : high;
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
