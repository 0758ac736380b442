/* A quadrature decoder for PIO (data sheet 3.4): each state machine samples its two pins, jumps by their last and
 * their present state into a table, and pushes the count, which the FIFO drops while it is full. */
#include "hal/rp2040/encoder.h"

#include "hal/rp2040/clock.h"
#include "hal/rp2040/registers.h"

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
    WAIT_MAX = 1000                 /* polls; a count comes every 150 cycles */
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

static uint16_t last[ENCODERS];        /* counts: the program's only answer */

void encoders_start(const uint8_t pins[ENCODERS])
{
    clock_release(RESET_PIO0);
    for (unsigned i = 0; i < sizeof PROGRAM / sizeof *PROGRAM; i++)
        PIO0.instr_mem[i] = PROGRAM[i];
    for (unsigned side = 0; side < ENCODERS; side++) {
        PIO0.sm[side].clkdiv = (uint32_t)SLOWER << 16;
        PIO0.sm[side].execctrl = WRAP_TOP | WRAP_BOTTOM;
        PIO0.sm[side].shiftctrl = OUT_RIGHT;
        PIO0.sm[side].pinctrl = (uint32_t)pins[side] << IN_BASE_AT;
        PIO0.sm[side].instr = SAME;
    }
    PIO0.ctrl = ENABLE << 0 | ENABLE << 1;
}

/* A full FIFO has old counts: the next one is new. */
uint16_t encoder_count(unsigned side)
{
    for (unsigned i = 0; i <= FIFO; i++) {
        unsigned polls = 0;

        while (polls < WAIT_MAX && (PIO0.fstat >> (EMPTY_AT + side) & 1u) != 0)
            polls++;
        if (polls == WAIT_MAX)
            break;
        last[side] = (uint16_t)PIO0.rxf[side];
    }
    return last[side];
}
