/* open_listening.h: opening a link, and what it says of that on stderr. */
#ifndef OCTET_OPEN_LISTENING_H
#define OCTET_OPEN_LISTENING_H

#include <limits.h>

#include "hal/link/link.h"

enum { PRINTED_MAX = 2 * PATH_MAX };

extern char printed[PRINTED_MAX];   /* by the last open */

int open_listening(struct link **link, const char *name, size_t id_count);
        /* As link_open, for so many identifiers. */

int open_descriptors(void);
        /* How many there are. */

#endif
