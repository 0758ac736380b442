/* Registers of FDCAN, their reset values, and its modes. */
#include "host_sim/emulator/models/fdcan_parts.h"

#include <string.h>

enum {
    CREL = 0x000, ENDN = 0x004, CCCR = 0x018, NBTP = 0x01C, ECR = 0x040, PSR = 0x044, IR = 0x050, IE = 0x054,
    ILS = 0x058, ILE = 0x05C, RXGFC = 0x080, RXF0S = 0x090, RXF0A = 0x094, RXF1S = 0x098, RXF1A = 0x09C,
    TXBC = 0x0C0, TXFQS = 0x0C4, TXBRP = 0x0C8, TXBAR = 0x0CC, TXBCR = 0x0D0, TXBTO = 0x0D4, TXBCF = 0x0D8,

    INIT = 1 << 0, CCE = 1 << 1,
    RXGFC_OVERWRITES = 3 << 8, RXGFC_EXTENDED_AT = 24,
    NO_CHANGE = 7, IDLE = 1 << 3, SENDING = 3 << 3, EP = 1 << 5, EW = 1 << 6, BO = 1 << 7, DATA_NO_CHANGE = 7 << 8,
    RP = 1 << 15, REC_MAX = 127, TEC_MAX = 255,
    CREL_RESET = 0x32141218, NBTP_RESET = 0x06000A03
};

static const uint32_t ENDIANNESS = 0x87654321u;

/* Setting CCE discards the frames that wait to be sent and those received. */
static void forget_all(struct fdcan *can)
{
    can->pending = can->aborting = can->sent = can->given_up = 0;
    can->node.on_wire = -1;
    memset(can->fifos, 0, sizeof can->fifos);
}

void fdcan_reset(struct fdcan *can)
{
    node_reset(&can->node, NODE_INIT);
    can->node.last_error = NO_CHANGE;
    can->cccr = INIT;
    can->nbtp = NBTP_RESET;
    can->rxgfc = can->txbc = can->ir = 0;
    forget_all(can);
}

static uint32_t read_cccr(const struct fdcan *can)
{
    bool there = can->cccr & INIT && can->node.mode == NODE_INIT && !can->node.init_stuck;

    return (can->cccr & ~(uint32_t)INIT) | (there ? INIT : 0u);
}

static bool write_cccr(struct fdcan *can, uint32_t value)
{
    if (value & ~(uint32_t)(INIT | CCE))
        return node_refuse(&can->node, "FDCAN1 CCCR was written 0x%X: only INIT and CCE are modelled",
                           (unsigned)value);
    if (value & CCE && !(read_cccr(can) & INIT))
        return node_refuse(&can->node, "FDCAN1 CCCR.CCE was set before INIT was read back");
    can->cccr = value & INIT ? value : 0;
    if (can->cccr & CCE)
        forget_all(can);
    node_ask_mode(&can->node, value & INIT ? NODE_INIT : NODE_NORMAL);
    return true;
}

static uint32_t read_ecr(const struct can_node *node)
{
    uint32_t tec = node->tec < TEC_MAX ? node->tec : TEC_MAX, rec = node->rec < REC_MAX ? node->rec : REC_MAX;

    return tec | rec << 8 | (node->rec >= NODE_PASSIVE ? (uint32_t)RP : 0);
}

/* Reading PSR resets its last error code. */
static uint32_t read_psr(struct can_node *node)
{
    uint32_t status = DATA_NO_CHANGE | node->last_error;

    status |= node_listens(node) ? node->on_wire >= 0 ? (uint32_t)SENDING : IDLE : 0u;
    status |= node_is_passive(node) ? (uint32_t)EP : 0;
    status |= node->tec >= NODE_WARNING || node->rec >= NODE_WARNING ? (uint32_t)EW : 0;
    status |= node->bus_off ? (uint32_t)BO : 0;
    node->last_error = NO_CHANGE;
    return status;
}

static int64_t read_register(struct can_node *node, uint32_t offset)
{
    struct fdcan *can = (struct fdcan *)node;

    if (offset >= FDCAN_RAM_AT && offset < FDCAN_RAM_AT + 4 * FDCAN_RAM_WORDS)
        return can->ram[(offset - FDCAN_RAM_AT) / 4];
    switch (offset) {
    case CREL:
        return CREL_RESET;
    case ENDN:
        return ENDIANNESS;
    case CCCR:
        return read_cccr(can);
    case NBTP:
        return can->nbtp;
    case ECR:
        return read_ecr(node);
    case PSR:
        return read_psr(node);
    case IR:
        return can->ir;
    case RXGFC:
        return can->rxgfc;
    case RXF0S:
    case RXF1S:
        return fdcan_read_fifo(can, (offset - RXF0S) / 8);
    case TXBC:
        return can->txbc;
    case TXFQS:
        return fdcan_read_queue(can);
    case TXBRP:
        return can->pending;
    case TXBCR:
        return can->aborting;
    case TXBTO:
        return can->sent;
    case TXBCF:
        return can->given_up;
    case IE:
    case ILS:
    case ILE:
    case RXF0A:
    case RXF1A:
    case TXBAR:
        return 0;
    default:
        (void)node_refuse(node, "FDCAN1 has no register at 0x%03X that is modelled", (unsigned)offset);
        return -1;
    }
}

static bool write_ram(struct fdcan *can, uint32_t word, uint32_t value)
{
    unsigned buffer = (word - FDCAN_SENT) / FDCAN_ELEMENT_WORDS;

    if (word >= FDCAN_SENT && can->pending >> buffer & 1u)
        return node_refuse(&can->node, "FDCAN1 transmit buffer %u was written while its frame is pending", buffer);
    can->ram[word] = value;
    return true;
}

static bool write_setup(struct fdcan *can, uint32_t offset, uint32_t value)
{
    if (!(can->cccr & CCE))
        return node_refuse(&can->node, "the register of FDCAN1 at 0x%03X was written while CCCR.CCE is 0",
                           (unsigned)offset);
    if (offset == RXGFC && (value & RXGFC_OVERWRITES || value >> RXGFC_EXTENDED_AT))
        return node_refuse(&can->node,
                           "FDCAN1 RXGFC 0x%08X is not modelled: extended filters, or FIFOs that overwrite",
                           (unsigned)value);
    *(offset == NBTP ? &can->nbtp : offset == RXGFC ? &can->rxgfc : &can->txbc) = value;
    return true;
}

static bool write_register(struct can_node *node, uint32_t offset, uint32_t value)
{
    struct fdcan *can = (struct fdcan *)node;

    if (offset >= FDCAN_RAM_AT && offset < FDCAN_RAM_AT + 4 * FDCAN_RAM_WORDS)
        return write_ram(can, (offset - FDCAN_RAM_AT) / 4, value);
    switch (offset) {
    case CCCR:
        return write_cccr(can, value);
    case NBTP:
    case RXGFC:
    case TXBC:
        return write_setup(can, offset, value);
    case IR:
        can->ir &= ~value;
        return true;
    case IE:
    case ILS:
    case ILE:
        return value == 0 || node_refuse(node, "FDCAN1 interrupts were enabled, which are not modelled");
    case RXF0A:
    case RXF1A:
        return fdcan_release(can, (offset - RXF0A) / 8, value);
    case TXBAR:
        return fdcan_ask_to_send(can, can->cccr & CCE ? 0 : value);
    case TXBCR:
        fdcan_ask_to_give_up(can, value);
        return true;
    default:
        return node_refuse(node, "the register of FDCAN1 at 0x%03X was written, which cannot be", (unsigned)offset);
    }
}

/* The controller leaves the bus by itself, and stays away until INIT is cleared. */
static void lose_bus(struct can_node *node)
{
    ((struct fdcan *)node)->cccr |= INIT;
    node->mode = node->wanted = NODE_INIT;
    node->mode_ns = UINT64_MAX;
    node->inits++;
}

static void pass(struct can_node *node)
{
    (void)node;
}

static uint32_t bit_rate(const struct can_node *node)
{
    uint32_t nbtp = ((const struct fdcan *)node)->nbtp;
    uint32_t quanta = 1 + (nbtp >> 8 & 0xFFu) + 1 + (nbtp & 0x7Fu) + 1;

    return node->clock_hz / ((nbtp >> 16 & 0x1FFu) + 1) / quanta;
}

void fdcan_open(struct fdcan *can, struct can_wire *wire)
{
    static const struct can_kind kind = {
        read_register, write_register, fdcan_offer, fdcan_end, fdcan_store, lose_bus, pass, bit_rate,
    };

    memset(can, 0, sizeof *can);
    memset(can->ram, 0xA5, sizeof can->ram);
    node_open(&can->node, &kind, wire);
    fdcan_reset(can);
}
