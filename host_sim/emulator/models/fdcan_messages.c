/* Filters, receive FIFOs and transmit buffers of FDCAN, in its message RAM. */
#include "host_sim/emulator/models/fdcan_parts.h"

enum {
    REJECT_REMOTE_EXTENDED = 1 << 0, REJECT_REMOTE = 1 << 1, FILTERS_AT = 16,   /* RXGFC */
    BY_IDENTIFIER = 1 << 24,                                                    /* TXBC */
    FIFO_NEW = 1 << 0, FIFO_FULL = 1 << 1,                                      /* IR */
    STATUS_FULL = 1 << 24, STATUS_LOST = 1 << 25, QUEUE_FULL = 1 << 21,
    EXTENDED = 1 << 30, REMOTE = 1 << 29, ID = (1 << 29) - 1, STANDARD_AT = 18,
    LENGTH_AT = 16, FILTER_AT = 24
};

static const uint32_t NO_FILTER = 1u << 31, UNDEFINED_TIME = 0xABCD;

static bool matches(uint32_t filter, uint32_t id)
{
    uint32_t one = filter >> 16 & 0x7FFu, two = filter & 0x7FFu;

    switch (filter >> 30) {
    case 0:
        return id >= one && id <= two;
    case 1:
        return id == one || id == two;
    case 2:
        return ((id ^ one) & two) == 0;
    default:
        return false;
    }
}

/* Where frames go that no filter matches: 0 and 1 are the FIFOs. */
static int without_filter(const struct fdcan *can, bool extended)
{
    uint32_t to = can->rxgfc >> (extended ? 2 : 4) & 3u;

    return to < 2 ? (int)to : -1;
}

int fdcan_fifo_for(struct fdcan *can, const struct frame *frame, unsigned *filter)
{
    bool extended = frame->id & FRAME_EXTENDED;
    unsigned filters = extended ? 0 : can->rxgfc >> FILTERS_AT & 31u;

    *filter = filters;
    if (frame->id & FRAME_REMOTE && can->rxgfc & (extended ? REJECT_REMOTE_EXTENDED : REJECT_REMOTE))
        return -1;
    for (unsigned n = 0; n < filters; n++) {
        uint32_t to = can->ram[n] >> 27 & 7u;

        if (to == 0 || !matches(can->ram[n], frame->id & 0x7FFu))
            continue;
        *filter = n;
        if (to > 3)
            (void)node_refuse(&can->node, "filter %u of FDCAN1 gives priority, which is not modelled", n);
        return to < 3 ? (int)to - 1 : -1;
    }
    return without_filter(can, extended);
}

static uint32_t *element(struct fdcan *can, unsigned at, unsigned n)
{
    return &can->ram[at + FDCAN_ELEMENT_WORDS * n];
}

void fdcan_store(struct can_node *node, const struct frame *frame)
{
    struct fdcan *can = (struct fdcan *)node;
    unsigned filter;
    int n = fdcan_fifo_for(can, frame, &filter);
    struct fdcan_fifo_state *fifo = &can->fifos[n > 0];
    unsigned shift = FDCAN_FLAGS_OF_FIFO * (n > 0);
    bool matched = !(frame->id & FRAME_EXTENDED) && filter < (can->rxgfc >> FILTERS_AT & 31u);
    uint32_t *words;

    if (n < 0)
        return;
    if (fifo->count == FDCAN_BUFFERS) {
        can->ir |= (uint32_t)FDCAN_LOST << shift;
        node->overruns++;
        return;
    }
    words = element(can, FDCAN_RECEIVED, FDCAN_BUFFERS * (unsigned)n + (fifo->first + fifo->count++) % FDCAN_BUFFERS);
    words[0] = frame->id & FRAME_EXTENDED ? EXTENDED | (frame->id & ID) : (frame->id & 0x7FFu) << STANDARD_AT;
    words[0] |= frame->id & FRAME_REMOTE ? (uint32_t)REMOTE : 0;
    words[1] = (matched ? filter << FILTER_AT : NO_FILTER) | (uint32_t)frame->len << LENGTH_AT | UNDEFINED_TIME;
    words[2] = words[3] = 0;
    for (unsigned i = 0; i < 8 && i < frame->len; i++)
        words[2 + i / 4] |= (uint32_t)frame->data[i] << 8 * (i % 4);
    can->ir |= (uint32_t)(fifo->count == FDCAN_BUFFERS ? FIFO_NEW | FIFO_FULL : FIFO_NEW) << shift;
}

uint32_t fdcan_read_fifo(const struct fdcan *can, unsigned n)
{
    const struct fdcan_fifo_state *fifo = &can->fifos[n];
    uint32_t flags = fifo->count == FDCAN_BUFFERS ? STATUS_FULL : 0;

    flags |= can->ir >> FDCAN_FLAGS_OF_FIFO * n & FDCAN_LOST ? STATUS_LOST : 0u;
    return fifo->count | fifo->first << 8 | (fifo->first + fifo->count) % FDCAN_BUFFERS << 16 | flags;
}

bool fdcan_release(struct fdcan *can, unsigned n, uint32_t place)
{
    struct fdcan_fifo_state *fifo = &can->fifos[n];
    unsigned taken = (place + FDCAN_BUFFERS - fifo->first) % FDCAN_BUFFERS + 1;

    if (place >= FDCAN_BUFFERS || taken > fifo->count)
        return node_refuse(&can->node, "FDCAN1 RXF%uA was written %u, which holds no frame", n, (unsigned)place);
    fifo->first = (place + 1) % FDCAN_BUFFERS;
    fifo->count -= taken;
    return true;
}

/* Priority: by identifier, then by buffer number. */
static int next_to_send(struct fdcan *can)
{
    int next = -1;

    for (unsigned n = 0; n < FDCAN_BUFFERS; n++) {
        bool ready = can->pending >> n & 1u && !(can->node.stuck_mailboxes >> n & 1u);
        uint32_t id = element(can, FDCAN_SENT, n)[0] & ID;

        if (ready && (next < 0 || id < (element(can, FDCAN_SENT, (unsigned)next)[0] & ID)))
            next = (int)n;
    }
    return next;
}

bool fdcan_offer(struct can_node *node, struct frame *out)
{
    struct fdcan *can = (struct fdcan *)node;
    const uint32_t *words;
    uint32_t len;

    node->on_wire = next_to_send(can);
    if (node->on_wire < 0)
        return false;
    words = element(can, FDCAN_SENT, (unsigned)node->on_wire);
    len = words[1] >> LENGTH_AT & 15u;
    *out = (struct frame){.id = words[0] & EXTENDED ? FRAME_EXTENDED | (words[0] & ID)
                                                    : (words[0] & ID) >> STANDARD_AT};
    out->len = (uint8_t)(len < 8 ? len : 8);
    if (words[0] & REMOTE)
        out->id |= FRAME_REMOTE;
    for (unsigned i = 0; i < 8 && i < len; i++)
        out->data[i] = (uint8_t)(words[2 + i / 4] >> 8 * (i % 4));
    return true;
}

static void drop(struct fdcan *can, uint32_t buffers)
{
    can->pending &= ~buffers;
    can->given_up |= buffers;
    can->aborting &= ~buffers;
}

void fdcan_end(struct can_node *node, enum node_outcome outcome)
{
    struct fdcan *can = (struct fdcan *)node;
    uint32_t buffer = node->on_wire >= 0 ? 1u << node->on_wire : 0;

    node->on_wire = -1;
    if (outcome == NODE_SENT) {
        can->pending &= ~buffer;
        can->sent |= buffer;
        can->given_up |= buffer & can->aborting;
        can->aborting &= ~buffer;
    } else {
        drop(can, buffer & can->aborting);
    }
}

uint32_t fdcan_read_queue(const struct fdcan *can)
{
    if (!(can->txbc & BY_IDENTIFIER))
        return FDCAN_BUFFERS;
    for (unsigned n = 0; n < FDCAN_BUFFERS; n++)
        if (!(can->pending >> n & 1u))
            return n << 16;
    return QUEUE_FULL;
}

bool fdcan_ask_to_send(struct fdcan *can, uint32_t buffers)
{
    if (!(can->txbc & BY_IDENTIFIER))
        return node_refuse(&can->node, "FDCAN1 was asked to send from a FIFO (TXBC), which is not modelled");
    can->pending |= buffers & 7u;
    can->sent &= ~buffers;
    can->given_up &= ~buffers;
    return true;
}

/* Aborts a request at once, unless its frame is on the wire: that transmission is completed. */
void fdcan_ask_to_give_up(struct fdcan *can, uint32_t buffers)
{
    uint32_t under_way = can->node.on_wire >= 0 ? 1u << can->node.on_wire : 0;

    can->aborting |= buffers & can->pending;
    drop(can, can->aborting & ~under_way & ~(uint32_t)can->node.stuck_mailboxes);
}
