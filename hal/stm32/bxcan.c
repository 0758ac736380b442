/* bxCAN, the controller of STM32F1, F2 and F4 (RM0090 32, RM0008 24). */
#include "hal/port/cortex_m/can_controller.h"

#include <string.h>

#include "hal/stm32/chip.h"
#include "hal/stm32/registers.h"

enum {
    MCR_INRQ = 1 << 0,            /* TXFP stays clear: the lowest identifier is sent first */
    MSR_INAK = 1 << 0,
    TSR_ABRQ0 = 1 << 7,           /* aborts mailbox 0; the others' bits follow at intervals of 8 */
    TSR_TME_AT = 26,              /* a bit per mailbox: it is free */
    RFR_FMP = 3,
    RFR_FOVR = 1 << 4,
    RFR_RFOM = 1 << 5,
    ESR_EPVF = 1 << 1,
    ESR_BOFF = 1 << 2,
    FMR_FINIT = 1,
    ID_TXRQ = 1 << 0,
    ID_RTR = 1 << 1,
    ID_IDE = 1 << 2,
    STANDARD_AT = 21,
    EXTENDED_AT = 3,
    ID_BITS = 0x7FF
};

bool can_stop(void)
{
    uint32_t start = machine_ms();

    CAN1.mcr = MCR_INRQ;
    while (!(CAN1.msr & MSR_INAK))
        if (machine_ms() - start > CAN_STOP_MS)
            return false;
    return true;
}

void can_start(void)
{
    CAN1.mcr = 0;
}

enum can_state can_state(void)
{
    if (CAN1.esr & ESR_BOFF)
        return CAN_LOST;
    return CAN1.msr & MSR_INAK ? CAN_JOINING : CAN_JOINED;
}

/* One filter bank with a mask per entry, data frames only. */
static void set_filters(const uint16_t ids[], size_t count)
{
    uint32_t families = 0;

    CAN1.fmr |= FMR_FINIT;
    CAN1.fa1r = 0;
    CAN1.fs1r = (1u << count) - 1u;
    CAN1.fm1r = 0;
    for (size_t i = 0; i < count; i++) {
        bool family = ids[i] & LINK_FAMILY;
        uint32_t same = (uint32_t)ID_BITS & ~(family ? LINK_FAMILY_BITS : 0u);

        CAN1.bank[i][0] = (ids[i] & same) << STANDARD_AT;
        CAN1.bank[i][1] = same << STANDARD_AT | ID_IDE | ID_RTR;
        families |= (family ? 1u : 0u) << i;
    }
    CAN1.ffa1r = families;
    CAN1.fa1r = (1u << count) - 1u;
    CAN1.fmr &= ~(uint32_t)FMR_FINIT;
}

void can_set_up(uint32_t prescaler, uint32_t quanta, const uint16_t ids[], size_t id_count)
{
    uint32_t before = quanta - 1u - CAN_QUANTA_AFTER;

    CAN1.btr = (CAN_QUANTA_JUMP - 1u) << 24 | (CAN_QUANTA_AFTER - 1u) << 20 | (before - 1u) << 16 | (prescaler - 1u);
    CAN1.ier = 0;
    set_filters(ids, id_count);
}

static uint32_t id_from(uint32_t reg)
{
    uint32_t id = reg & ID_IDE ? FRAME_EXTENDED | reg >> EXTENDED_AT : reg >> STANDARD_AT;

    return reg & ID_RTR ? id | FRAME_REMOTE : id;
}

static void read_mailbox(const volatile struct can_mailbox *received, struct frame *out)
{
    uint32_t data[2] = {received->data[0], received->data[1]};
    uint32_t said = received->length & 15u;
    uint32_t len = said < 8 ? said : 8;

    *out = (struct frame){.id = id_from(received->id), .len = (uint8_t)len};
    memcpy(out->data, data, len);   /* the core is little-endian, too */
}

int can_take(unsigned fifo, struct frame *out)
{
    uint32_t status = CAN1.rfr[fifo];

    if (status & RFR_FOVR) {
        CAN1.rfr[fifo] = RFR_FOVR;
        return LINK_E_GARBLED;
    }
    if (!(status & RFR_FMP) || status & RFR_RFOM)
        return 0;
    read_mailbox(&CAN1.received[fifo], out);
    CAN1.rfr[fifo] = RFR_RFOM;
    return 1;
}

static void write_mailbox(volatile struct can_mailbox *mailbox, const struct frame *frame)
{
    uint32_t data[2];

    memcpy(data, frame->data, sizeof data);
    mailbox->length = frame->len;
    mailbox->data[0] = data[0];
    mailbox->data[1] = data[1];
    mailbox->id = frame->id << STANDARD_AT | ID_TXRQ;
}

uint32_t can_waiting(void)
{
    return ~CAN1.tsr >> TSR_TME_AT & ((1u << CAN_BUFFERS) - 1u);
}

uint32_t can_waiting_id(unsigned n)
{
    return CAN1.sent[n].id >> STANDARD_AT;
}

static bool holds(unsigned n, uint32_t waiting, uint32_t id)
{
    return waiting >> n & 1u && can_waiting_id(n) == id;
}

/* Equal identifiers are sent in the order of mailbox numbers. */
bool can_put(const struct frame *frame)
{
    uint32_t waiting = can_waiting();
    unsigned n = CAN_BUFFERS;

    while (n > 0 && !holds(n - 1, waiting, frame->id))
        n--;
    while (n < CAN_BUFFERS && waiting >> n & 1u)
        n++;
    if (n == CAN_BUFFERS)
        return false;
    write_mailbox(&CAN1.sent[n], frame);
    return true;
}

void can_abort(uint32_t buffers)
{
    uint32_t request = 0;

    for (unsigned n = 0; n < CAN_BUFFERS; n++)
        if (buffers >> n & 1u)
            request |= (uint32_t)TSR_ABRQ0 << 8 * n;
    CAN1.tsr = request;
}

static enum bus_state state_of(uint32_t status)
{
    if (status & ESR_BOFF)
        return BUS_OFF;
    return status & ESR_EPVF ? BUS_PASSIVE : BUS_ACTIVE;
}

void can_status(struct link_health *out)
{
    uint32_t status = CAN1.esr;

    out->state = state_of(status);
    out->tx_errors = (uint8_t)(status >> 16);
    out->rx_errors = (uint8_t)(status >> 24);
}
