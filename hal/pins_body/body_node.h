/* body_node.h: a body on pins whose brain is another node on the CAN bus: the other half of the wire. It tells what it senses, does
 * what the brain's last DRIVE says, and orders what its button says. */
#ifndef OCTET_BODY_NODE_H
#define OCTET_BODY_NODE_H

#include "firmware/io.h"

enum { BODY_NODE_OWNER = 255 };   /* its number as a sender of commands */

void body_node_order(const struct command *command);
        /* Sends a command until it is answered, in front of each tick's senses. Another one waits for that; a third takes its place. */

void body_node_drive(struct output *out);
        /* The brain's last DRIVE, or one at rest: it has said nothing for HAL_SILENCE_MS. */

#endif
