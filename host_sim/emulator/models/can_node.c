#include "host_sim/emulator/models/can_node.h"

#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#define NEVER UINT64_MAX

enum {
    IDLE_NS = 11 * WIRE_BIT_NS,          /* 11 recessive bits: the bus is idle, and can be joined or left */
    RECOVERY_NS = 128 * IDLE_NS,
    BUS_OFF_COUNT = 256, PENALTY = 8, REC_AFTER_PASSIVE = 120
};

void node_open(struct can_node *node, const struct can_kind *kind, struct can_wire *wire)
{
    memset(node, 0, sizeof *node);
    node->kind = kind;
    node->wire = wire;
    wire->nodes[wire->node_count++] = node;
}

void node_reset(struct can_node *node, enum node_mode mode)
{
    node->mode = node->wanted = mode;
    node->mode_ns = node->recovery_ns = NEVER;
    node->tec = node->rec = node->last_error = 0;
    node->bus_off = false;
    node->on_wire = -1;
}

int64_t node_read(struct can_node *node, uint32_t offset)
{
    return node->kind->read(node, offset);
}

bool node_write(struct can_node *node, uint32_t offset, uint32_t value)
{
    return node->kind->write(node, offset, value);
}

bool node_refuse(struct can_node *node, const char *format, ...)
{
    va_list details;

    va_start(details, format);
    (void)vsnprintf(node->refusal, sizeof node->refusal, format, details);
    va_end(details);
    return false;
}

void node_ask_mode(struct can_node *node, enum node_mode wanted)
{
    if (wanted == node->wanted)
        return;
    node->wanted = wanted;
    node->mode_ns = wanted == NODE_INIT && node->init_stuck ? NEVER : node->wire->now_ns + IDLE_NS;
}

void node_recover(struct can_node *node)
{
    node->recovery_ns = node->recovery_stuck ? NEVER : node->wire->now_ns + RECOVERY_NS;
}

/* The bit rate must be within 0.5 % of the bus's. */
static void join(struct can_node *node)
{
    uint32_t rate = node->kind->bit_rate(node);

    if (rate > WIRE_BITRATE + WIRE_BITRATE / 200 || rate < WIRE_BITRATE - WIRE_BITRATE / 200)
        (void)node_refuse(node, "CAN was set up for %u bit/s, on a bus of %d", (unsigned)rate, WIRE_BITRATE);
    if (node->bus_off)   /* leaving init is how a driver asks for the end of bus-off */
        node_recover(node);
}

uint64_t node_advance(struct can_node *node)
{
    uint64_t now = node->wire->now_ns;
    bool blocked = node->wire->busy && node->wanted == NODE_NORMAL;

    node->kind->pass(node);
    if (node->mode_ns <= now && !blocked) {
        node->mode = node->wanted;
        node->mode_ns = NEVER;
        node->inits += node->mode == NODE_INIT;
        if (node->mode == NODE_NORMAL)
            join(node);
    }
    if (node->recovery_ns <= now) {
        node->recovery_ns = NEVER;
        node->tec = node->rec = node->last_error = 0;
        node->bus_off = false;
    }
    if (blocked)
        return node->recovery_ns;
    return node->mode_ns < node->recovery_ns ? node->mode_ns : node->recovery_ns;
}

bool node_is_passive(const struct can_node *node)
{
    return node->tec >= NODE_PASSIVE || node->rec >= NODE_PASSIVE;
}

bool node_listens(const struct can_node *node)
{
    return node->mode == NODE_NORMAL && !node->bus_off;
}

bool node_offer(struct can_node *node, struct frame *out)
{
    return node->kind->offer(node, out);
}

void node_lost_arbitration(struct can_node *node)
{
    node->kind->end(node, NODE_LOST_ARBITRATION);
}

void node_sent(struct can_node *node)
{
    node->tec -= node->tec > 0;
    node->last_error = 0;
    node->kind->end(node, NODE_SENT);
}

/* Missing acknowledgements take a node as far as error passive, and no further. */
void node_failed(struct can_node *node, enum node_error error)
{
    node->last_error = error;
    if (error != NODE_NO_ACKNOWLEDGE || !node_is_passive(node))
        node->tec += PENALTY;
    if (node->tec >= BUS_OFF_COUNT && !node->bus_off) {
        node->bus_off = true;
        node->kind->lose_bus(node);
    }
    node->kind->end(node, NODE_DESTROYED);
}

void node_arrived(struct can_node *node, const struct frame *frame, bool destroyed)
{
    if (destroyed) {
        node->rec++;
        return;
    }
    node->rec = node->rec >= NODE_PASSIVE ? REC_AFTER_PASSIVE : node->rec - (node->rec > 0);
    node->last_error = 0;
    node->kind->store(node, frame);
}
