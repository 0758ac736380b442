/* FDCAN, the controller of STM32G0, G4 and similar (RM0440 44), in classic CAN mode. */
#include "hal/port/cortex_m/can_controller.h"

#include <string.h>

#include "hal/stm32/registers.h"
#include "hal/stm32/chip.h"

static const uint32_t FILTER_WITH_MASK = 1u << 31;

enum {
    CCCR_INIT = 1 << 0,
    CCCR_CCE = 1 << 1,
    RXGFC_REJECT = 1 << 0 | 1 << 1 | 2 << 2 | 2 << 4,   /* remote frames, and frames that match no filter */
    RXGFC_FILTERS_AT = 16,
    FILTER_TO_FIFO_0 = 1 << 27,
    FILTER_TO_FIFO_1 = 2 << 27,
    ID_BITS = 0x7FF,
    TXBC_BY_IDENTIFIER = 1 << 24,
    TXFQS_NEXT_AT = 16,
    TXFQS_FULL = 1 << 21,
    RXFS_LEVEL = 15,
    RXFS_FIRST_AT = 8,
    RXFS_LOST = 1 << 25,
    IR_RF0L = 1 << 2,
    IR_RF1L = 1 << 5,
    PSR_ACTIVITY = 3 << 3,         /* 0: not yet synchronised with the bus */
    PSR_EP = 1 << 5,
    PSR_BO = 1 << 7,
    ID_EXTENDED = 1 << 30,
    ID_REMOTE = 1 << 29,
    ID_MASK = (1 << 29) - 1,
    STANDARD_AT = 18,
    LENGTH_AT = 16
};

/* CCE enables access to the configuration. It also clears the transmit buffers and receive FIFOs. */
bool can_stop(void)
{
    uint32_t start = machine_ms();

    FDCAN.cccr = CCCR_INIT;
    do
        if (machine_ms() - start > CAN_STOP_MS)
            return false;
    while (!(FDCAN.cccr & CCCR_INIT));
    FDCAN.cccr = CCCR_INIT | CCCR_CCE;
    return true;
}

void can_start(void)
{
    FDCAN.cccr = 0;
}

enum can_state can_state(void)
{
    uint32_t status = FDCAN.psr;

    if (status & PSR_BO)
        return CAN_LOST;
    return status & PSR_ACTIVITY ? CAN_JOINED : CAN_JOINING;
}

/* One filter with a mask per entry. */
static void set_filters(const uint16_t ids[], size_t count)
{
    for (size_t i = 0; i < count; i++) {
        bool family = ids[i] & LINK_FAMILY;
        uint32_t same = (uint32_t)ID_BITS & ~(family ? LINK_FAMILY_BITS : 0u);

        FDCAN_RAM.standard_filters[i] = FILTER_WITH_MASK | (uint32_t)(family ? FILTER_TO_FIFO_1 : FILTER_TO_FIFO_0)
            | (ids[i] & same) << 16 | same;
    }
    FDCAN.rxgfc = RXGFC_REJECT | (uint32_t)count << RXGFC_FILTERS_AT;
}

void can_set_up(uint32_t prescaler, uint32_t quanta, const uint16_t ids[], size_t id_count)
{
    uint32_t before = quanta - 1u - CAN_QUANTA_AFTER;

    FDCAN.nbtp = (CAN_QUANTA_JUMP - 1u) << 25 | (prescaler - 1u) << 16 | (before - 1u) << 8 | (CAN_QUANTA_AFTER - 1u);
    FDCAN.txbc = TXBC_BY_IDENTIFIER;
    FDCAN.ie = 0;
    FDCAN.ile = 0;
    set_filters(ids, id_count);
    FDCAN.ir = IR_RF0L | IR_RF1L;
}

static uint32_t id_from(uint32_t word)
{
    uint32_t id = word & ID_MASK;

    id = word & ID_EXTENDED ? FRAME_EXTENDED | id : id >> STANDARD_AT;
    return word & ID_REMOTE ? id | FRAME_REMOTE : id;
}

static void read_element(const volatile struct fdcan_element *element, struct frame *out)
{
    uint32_t data[2] = {element->data[0], element->data[1]};
    uint32_t said = element->control >> LENGTH_AT & 15u;
    uint32_t len = said < 8 ? said : 8;

    *out = (struct frame){.id = id_from(element->id), .len = (uint8_t)len};
    memcpy(out->data, data, len);   /* the core is little-endian, too */
}

int can_take(unsigned fifo, struct frame *out)
{
    uint32_t status = FDCAN.rxf[fifo].status;
    uint32_t first = status >> RXFS_FIRST_AT & 3u;

    if (status & RXFS_LOST) {
        FDCAN.ir = fifo == 0 ? IR_RF0L : IR_RF1L;
        return LINK_E_GARBLED;
    }
    if (!(status & RXFS_LEVEL))
        return 0;
    read_element(&FDCAN_RAM.received[fifo][first], out);
    FDCAN.rxf[fifo].read = first;
    return 1;
}

uint32_t can_waiting(void)
{
    return FDCAN.txbrp;
}

uint32_t can_waiting_id(unsigned n)
{
    return FDCAN_RAM.sent[n].id >> STANDARD_AT;
}

/* Equal identifiers are sent in the order of buffer numbers. */
static bool would_overtake(uint32_t buffer, uint32_t id)
{
    uint32_t waiting = can_waiting();

    for (uint32_t n = buffer + 1; n < CAN_BUFFERS; n++)
        if (waiting >> n & 1u && can_waiting_id(n) == id)
            return true;
    return false;
}

bool can_put(const struct frame *frame)
{
    uint32_t fifo = FDCAN.txfqs;
    uint32_t next = fifo >> TXFQS_NEXT_AT & 3u;
    volatile struct fdcan_element *element = &FDCAN_RAM.sent[next];
    uint32_t data[2];

    if (fifo & TXFQS_FULL || would_overtake(next, frame->id))
        return false;
    memcpy(data, frame->data, sizeof data);
    element->id = frame->id << STANDARD_AT;
    element->control = (uint32_t)frame->len << LENGTH_AT;
    element->data[0] = data[0];
    element->data[1] = data[1];
    FDCAN.txbar = 1u << next;
    return true;
}

void can_abort(uint32_t buffers)
{
    FDCAN.txbcr = buffers;
}

void can_status(struct link_health *out)
{
    uint32_t status = FDCAN.psr;
    uint32_t errors = FDCAN.ecr;

    out->state = status & PSR_BO ? BUS_OFF : status & PSR_EP ? BUS_PASSIVE : BUS_ACTIVE;
    out->tx_errors = (uint8_t)errors;
    out->rx_errors = (uint8_t)(errors >> 8 & 0x7Fu);
}
