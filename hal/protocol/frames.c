#include "hal/protocol/wire.h"

#include "hal/protocol/e2e.h"

struct frame *frames_add(struct frames *frames, const struct wire *wire, uint32_t id_of_node_1, uint8_t len)
{
    struct frame *frame = &frames->first[frames->count++];

    *frame = (struct frame){.id = wire_id(wire, id_of_node_1), .len = len};
    return frame;
}

uint8_t frames_count_up(struct wire *wire, enum counted kind)
{
    uint8_t counter = wire->counters[kind];

    wire->counters[kind] = e2e_next(counter);
    return counter;
}
