/* telemetry.h: how a robot of its own talks, if it talks at all. Exactly one implementation is linked in: over CAN
 * (can_telemetry.c), or not at all (no_telemetry.c); or, as a body whose brain is another node, with that (body_node.c). Nothing here waits. */
#ifndef OCTET_TELEMETRY_H
#define OCTET_TELEMETRY_H

#include "hal/hal.h"

struct port;

int telemetry_open(const struct port *port);
        /* Returns 0, or HAL_E_BODY. */

enum input_kind telemetry_receive(struct input *in);
        /* What has come from outside: INPUT_COMMAND, INPUT_PEER, or INPUT_SILENCE for nothing. */

void telemetry_senses(const struct senses *senses);
        /* Tells what the robot senses, before the output that answers it. */

bool telemetry_wants_ranges(void);
        /* Whether senses are to have distances. */

void telemetry_output(const struct output *out, bool asked);
        /* Tells what the robot does. asked: its answer is one to a command from outside. */

#endif
