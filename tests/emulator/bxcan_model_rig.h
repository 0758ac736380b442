/* bxcan_model_rig.h: a model of bxCAN on a wire, for its tests. */
#ifndef OCTET_BXCAN_MODEL_RIG_H
#define OCTET_BXCAN_MODEL_RIG_H

#include <string.h>

#include "tests/test.h"
#include "host_sim/emulator/models/bxcan_model.h"

enum {
    MCR = 0x00, MSR = 0x04, TSR = 0x08, RF0R = 0x0C, RF1R = 0x10, IER = 0x14, ESR = 0x18, BTR = 0x1C,
    OUTPUT_0 = 0x1B0, FMR = 0x200, FM1R = 0x204, FS1R = 0x20C, FFA1R = 0x214, FA1R = 0x21C, BANK_0 = 0x240,
    INRQ = 1, TXFP = 4, RFLM = 8, NART = 0x10, ABOM = 0x40, INAK = 1, SLAK = 2,
    RQCP = 1, TXOK = 2, ALST = 4, TERR = 8, ABRQ = 0x80, TME_ALL = 7 << 26,
    FULL = 8, FOVR = 0x10, RFOM = 0x20, EWGF = 1, EPVF = 2, BOFF = 4,
    CLOCK_HZ = 42000000, BIT_TIMING = 9 << 16 | 2 << 20 | 5,   /* 42 MHz / 6 / (1 + 10 + 3) quanta */
    ERROR_US = 80, RECOVERY_US = 128 * 22
};

extern struct can_wire wire;
extern struct bxcan can, other;

uint32_t read_register(uint32_t offset);
        /* A register of `can`; a refusal fails the test. */

void write_register(uint32_t offset, uint32_t value);

void pass_us(uint32_t us);
        /* Lets time pass on the wire. */

void enter_init(struct bxcan *node);
        /* Asks for init and waits for it. */

void join(struct bxcan *node, uint32_t mcr);
        /* Enters init, opens all filters, and leaves init for the bus. */

void join_alone(uint32_t mcr);
        /* A new wire, with `can` alone on it. */

void request_from(struct bxcan *node, uint32_t mailbox, uint32_t id);
        /* Fills a mailbox and asks for it to be sent. */

void request(uint32_t mailbox, uint32_t id);
        /* request_from(&can, ...). */

void deliver(uint32_t id);
        /* Sends a frame from the world, and lets 300 us pass for it to arrive. */

uint32_t take_frame(void);
        /* Takes the next frame out of FIFO 0, and returns its identifier. */

void assert_heard(unsigned count, const uint32_t ids[]);
        /* Checks that the world received exactly these, in this order. */

void join_other(void);
        /* `other` joins the same bus. */

#define ASSERT_HEARD(...) \
    assert_heard(sizeof((uint32_t[]){__VA_ARGS__}) / sizeof(uint32_t), (const uint32_t[]){__VA_ARGS__})
#define ASSERT_REFUSED(REASON, ACCESS)                                                                                 \
    do {                                                                                                               \
        can.node.refusal[0] = '\0';                                                                                         \
        (void)(ACCESS);                                                                                                \
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(can.node.refusal, REASON), can.node.refusal);                                        \
    } while (0)

#endif
