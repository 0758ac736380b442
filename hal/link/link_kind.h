/* link_kind.h: what each kind of link on the host provides. link_by_name.c chooses one and calls through it. */
#ifndef OCTET_LINK_KIND_H
#define OCTET_LINK_KIND_H

#include <stdbool.h>
#include <stdint.h>

#include "hal/link/link.h"

struct link {
    const struct link_kind *kind;
};

struct link_request {
    const char *place;      /* the name after the colon, never empty */
    const uint16_t *ids;
    size_t id_count;        /* 0..LINK_IDS_MAX */
    const char *why;        /* filled where opening fails: the reason */
};

struct link_kind {
    const char *prefix;     /* of its names, with the colon */
    int (*open)(struct link **link, struct link_request *request);
    int (*receive)(struct link *link, struct frame *out, uint32_t wait_ms);
    int (*send)(struct link *link, const struct frame *frame);
    void (*close)(struct link *link);   /* never of a null link: gives back all that open took */
};      /* Contracts as in link.h. Each kind's own struct begins with its struct link. */

extern const struct link_kind LINK_KIND_SOCKETCAN, LINK_KIND_FD, LINK_KIND_SLCAN;

/* Waits with a deadline that signals do not extend. */

int64_t deadline_in_ms(uint32_t ms);
        /* The deadline that far from now, ns of the monotonic clock. */

uint32_t deadline_left_ms(int64_t deadline);
        /* Time left, rounded up; 0: the deadline has passed. */

bool deadline_await_input(int fd, int64_t deadline);
        /* Waits until fd is readable or has an error: true. False: the deadline came first. */

bool deadline_pause(int64_t deadline);
        /* Sleeps for a millisecond, or less if a signal comes. False, without sleeping: the deadline has passed. */

#endif
