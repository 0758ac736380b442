/* Frames over the chip's own CAN controller, bxCAN (RM0090 32, RM0008 24). Nothing here waits without a bound. */
#include "hal/link/link.h"

#include <stdbool.h>

#include "hal/stm32/can_timing.h"
#include "hal/stm32/line.h"
#include "hal/stm32/machine.h"
#include "hal/stm32/registers.h"

enum {
    INIT_MS = 2,                  /* to enter initialization: the frame under way ends first */
    RECOVERY_MS = 250,            /* from bus-off to the next try: four times what a full bus needs */
    IDS_PER_BANK = 4,
    MAILBOXES = 3,

    MCR_INRQ = 1 << 0,
    MCR_TXFP = 1 << 2,            /* mailboxes leave in the order of request */
    MSR_INAK = 1 << 0,
    TSR_ABRQ_ALL = 1 << 7 | 1 << 15 | 1 << 23,
    TSR_TME0 = 1 << 26,
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
    EXTENDED_AT = 3
};

struct link {
    uint32_t off_ms;   /* when the last try to recover from bus-off began */
    bool off;          /* bus-off, and not yet recovered */
    uint8_t bus_offs;
    uint8_t dropped;   /* both as in struct link_health */
};

static struct link the_link;   /* one controller */

/* Of a bit of so many quanta, one of which comes before all that can be set. */
static void set_bit_timing(uint32_t clock_hz, uint32_t quanta)
{
    uint32_t before = quanta - 1u - CAN_QUANTA_AFTER;
    uint32_t prescaler = clock_hz / (CAN_BITRATE * quanta);

    CAN1.btr = (CAN_QUANTA_JUMP - 1u) << 24 | (CAN_QUANTA_AFTER - 1u) << 20 | (before - 1u) << 16 | (prescaler - 1u);
}

static bool enter_init(void)
{
    uint32_t start = machine_ms();

    CAN1.mcr = MCR_TXFP | MCR_INRQ;
    while (!(CAN1.msr & MSR_INAK))
        if (machine_ms() - start > INIT_MS)
            return false;
    return true;
}

/* The controller joins once the bus has been idle for 11 bits. Nobody waits for that. */
static void leave_init(void)
{
    CAN1.mcr = MCR_TXFP;
}

/* As lists of four identifiers a bank, data frames only. A bank that is not full repeats the first. */
static void set_filters(const uint16_t ids[], size_t count)
{
    uint32_t banks = (uint32_t)(count + IDS_PER_BANK - 1) / IDS_PER_BANK;
    uint32_t in_use = (1u << banks) - 1u;

    CAN1.fmr |= FMR_FINIT;
    CAN1.fa1r = 0;
    CAN1.fs1r = 0;
    CAN1.ffa1r = 0;
    CAN1.fm1r = in_use;
    for (size_t i = 0; i < banks * IDS_PER_BANK; i += 2) {
        uint32_t low = ids[i < count ? i : 0];
        uint32_t high = ids[i + 1 < count ? i + 1 : 0];

        CAN1.bank[i / IDS_PER_BANK][i / 2 % 2] = high << STANDARD_AT | low << (STANDARD_AT - 16);
    }
    CAN1.fa1r = in_use;
    CAN1.fmr &= ~(uint32_t)FMR_FINIT;
}

int link_open(struct link **link, const char *name, const uint16_t ids[], size_t id_count)
{
    uint32_t clock_hz = machine_clocks().can_hz;
    uint32_t quanta = can_quanta(clock_hz);

    (void)name;
    if (id_count > LINK_IDS_MAX || quanta == 0 || !enter_init())
        return LINK_E_OPEN;
    set_bit_timing(clock_hz, quanta);
    CAN1.ier = 0;
    set_filters(ids, id_count);
    leave_init();
    the_link = (struct link){.off = false};
    *link = &the_link;
    return 0;
}

static void count(uint8_t *counter)
{
    if (*counter < UINT8_MAX)
        ++*counter;
}

/* What waits to be sent would be out of date by the time it could be. */
static void flush(struct link *link)
{
    for (unsigned n = 0; n < MAILBOXES; n++)
        if (!(CAN1.tsr & (uint32_t)TSR_TME0 << n))
            count(&link->dropped);
    CAN1.tsr = TSR_ABRQ_ALL;
}

static void recover(struct link *link)
{
    uint32_t now = machine_ms();

    if (link->off && now - link->off_ms < RECOVERY_MS)
        return;
    if (!link->off)
        count(&link->bus_offs);
    flush(link);
    link->off = true;
    link->off_ms = now;
    if (enter_init())
        leave_init();
}

static bool is_up(struct link *link)
{
    if (CAN1.esr & ESR_BOFF) {
        recover(link);
        return false;
    }
    link->off = false;
    return !(CAN1.msr & MSR_INAK);
}

static uint32_t id_from(uint32_t reg)
{
    uint32_t id = reg & ID_IDE ? FRAME_EXTENDED | reg >> EXTENDED_AT : reg >> STANDARD_AT;

    return reg & ID_RTR ? id | FRAME_REMOTE : id;
}

static uint8_t byte_of(const uint32_t data[2], unsigned i)
{
    return (uint8_t)(data[i / 4u] >> 8u * (i % 4u));
}

static void take(struct frame *out)
{
    uint32_t data[2] = {CAN1.received[0].data[0], CAN1.received[0].data[1]};
    uint32_t said = CAN1.received[0].length & 15u;
    uint32_t len = said < 8 ? said : 8;

    *out = (struct frame){.id = id_from(CAN1.received[0].id), .len = (uint8_t)len};
    for (unsigned i = 0; i < len; i++)
        out->data[i] = byte_of(data, i);
    CAN1.rf0r = RFR_RFOM;
}

/* 1, 0 or LINK_E_GARBLED as link_receive, without waiting. */
static int look(struct frame *out)
{
    uint32_t fifo = CAN1.rf0r;

    if (fifo & RFR_FOVR) {
        CAN1.rf0r = RFR_FOVR;
        return LINK_E_GARBLED;
    }
    if (!(fifo & RFR_FMP) || fifo & RFR_RFOM)
        return 0;
    take(out);
    return 1;
}

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    uint32_t start = machine_ms();
    bool up;
    int result;

    do {
        up = is_up(link);
        result = look(out);
    } while (result == 0 && machine_ms() - start < wait_ms);
    return result == 0 && !up ? LINK_E_DOWN : result;
}

/* Number of a free mailbox, or MAILBOXES. */
static unsigned free_mailbox(void)
{
    uint32_t status = CAN1.tsr;
    unsigned n = 0;

    while (n < MAILBOXES && !(status & (uint32_t)TSR_TME0 << n))
        n++;
    return n;
}

static uint32_t word_of(const uint8_t data[4])
{
    return data[0] | (uint32_t)data[1] << 8 | (uint32_t)data[2] << 16 | (uint32_t)data[3] << 24;
}

static void put(volatile struct can_mailbox *mailbox, const struct frame *frame)
{
    mailbox->length = frame->len;
    mailbox->data[0] = word_of(&frame->data[0]);
    mailbox->data[1] = word_of(&frame->data[4]);
    mailbox->id = frame->id << STANDARD_AT | ID_TXRQ;
}

int link_send(struct link *link, const struct frame *frame)
{
    uint32_t start = machine_ms();
    unsigned n;

    if (!is_up(link))
        return LINK_E_DOWN;
    while ((n = free_mailbox()) == MAILBOXES)
        if (machine_ms() - start > LINK_SEND_MS) {
            flush(link);
            return LINK_E_FULL;
        }
    put(&CAN1.sent[n], frame);
    return 0;
}

/* The controller keeps three frames by itself. */
void line_pump(void)
{
}

static enum bus_state state_of(uint32_t status)
{
    if (status & ESR_BOFF)
        return BUS_OFF;
    return status & ESR_EPVF ? BUS_PASSIVE : BUS_ACTIVE;
}

void link_health(const struct link *link, struct link_health *out)
{
    uint32_t status = CAN1.esr;

    *out = (struct link_health){
        .state = state_of(status),
        .tx_errors = (uint8_t)(status >> 16),
        .rx_errors = (uint8_t)(status >> 24),
        .bus_offs = link->bus_offs,
        .dropped = link->dropped,
    };
}

void link_close(struct link *link)
{
    if (link)
        (void)enter_init();
}
