/* rig.h: one kind of link, its far end in the test's hands. One at a time. */
#ifndef OCTET_RIG_H
#define OCTET_RIG_H

#include <stdbool.h>

#include "hal/link/link.h"

enum { RIG_NAME_MAX = 64 };

struct rig {
    const char *kind;
    bool filters;                                /* unwanted identifiers do not arrive */
    void (*open)(char name[RIG_NAME_MAX]);       /* makes the far end; fills in the near end's name */
    void (*put)(const struct frame *frame);      /* the far end sends */
    bool (*take)(struct frame *frame);           /* the far end receives; false: nothing for a while */
    void (*put_garbage)(void);                   /* the far end sends one thing that is no frame; null: it cannot */
    void (*close)(void);                         /* the far end goes away; again is fine */
};

extern const struct rig RIG_FD, RIG_SOCKETCAN, RIG_SLCAN;

void rig_socketcan_choose(const char *interface);
        /* The interface that RIG_SOCKETCAN opens from now on; vcan0 without it. */

#endif
