#include "host_sim/emulator/models/can_wire.h"

#include <string.h>

#include "host_sim/emulator/models/can_node.h"

enum {
    STANDARD_BITS = 47,   /* of a frame without data, with the intermission after it */
    EXTENDED_BITS = 67,
    ERROR_BITS = 40       /* of a frame destroyed early, with error flags and intermission */
};

static bool push(struct frame_queue *queue, const struct frame *frame)
{
    if (queue->count == WIRE_QUEUE_MAX)
        return false;
    queue->frames[(queue->first + queue->count++) % WIRE_QUEUE_MAX] = *frame;
    return true;
}

static bool pop(struct frame_queue *queue, struct frame *out)
{
    if (queue->count == 0)
        return false;
    *out = queue->frames[queue->first];
    queue->first = (queue->first + 1) % WIRE_QUEUE_MAX;
    queue->count--;
    return true;
}

static uint64_t bits(const struct frame *frame)
{
    unsigned fixed = frame->id & FRAME_EXTENDED ? EXTENDED_BITS : STANDARD_BITS;
    unsigned bytes = frame->len < 8 ? frame->len : 8;

    return frame->id & FRAME_REMOTE ? fixed : fixed + 8 * bytes;
}

/* The arbitration field, bit by bit: base identifier, IDE, identifier extension, RTR. The lowest wins. */
static uint32_t priority(const struct frame *frame)
{
    uint32_t remote = frame->id & FRAME_REMOTE ? 1 : 0;
    uint32_t id = frame->id & 0x1FFFFFFFu;

    if (frame->id & FRAME_EXTENDED)
        return id >> 18 << 20 | 1u << 19 | (id & 0x3FFFFu) << 1 | remote;
    return id << 20 | remote;
}

void wire_open(struct can_wire *wire)
{
    memset(wire, 0, sizeof *wire);
    wire->sender = WIRE_IDLE;
}

bool wire_put(struct can_wire *wire, const struct frame *frame)
{
    return push(&wire->waiting, frame);
}

bool wire_fetch(struct can_wire *wire, struct frame *out)
{
    return pop(&wire->heard, out);
}

/* Delivers the frame to each active controller but the sender. Returns the number of receivers. */
static unsigned deliver(struct can_wire *wire, bool destroyed)
{
    unsigned listeners = 0;

    for (unsigned n = 0; n < wire->node_count; n++)
        if ((int)n != wire->sender && node_listens(wire->nodes[n])) {
            listeners++;
            node_arrived(wire->nodes[n], &wire->passing, destroyed);
        }
    return listeners;
}

static void finish(struct can_wire *wire)
{
    unsigned listeners = deliver(wire, wire->shorted && wire->sender != WIRE_WORLD);

    if (wire->sender != WIRE_WORLD) {
        struct can_node *sender = wire->nodes[wire->sender];

        if (wire->shorted)
            node_failed(sender, NODE_BIT_DOMINANT);
        else if (wire->alone && listeners == 0)
            node_failed(sender, NODE_NO_ACKNOWLEDGE);
        else
            node_sent(sender);
        if (!wire->shorted && !wire->alone)
            (void)push(&wire->heard, &wire->passing);
    }
    wire->sender = WIRE_IDLE;
}

/* Puts the first frame of the world on the wire if a controller listens. */
static void begin_world(struct can_wire *wire, bool listened)
{
    if (wire->shorted && listened)
        wire->waiting.count = 0;
    if (listened && wire->waiting.count > 0) {
        wire->passing = wire->waiting.frames[wire->waiting.first];
        wire->sender = WIRE_WORLD;
    }
}

/* A controller with a frame of higher priority takes the wire from the node that had it. */
static void arbitrate(struct can_wire *wire)
{
    struct frame offer;

    for (unsigned n = 0; n < wire->node_count; n++) {
        if (!node_listens(wire->nodes[n]) || !node_offer(wire->nodes[n], &offer))
            continue;
        if (wire->sender != WIRE_IDLE && priority(&offer) >= priority(&wire->passing)) {
            node_lost_arbitration(wire->nodes[n]);
            continue;
        }
        if (wire->sender >= 0)
            node_lost_arbitration(wire->nodes[wire->sender]);
        wire->passing = offer;
        wire->sender = (int)n;
    }
}

static void begin(struct can_wire *wire)
{
    bool listened = false;
    struct frame taken;

    for (unsigned n = 0; n < wire->node_count; n++)
        listened = listened || node_listens(wire->nodes[n]);
    begin_world(wire, listened);
    arbitrate(wire);
    if (wire->sender == WIRE_WORLD)
        (void)pop(&wire->waiting, &taken);
    wire->ends_ns = wire->now_ns + WIRE_BIT_NS * (wire->shorted ? ERROR_BITS : bits(&wire->passing));
}

uint64_t wire_advance(struct can_wire *wire, uint64_t now_ns)
{
    uint64_t next = UINT64_MAX;

    wire->now_ns = now_ns;
    if (wire->sender != WIRE_IDLE && wire->ends_ns <= now_ns)
        finish(wire);
    for (unsigned n = 0; n < wire->node_count; n++) {
        uint64_t due = node_advance(wire->nodes[n]);

        next = due < next ? due : next;
    }
    if (wire->sender == WIRE_IDLE && !wire->busy)
        begin(wire);
    return wire->sender != WIRE_IDLE && wire->ends_ns < next ? wire->ends_ns : next;
}
