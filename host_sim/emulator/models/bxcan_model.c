/* Registers of the bxCAN, and what they are after a reset. */
#include "host_sim/emulator/models/bxcan_parts.h"

#include <string.h>

enum {
    MCR = 0x00, MSR = 0x04, TSR = 0x08, RF0R = 0x0C, RF1R = 0x10, IER = 0x14, ESR = 0x18, BTR = 0x1C,
    MAILBOX_0 = 0x180, OUTPUT_0 = 0x1B0, OUTPUT_END = 0x1D0, FMR = 0x200, FA1R = 0x21C, BANK_0 = 0x240,

    MASTER_RESET = 1 << 15,
    MCR_RESET = 0x00010002, MSR_LEVELS = 0xC00, BTR_RESET = 0x01230000, FMR_RESET = 0x2A1C0E01
};

static const uint32_t UNDEFINED = 0xA5A5A5A5u;

void bxcan_open(struct bxcan *can, struct can_wire *wire, unsigned bank_count)
{
    memset(can, 0, sizeof *can);
    can->wire = wire;
    can->bank_count = bank_count;
    wire->nodes[wire->node_count++] = can;
    bxcan_reset(can);
}

void bxcan_reset(struct bxcan *can)
{
    can->mcr = MCR_RESET;
    can->btr = BTR_RESET;
    can->ier = 0;
    can->mode = can->wanted = BXCAN_SLEEP;
    can->mode_ns = can->recovery_ns = BXCAN_NEVER;
    can->tec = can->rec = can->last_error = 0;
    can->bus_off = false;
    can->on_wire = -1;
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

uint64_t bxcan_advance(struct bxcan *can)
{
    bxcan_release_due(can);
    return bxcan_advance_mode(can);
}

static bool write_mcr(struct bxcan *can, uint32_t value)
{
    if (value & MASTER_RESET) {
        bxcan_reset(can);
        return true;
    }
    can->mcr = value;
    bxcan_ask_mode(can);
    return true;
}

static bool write_btr(struct bxcan *can, uint32_t value)
{
    if (can->mode != BXCAN_INIT)
        return bxcan_refuse(can, "CAN1 BTR was written outside set-up");
    if (value >> 30)
        return bxcan_refuse(can, "CAN1 was set to loop back or silence, which is not modelled");
    can->btr = value;
    return true;
}

static bool is_filter(const struct bxcan *can, uint32_t offset)
{
    bool named = offset == FMR || (offset > FMR && offset <= FA1R && offset / 4 % 2 == 1);

    return named || (offset >= BANK_0 && offset < BANK_0 + 8 * can->bank_count);
}

int64_t bxcan_read(struct bxcan *can, uint32_t offset)
{
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
        return can->mode | MSR_LEVELS;
    case TSR:
        return bxcan_read_tsr(can);
    case RF0R:
    case RF1R:
        return can->fifos[(offset - RF0R) / 4].count | can->fifos[(offset - RF0R) / 4].flags;
    case IER:
        return can->ier;
    case ESR:
        return bxcan_error_status(can);
    case BTR:
        return can->btr;
    default:
        (void)bxcan_refuse(can, "CAN1 has no register at 0x%03X", (unsigned)offset);
        return -1;
    }
}

bool bxcan_write(struct bxcan *can, uint32_t offset, uint32_t value)
{
    if (offset >= MAILBOX_0 && offset < OUTPUT_0)
        return bxcan_write_mailbox(can, offset - MAILBOX_0, value);
    if (offset >= OUTPUT_0 && offset < OUTPUT_END)
        return bxcan_refuse(can, "the output mailbox of CAN1 FIFO %u was written, which is read-only",
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
        return value == 0 || bxcan_refuse(can, "CAN1 interrupts were enabled, which are not modelled");
    case ESR:
        can->last_error = value >> 4 & 7u;
        return true;
    case BTR:
        return write_btr(can, value);
    default:
        return bxcan_refuse(can, "CAN1 has no register at 0x%03X", (unsigned)offset);
    }
}
