/* loader.h: an image's interface to the boot loader that started it. alone.c is for an image without one. */
#ifndef OCTET_LOADER_H
#define OCTET_LOADER_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/can_body/port.h"

uint8_t loader_node(uint8_t built);
        /* The robot's node number, from the boot loader or as built. Call before the other functions here. */

const char *loader_link(void);
        /* The link's name: the bit rate from the boot loader, or empty. */

void loader_alive(bool outage);
        /* As port_alive. */

uint16_t loader_id(void);
bool loader_frame(const struct frame *frame, bool at_rest, struct frame *answer);
        /* As port_id and port_frame. */

#endif
