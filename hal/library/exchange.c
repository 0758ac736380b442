#include "hal/library/exchange.h"

#include <stdlib.h>

struct session *session_open(uint8_t node, const uint8_t memory[CELL_COUNT])
{
    struct session *session = malloc(sizeof *session);

    if (!session)
        return NULL;
    robot_init(&session->robot, 0);
    (void)memory_adopt(&session->robot.brain.memory, memory);
    wire_init(&session->wire, node);
    return session;
}

size_t session_exchange(struct session *session, const struct frame *in, struct frame out[WIRE_FRAMES_MAX])
{
    struct input input;
    struct output output;
    enum input_kind kind = wire_read(&session->wire, in, &input);

    if (kind == INPUT_SILENCE)
        return 0;
    robot_respond(&session->robot, kind, &input, &output);
    return wire_write(&session->wire, &output, out);
}

void session_close(struct session *session)
{
    free(session);
}
