/* A body on the pins of an RP2040: slices of the PWM drive both motors, count the beacon's bursts and generate the
 * beat, PIO counts the encoders, and the ADC measures when it is asked. */
#include "hal/pins_body/pins.h"

#include "hal/port/cortex_m/core.h"
#include "hal/port/cortex_m/uart.h"
#include "hal/rp2040/machine.h"
#include "hal/rp2040/registers.h"

enum { BEAT, LEFT, RIGHT, BURSTS = 6 };           /* slices: pins.toml has their pins */

enum {
    RESET_ADC = 1 << 0, RESET_PWM = 1 << 14,
    PWM_HZ = 20000, BEAT_HZ = 200, COUNTER_SPAN = 65536,
    ON = 1 << 0, BY_FALLING_B = 3 << 4,           /* in csr */
    PWM_WRAP = 4, UART0_ANY = 20,                 /* numbers of interrupts */
    RECEIVES = 1 << 4,                            /* in uartimsc: its FIFO is half full */
    ADC_ON = 1 << 0, ADC_ONCE = 1 << 2, ADC_READY = 1 << 8, ADC_ERROR = 1 << 9, ADC_CHANNEL_AT = 12,
    ADC_WAIT_MAX = 1000,                          /* polls; a conversion takes 2 us */
    LOW = 1 << 0, FELL = 1 << 2,                  /* of a pin's four bits in intr */
    /* The supply is measured at a third. 4.8 V of it are the motors' nominal voltage, WHEEL_NOMINAL_MV. */
    SUPPLY_MV = 3300, SAMPLE_SPAN = 4096, BATTERY_HALVES = 9
};

const uint8_t PINS_SENSORS = 7u << 1;   /* none at the sides: the ADC has three inputs for them */

static const uint8_t PULLED_UP[] = {
    BOARD_LEFT_ENCODER_A, BOARD_LEFT_ENCODER_B, BOARD_RIGHT_ENCODER_A, BOARD_RIGHT_ENCODER_B,
    BOARD_BRIDGE_FAULT, BOARD_BUMPER_LEFT, BOARD_BUMPER_RIGHT, BOARD_BUTTON,
};

/* A quadrature decoder for PIO (data sheet 3.4), whatever the core does meanwhile: each state machine samples its two
 * pins, jumps by their last and their present state into a table, and pushes the count, which the FIFO drops while it
 * is full. */
enum {
    DOWN = 16, SAME = DOWN + 1, UP = SAME + 6,   /* addresses; to jump is the address alone */
    JUMP_Y_DOWN = 0x0080,           /* Y counts down after the test, whether it jumps or not */
    FIFO = 4,
    ENABLE = 1 << 0,
    WRAP_BOTTOM = SAME << 7, WRAP_TOP = (UP + 2) << 12,
    OUT_RIGHT = 1 << 19,            /* OUT takes the low bits; IN adds low bits, too */
    IN_BASE_AT = 15,
    SLOWER = 16,                    /* a look at the pins every 1.2 us: what is shorter is noise */
    EMPTY_AT = 8,                   /* in fstat */
    RESET_PIO0 = 1 << 10,
    ENCODER_WAIT_MAX = 1000         /* polls; a count comes every 150 cycles */
};

static const uint16_t PROGRAM[] = {
    SAME, UP, DOWN, SAME,           /* by the last state of B and A, and the present one: */
    DOWN, SAME, SAME, UP,           /* 00, 01, 11, 10 is forward */
    UP, SAME, SAME, DOWN,
    SAME, DOWN, UP, SAME,
    JUMP_Y_DOWN | SAME,             /* DOWN */
    0xA0C2,                         /* SAME: mov isr, y */
    0x8000,                         /* push noblock */
    0x60C2,                         /* out isr, 2: the last state, */
    0x4002,                         /* in pins, 2: and the present one */
    0xA0E6,                         /* mov osr, isr */
    0xA0A6,                         /* mov pc, isr */
    0xA04A,                         /* UP: mov y, ~y */
    JUMP_Y_DOWN | (UP + 2),
    0xA04A,                         /* mov y, ~y */
};

static uint16_t last[PINS_SIDES];   /* counts: the program's only answer */

/* Each counts up from about 0 while the channel at its pin leads the one at the next pin. */
static void encoders_start(const uint8_t pins[PINS_SIDES])
{
    clock_release(RESET_PIO0);
    for (unsigned i = 0; i < sizeof PROGRAM / sizeof *PROGRAM; i++)
        PIO0.instr_mem[i] = PROGRAM[i];
    for (unsigned side = 0; side < PINS_SIDES; side++) {
        PIO0.sm[side].clkdiv = (uint32_t)SLOWER << 16;
        PIO0.sm[side].execctrl = WRAP_TOP | WRAP_BOTTOM;
        PIO0.sm[side].shiftctrl = OUT_RIGHT;
        PIO0.sm[side].pinctrl = (uint32_t)pins[side] << IN_BASE_AT;
        PIO0.sm[side].instr = SAME;
    }
    PIO0.ctrl = ENABLE << 0 | ENABLE << 1;
}

static volatile uint32_t *edges(uint32_t pin)
{
    return &IO_BANK0.intr[pin / 8];
}

static void start_slice(unsigned slice, uint32_t div, uint32_t top, uint32_t mode)
{
    PWM.ch[slice].div = div << 4;
    PWM.ch[slice].top = top;
    PWM.ch[slice].csr = mode | ON;
}

static void start_motors(uint32_t core_hz)
{
    static const uint8_t pins[] = {BOARD_LEFT_PWM, BOARD_LEFT_BACK, BOARD_RIGHT_PWM, BOARD_RIGHT_BACK};

    for (unsigned side = 0; side < PINS_SIDES; side++) {
        start_slice(LEFT + side, 1, core_hz / PWM_HZ - 1, 0);
        pins_push(side, 0);   /* in parts of top */
    }
    for (unsigned i = 0; i < sizeof pins; i++)
        gpio_set(pins[i], GPIO_BY_PWM);
}

/* Its counter has 16 bits: the clock is divided as far as needed. */
static void start_beat(uint32_t core_hz)
{
    uint32_t div = core_hz / ((uint32_t)BEAT_HZ * COUNTER_SPAN) + 1;

    start_slice(BEAT, div, core_hz / BEAT_HZ / div - 1, 0);
    PWM.intr = 1u << BEAT;
    PWM.inte = 1u << BEAT;
    UART0.uartimsc = RECEIVES;
    NVIC.iser[0] = 1u << PWM_WRAP | 1u << UART0_ANY;
}

static void start_inputs(void)
{
    for (unsigned i = 0; i < sizeof PULLED_UP; i++)
        gpio_set(PULLED_UP[i], GPIO_BY_CORE);
    *edges(BOARD_BRIDGE_FAULT) = (uint32_t)FELL << BOARD_BRIDGE_FAULT % 8 * 4;
    gpio_set(BOARD_BEACON, GPIO_BY_PWM);
    start_slice(BURSTS, 1, COUNTER_SPAN - 1, BY_FALLING_B);
    gpio_analogue(BOARD_PROXIMITY_FRONT_RIGHT);
    gpio_analogue(BOARD_PROXIMITY_FRONT);
    gpio_analogue(BOARD_PROXIMITY_FRONT_LEFT);
    gpio_analogue(BOARD_BATTERY);
    encoders_start((const uint8_t[]){BOARD_LEFT_ENCODER_A, BOARD_RIGHT_ENCODER_A});
}

void pins_open(void)
{
    uint32_t core_hz = machine_clocks().core_hz;

    pins_wake_bridge(false);
    pins_shine(false);
    gpio_output(BOARD_BRIDGE_AWAKE);
    gpio_output(BOARD_INFRARED);
    clock_release(RESET_PWM);
    if (clock_start_adc())
        clock_release(RESET_ADC);
    ADC.cs = ADC_ON;
    start_inputs();
    start_motors(core_hz);
    start_beat(core_hz);
}

/* Bounded by the watchdog: without its timer the robot must not continue. Whatever wakes it, it serves the line. */
void pins_wait(void)
{
    while (!(PWM.intr & 1u << BEAT)) {
        line_pump();
        NVIC.icpr[0] = 1u << UART0_ANY;
        core_sleep();
    }
    PWM.intr = 1u << BEAT;
    NVIC.icpr[0] = 1u << PWM_WRAP;
}

/* A full FIFO has old counts: the next one is new. The last one, if the state machine does not answer. */
uint16_t pins_count(unsigned side)
{
    for (unsigned i = 0; i <= FIFO; i++) {
        unsigned polls = 0;

        while (polls < ENCODER_WAIT_MAX && (PIO0.fstat >> (EMPTY_AT + side) & 1u) != 0)
            polls++;
        if (polls == ENCODER_WAIT_MAX)
            break;
        last[side] = (uint16_t)PIO0.rxf[side];
    }
    return last[side];
}

/* Slow decay: both half-bridges are on, which brakes, but for the duty, in which one of them is off. So the motor's
 * current never ends, and its speed is proportional to the duty. */
void pins_push(unsigned side, int32_t duty)
{
    uint32_t top = PWM.ch[LEFT + side].top + 1;
    uint32_t rest = top - ((uint32_t)(duty < 0 ? -duty : duty) * top >> 16);

    PWM.ch[LEFT + side].cc = duty < 0 ? top << 16 | rest : rest << 16 | top;
}

void pins_wake_bridge(bool awake)
{
    gpio_write(BOARD_BRIDGE_AWAKE, awake);
}

/* The bridge itself has switched off. Its signal is kept, however short. */
bool pins_bridge_failed(void)
{
    return (*edges(BOARD_BRIDGE_FAULT) >> BOARD_BRIDGE_FAULT % 8 * 4 & (LOW | FELL)) != 0;
}

void pins_shine(bool on)
{
    gpio_write(BOARD_INFRARED, on);
}

/* Returns 0 if nothing converts: then the battery is flat, and the wheels rest. */
static uint16_t convert(uint32_t channel)
{
    unsigned polls = 0;

    ADC.cs = channel << ADC_CHANNEL_AT | ADC_ONCE | ADC_ON;
    while (polls < ADC_WAIT_MAX && !(ADC.cs & ADC_READY))
        polls++;
    return polls < ADC_WAIT_MAX && !(ADC.cs & ADC_ERROR) ? (uint16_t)ADC.result : 0;
}

void pins_measure(uint16_t light[FEEL_COUNT])
{
    light[0] = 0;
    light[FEEL_COUNT - 1] = 0;
    light[1] = convert(BOARD_PROXIMITY_FRONT_RIGHT_CHANNEL);
    light[2] = convert(BOARD_PROXIMITY_FRONT_CHANNEL);
    light[3] = convert(BOARD_PROXIMITY_FRONT_LEFT_CHANNEL);
}

uint32_t pins_battery_mv(void)
{
    return (uint32_t)convert(BOARD_BATTERY_CHANNEL) * SUPPLY_MV * BATTERY_HALVES / (2 * SAMPLE_SPAN);
}

uint16_t pins_bursts(void)
{
    return (uint16_t)PWM.ch[BURSTS].ctr;
}

bool pins_bumped(void)
{
    return !gpio_read(BOARD_BUMPER_LEFT) || !gpio_read(BOARD_BUMPER_RIGHT);
}

bool pins_button(void)
{
    return !gpio_read(BOARD_BUTTON);
}
