/* Registers of the bxCAN, their reset values, and its modes. */
#include "host_sim/emulator/models/bxcan_parts.h"

#include <string.h>

enum {
    MCR = 0x00, MSR = 0x04, TSR = 0x08, RF0R = 0x0C, RF1R = 0x10, IER = 0x14, ESR = 0x18, BTR = 0x1C,
    MAILBOX_0 = 0x180, OUTPUT_0 = 0x1B0, OUTPUT_END = 0x1D0, FMR = 0x200, FA1R = 0x21C, BANK_0 = 0x240,

    INRQ = 1 << 0, SLEEP = 1 << 1, ABOM = 1 << 6, MASTER_RESET = 1 << 15,       /* of MCR */
    EWGF = 1 << 0, EPVF = 1 << 1, BOFF = 1 << 2,
    MCR_RESET = 0x00010002, MSR_LEVELS = 0xC00, BTR_RESET = 0x01230000, FMR_RESET = 0x2A1C0E01
};

static const uint32_t UNDEFINED = 0xA5A5A5A5u;

void bxcan_reset(struct bxcan *can)
{
    can->mcr = MCR_RESET;
    can->btr = BTR_RESET;
    can->ier = 0;
    node_reset(&can->node, NODE_SLEEP);
    memset(can->fifos, 0, sizeof can->fifos);
    memset(can->mailboxes, 0, sizeof can->mailboxes);
    for (unsigned n = 0; n < BXCAN_MAILBOXES; n++) {
        memset(can->mailboxes[n].words, 0xA5, sizeof can->mailboxes[n].words);
        can->mailboxes[n].words[0] = UNDEFINED & ~(uint32_t)BXCAN_TXRQ;
    }
    memset(&can->filters, 0, sizeof can->filters);
    memset(can->filters.banks, 0xA5, sizeof can->filters.banks);
    can->filters.words[0] = FMR_RESET;
}

static bool write_mcr(struct bxcan *can, uint32_t value)
{
    if (value & MASTER_RESET) {
        bxcan_reset(can);
        return true;
    }
    can->mcr = value;
    node_ask_mode(&can->node, value & SLEEP ? NODE_SLEEP : value & INRQ ? NODE_INIT : NODE_NORMAL);
    return true;
}

static bool write_btr(struct bxcan *can, uint32_t value)
{
    if (can->node.mode != NODE_INIT)
        return node_refuse(&can->node, "CAN1 BTR was written outside set-up");
    if (value >> 30)
        return node_refuse(&can->node, "CAN1 was set to loop back or silence, which is not modelled");
    can->btr = value;
    return true;
}

static bool is_filter(const struct bxcan *can, uint32_t offset)
{
    bool named = offset == FMR || (offset > FMR && offset <= FA1R && offset / 4 % 2 == 1);

    return named || (offset >= BANK_0 && offset < BANK_0 + 8 * can->bank_count);
}

static uint32_t error_status(const struct can_node *node)
{
    uint32_t flags = node->tec >= NODE_WARNING || node->rec >= NODE_WARNING ? EWGF : 0;
    uint32_t tec = node->tec < 255 ? node->tec : 255, rec = node->rec < 255 ? node->rec : 255;

    flags |= node_is_passive(node) ? EPVF : 0u;
    flags |= node->bus_off ? BOFF : 0u;
    return flags | node->last_error << 4 | tec << 16 | rec << 24;
}

static int64_t read_register(struct can_node *node, uint32_t offset)
{
    struct bxcan *can = (struct bxcan *)node;

    if (offset >= MAILBOX_0 && offset < OUTPUT_0)
        return can->mailboxes[(offset - MAILBOX_0) / 16].words[offset / 4 % 4];
    if (offset >= OUTPUT_0 && offset < OUTPUT_END)
        return bxcan_read_output(can, offset - OUTPUT_0);
    if (is_filter(can, offset))
        return offset < BANK_0 ? can->filters.words[(offset - FMR) / 4] : can->filters.banks[(offset - BANK_0) / 4];
    switch (offset) {
    case MCR:
        return can->mcr;
    case MSR:
        return can->node.mode | MSR_LEVELS;
    case TSR:
        return bxcan_read_tsr(can);
    case RF0R:
    case RF1R:
        return can->fifos[(offset - RF0R) / 4].count | can->fifos[(offset - RF0R) / 4].flags;
    case IER:
        return can->ier;
    case ESR:
        return error_status(node);
    case BTR:
        return can->btr;
    default:
        (void)node_refuse(&can->node, "CAN1 has no register at 0x%03X", (unsigned)offset);
        return -1;
    }
}

static bool write_register(struct can_node *node, uint32_t offset, uint32_t value)
{
    struct bxcan *can = (struct bxcan *)node;

    if (offset >= MAILBOX_0 && offset < OUTPUT_0)
        return bxcan_write_mailbox(can, offset - MAILBOX_0, value);
    if (offset >= OUTPUT_0 && offset < OUTPUT_END)
        return node_refuse(&can->node, "the output mailbox of CAN1 FIFO %u was written, which is read-only",
                      (unsigned)(offset - OUTPUT_0) / 16);
    if (is_filter(can, offset))
        return bxcan_write_filters(can, offset, value);
    switch (offset) {
    case MCR:
        return write_mcr(can, value);
    case MSR:
        return true;
    case TSR:
        bxcan_write_tsr(can, value);
        return true;
    case RF0R:
    case RF1R:
        bxcan_write_rfr(can, &can->fifos[(offset - RF0R) / 4], value);
        return true;
    case IER:
        can->ier = value;
        return value == 0 || node_refuse(&can->node, "CAN1 interrupts were enabled, which are not modelled");
    case ESR:
        can->node.last_error = value >> 4 & 7u;
        return true;
    case BTR:
        return write_btr(can, value);
    default:
        return node_refuse(&can->node, "CAN1 has no register at 0x%03X", (unsigned)offset);
    }
}

static void lose_bus(struct can_node *node)
{
    if (((struct bxcan *)node)->mcr & ABOM)
        node_recover(node);
}

static uint32_t bit_rate(const struct can_node *node)
{
    uint32_t btr = ((const struct bxcan *)node)->btr;
    uint32_t quanta = 1 + (btr >> 16 & 15u) + 1 + (btr >> 20 & 7u) + 1;

    return node->clock_hz / ((btr & 0x3FFu) + 1) / quanta;
}

void bxcan_open(struct bxcan *can, struct can_wire *wire, unsigned bank_count)
{
    static const struct can_kind kind = {
        read_register, write_register, bxcan_offer, bxcan_end, bxcan_store, lose_bus, bxcan_release_due, bit_rate,
    };

    memset(can, 0, sizeof *can);
    node_open(&can->node, &kind, wire);
    can->bank_count = bank_count;
    bxcan_reset(can);
}
