/* body_node.h: a body on pins whose brain is another node on the CAN bus: the other half of the wire. It sends its
 * senses, follows the brain's last DRIVE, and turns button presses into commands. */
#ifndef OCTET_BODY_NODE_H
#define OCTET_BODY_NODE_H

#include "firmware/io.h"

enum { BODY_NODE_OWNER = 255 };   /* its owner ID as a sender of commands */

void body_node_order(const struct command *command);
        /* Sends a command before each tick's senses until it is answered. A second one waits; a third replaces it. */

void body_node_drive(struct output *out);
        /* The brain's last DRIVE, or rest if none came for HAL_SILENCE_MS. */

#endif
