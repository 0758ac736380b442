/* fdcan_rig.h: the rig of can_rig.h with the model of FDCAN. */
#ifndef OCTET_FDCAN_RIG_H
#define OCTET_FDCAN_RIG_H

#include "can_rig.h"
#include "hal/stm32/registers.h"
#include "host_sim/emulator/models/fdcan_model.h"

enum {
    CCCR = 0x018, IR = 0x050, IE = 0x054, ILE = 0x05C, RXF0A = 0x094, RXF1A = 0x09C, TXBAR = 0x0CC, TXBCR = 0x0D0,
    NBTP = 0x01C, RXGFC = 0x080, TXBC = 0x0C0, INIT = 1, CCE = 2,
    NOT_WRITTEN = 0xFF   /* no driver writes that; each write is told from it */
};

static const uint32_t RIG_CLOCKS_HZ[] = {80000000, 16000000, 0};   /* of chips with it; ends with 0 */
volatile struct fdcan_registers FDCAN;
volatile struct fdcan_ram FDCAN_RAM;
static struct fdcan can;

/* Of what is written to make something happen, each write counts. */
static bool shows(uint32_t offset, uint32_t *out)
{
    static const uint32_t others[] = {CCCR, NBTP, 0x040, 0x044, RXGFC, 0x090, 0x098, TXBC, 0x0C4, 0x0C8};
    bool is_there = offset >= FDCAN_RAM_AT;

    if (offset == IR || offset == RXF0A || offset == RXF1A)
        *out = NOT_WRITTEN;
    else if (offset == TXBAR || offset == TXBCR)
        *out = 0;
    else
        for (unsigned i = 0; i < sizeof others / sizeof *others && !is_there; i++)
            is_there = offset == others[i];
    if (is_there)
        *out = (uint32_t)node_read(&can.node, offset);
    return is_there || *out == NOT_WRITTEN || offset == TXBAR || offset == TXBCR;
}

static void open_controller(void)
{
    memset((void *)&FDCAN, 0, sizeof FDCAN);
    fdcan_open(&can, &wire);
    FDCAN.ie = FDCAN.ile = 3;
    machine = (struct clocks){80000000, 80000000, 80000000, true};
}

/* CCE is there and gone again between two looks. */
static void prepare(uint32_t offset)
{
    if (offset == NBTP || offset == RXGFC || offset == TXBC)
        TEST_ASSERT_TRUE_MESSAGE(node_write(&can.node, CCCR, INIT | CCE), can.node.refusal);
}

const struct can_memory CAN_MEMORY = {
    &can.node, {(volatile uint32_t *)&FDCAN, (volatile uint32_t *)&FDCAN_RAM}, {sizeof FDCAN / 4, sizeof FDCAN_RAM / 4},
    FDCAN_RAM_AT, shows, open_controller, prepare,
};

static inline struct rig_bit rig_bit(void)
{
    uint32_t timing = FDCAN.nbtp;

    return (struct rig_bit){(timing >> 16 & 0x1FFu) + 1, (timing >> 8 & 0xFFu) + 2, (timing & 0x7Fu) + 1, (timing >> 25) + 1};
}

static inline int rig_fifo_for(uint32_t id)
{
    unsigned filter;

    return fdcan_fifo_for(&can, &(struct frame){.id = id}, &filter);
}

static inline void rig_open_filters(void)
{
    can.rxgfc = 0;
}

static inline bool rig_is_off_bus(void)
{
    return FDCAN.cccr & 1u;
}

#endif
