/* loader.h: what an image has to do with a boot loader that started it. alone.c is for an image without one. */
#ifndef OCTET_LOADER_H
#define OCTET_LOADER_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/can_body/port.h"

uint8_t loader_node(uint8_t built);
        /* The robot's number: as the boot loader has it, or as built. To be called before all else here. */

const char *loader_link(void);
        /* The link's name: the bus's bit rate as the boot loader has it, or nothing. */

void loader_alive(bool outage);
        /* As port_alive. */

uint16_t loader_id(void);
bool loader_frame(const struct frame *frame, bool at_rest, struct frame *answer);
        /* As port_id and port_frame. */

#endif
