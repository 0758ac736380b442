/* handover.h: what a program leaves in the RAM for the one that runs after a reset. Each chip has a place that neither the boot
 * loader nor an image uses for anything else. */
#ifndef OCTET_HANDOVER_H
#define OCTET_HANDOVER_H

#include <stdbool.h>

void handover_ask(void);
        /* The boot loader is to stay, in a programming session. */

bool handover_take(void);
        /* Whether that was asked, once. */

#endif
