/* e2e.h: the protection of every message, as in AUTOSAR E2E profile 1: a CRC in byte 0, an alive counter in the low
 * half of byte 1. The Data ID is the CAN identifier. */
#ifndef OCTET_E2E_H
#define OCTET_E2E_H

#include <stdbool.h>

#include "hal/link/link.h"

enum { E2E_COUNTERS = 15 };   /* counters are 0..14 */

void e2e_protect(struct frame *frame);
        /* Fills in the CRC, byte 0, of an otherwise complete frame. len is 2..8. */

bool e2e_is_whole(const struct frame *frame, uint8_t len);
        /* Whether the frame has this length, the right CRC and a valid counter. */

uint8_t e2e_counter(const struct frame *frame);
        /* The alive counter: 0..14 in a valid frame. */

uint8_t e2e_next(uint8_t counter);
        /* The counter after this one; 0 follows 14. */

unsigned e2e_ahead(uint8_t from, uint8_t to);
        /* How many steps lead from one counter to the other, 0..14. */

#endif
