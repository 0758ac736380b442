#include "hal/library/exchange.h"

#include <stdlib.h>

void octet_init(struct octet *octet, uint8_t node, const uint8_t memory[CELL_COUNT])
{
    octet->respond = robot_respond;
    octet->size = sizeof *octet;
    robot_init(&octet->robot, 0);
    (void)brain_adopt(&octet->robot.brain, memory);
    wire_init(&octet->wire, node);
    octet->wire.health.clock_exact = true;
    wire_boot(&octet->wire, octet->answers);   /* before anything listens */
}

struct octet *octet_open(uint8_t node, const uint8_t memory[CELL_COUNT])
{
    struct octet *octet = malloc(sizeof *octet);

    if (octet)
        octet_init(octet, node, memory);
    return octet;
}

static size_t say_again(struct octet *octet)
{
    if (!octet->wire.again)
        return 0;
    octet->answers[0] = *octet->wire.again;
    return 1;
}

size_t octet_exchange(struct octet *octet, const struct frame *in)
{
    struct input input;
    struct output output;
    enum input_kind kind = wire_read(&octet->wire, in, &input);

    if (kind == INPUT_SILENCE)
        return say_again(octet);
    octet->respond(&octet->robot, kind, &input, &output);
    return wire_write(&octet->wire, &output, octet->answers);
}

void octet_outage(struct octet *octet)
{
    wire_outage(&octet->wire);
}

const struct frame *octet_answers(const struct octet *octet)
{
    return octet->answers;
}

size_t octet_size(const struct octet *octet)
{
    return octet->size;
}

void octet_close(struct octet *octet)
{
    free(octet);
}
