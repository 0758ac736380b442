/* telemetry.h: how a body on pins communicates. Exactly one implementation is linked in: over CAN (can_telemetry.c),
 * not at all (no_telemetry.c), or with a brain on another node (body_node.c). Nothing here waits. */
#ifndef OCTET_TELEMETRY_H
#define OCTET_TELEMETRY_H

#include "hal/hal.h"

struct port;

int telemetry_open(const struct port *port);
        /* Returns 0, or HAL_E_BODY. */

enum input_kind telemetry_receive(struct input *in);
        /* The next input from outside: INPUT_COMMAND, INPUT_PEER, or INPUT_SILENCE for none. */

void telemetry_senses(const struct senses *senses);
        /* Sends the senses, before the output that answers them. */

bool telemetry_wants_ranges(void);
        /* Whether the senses should include distances. */

void telemetry_stored(int result);
        /* Notes the result of storing the memory, or of a failure to load it: 0, PORT_LATER or HAL_E_STORE. */

void telemetry_output(const struct output *out, bool asked);
        /* Sends the robot's output. asked: it answers a command from outside. */

#endif
