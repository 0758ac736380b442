/* handover.h: a request that a program leaves in RAM for the one that runs after a reset, in a place that each chip
 * reserves for it. */
#ifndef OCTET_HANDOVER_H
#define OCTET_HANDOVER_H

#include <stdbool.h>

void handover_ask(void);
        /* Asks the boot loader to stay, in a programming session. */

bool handover_take(void);
        /* Whether that was asked; clears the request. */

#endif
