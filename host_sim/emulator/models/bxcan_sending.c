/* Transmit mailboxes of the bxCAN. */
#include "host_sim/emulator/models/bxcan_parts.h"

enum {
    TXFP = 1 << 2, NART = 1 << 4,
    RQCP = 1 << 0, TXOK = 1 << 1, ALST = 1 << 2, TERR = 1 << 3, ABRQ = 1 << 7
};

static void end(struct bxcan *can, unsigned n, uint32_t status)
{
    struct bxcan_mailbox *box = &can->mailboxes[n];

    box->pending = box->aborting = false;
    box->status = RQCP | status;
    box->words[0] &= ~(uint32_t)BXCAN_TXRQ;
}

static struct frame frame_in(const struct bxcan_mailbox *box)
{
    uint32_t id = box->words[0];
    struct frame frame = {.id = id & BXCAN_IDE ? FRAME_EXTENDED | id >> 3 : id >> 21};
    uint32_t len = box->words[1] & 15u;

    frame.len = (uint8_t)(len < 8 ? len : 8);
    if (id & BXCAN_RTR)
        frame.id |= FRAME_REMOTE;
    for (unsigned i = 0; i < 8 && i < len; i++)
        frame.data[i] = (uint8_t)(box->words[2 + i / 4] >> 8 * (i % 4));
    return frame;
}

/* Priority: with TXFP by time of request, otherwise by identifier and then by mailbox number. */
static bool goes_before(const struct bxcan *can, unsigned a, unsigned b)
{
    const struct bxcan_mailbox *boxes = can->mailboxes;
    uint32_t id_a = boxes[a].words[0], id_b = boxes[b].words[0];

    if (can->mcr & TXFP)
        return boxes[a].request < boxes[b].request;
    return id_a < id_b || (id_a == id_b && a < b);
}

/* The pending mailbox in `mask` that is sent first, or last; -1 if there is none. */
static int pick(const struct bxcan *can, unsigned mask, bool last)
{
    int picked = -1;

    for (unsigned n = 0; n < BXCAN_MAILBOXES; n++)
        if (can->mailboxes[n].pending && mask >> n & 1u
            && (picked < 0 || goes_before(can, n, (unsigned)picked) != last))
            picked = (int)n;
    return picked;
}

bool bxcan_offer(struct can_node *node, struct frame *out)
{
    struct bxcan *can = (struct bxcan *)node;

    node->on_wire = pick(can, ~node->stuck_mailboxes, false);
    if (node->on_wire < 0)
        return false;
    *out = frame_in(&can->mailboxes[node->on_wire]);
    return true;
}

void bxcan_end(struct can_node *node, enum node_outcome outcome)
{
    static const uint32_t status[] = {TXOK, ALST, TERR};
    struct bxcan *can = (struct bxcan *)node;
    int n = node->on_wire;

    node->on_wire = -1;
    if (n >= 0 && (outcome == NODE_SENT || can->mcr & NART || can->mailboxes[n].aborting))
        end(can, (unsigned)n, status[outcome]);
}

uint32_t bxcan_read_tsr(const struct bxcan *can)
{
    int last = pick(can, 7, true);
    uint32_t status = 0, pending = 0, free_box = BXCAN_MAILBOXES;

    for (unsigned n = BXCAN_MAILBOXES; n-- > 0;) {
        status |= can->mailboxes[n].status << 8 * n;
        pending |= can->mailboxes[n].pending ? 1u << n : 0u;
        free_box = can->mailboxes[n].pending ? free_box : n;
    }
    status |= (free_box < BXCAN_MAILBOXES ? free_box : (uint32_t)last) << 24 | (~pending & 7u) << 26;
    return pending & (pending - 1) ? status | 1u << (29 + last) : status;   /* LOW needs several pending */
}

/* Aborts a request at once, unless its frame is on the wire: that transmission is completed. */
void bxcan_write_tsr(struct bxcan *can, uint32_t value)
{
    for (unsigned n = 0; n < BXCAN_MAILBOXES; n++) {
        struct bxcan_mailbox *box = &can->mailboxes[n];
        uint32_t written = value >> 8 * n & 0xFFu;

        box->status &= written & RQCP ? 0u : ~written;
        if (!(written & ABRQ) || !box->pending)
            continue;
        box->aborting = true;
        if ((int)n != can->node.on_wire && !(can->node.stuck_mailboxes >> n & 1u))
            end(can, n, 0);
    }
}

bool bxcan_write_mailbox(struct bxcan *can, uint32_t at, uint32_t value)
{
    unsigned n = at / 16;
    struct bxcan_mailbox *box = &can->mailboxes[n];

    if (box->pending)
        return node_refuse(&can->node, "CAN1 transmit mailbox %u was written while its frame is pending", n);
    box->words[at / 4 % 4] = value;
    if (at % 16 == 0 && value & BXCAN_TXRQ) {
        box->pending = true;
        box->status = 0;
        box->request = can->requests++;
    }
    return true;
}
