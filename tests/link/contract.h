/* contract.h: what link.h promises, asked of the kind of link that the first argument names: fd, slcan, or socketcan [IFACE].
 * A part of the contract is a test program of its own. */
#ifndef OCTET_CONTRACT_H
#define OCTET_CONTRACT_H

#include <unity.h>

#include "rig.h"

enum { SOON_MS = 5000, WAIT_MS = 60, LATE_MS = 5000 };

/* The tests of a part. The last two may be null. */
struct contract {
    void (*for_all)(void);
    void (*for_pairs)(void);                          /* a pair has one far end, which a bus has not, and a queue of its own */
    void (*for_interfaces)(const char *interface);    /* of the network, which come and go */
};

extern const struct contract CONTRACT;   /* to be defined by the part */

extern const struct frame HELLO;   /* a frame that the near end listens for, as it does for 0x100 to 0x104 */
extern const struct rig *rig;
extern struct link *near;

void open_near(void);
void close_near(void);

int64_t now_ms(void);

void assert_equal(const struct frame *expected, const struct frame *frame);

void assert_receives(const struct frame *expected);
        /* The near end, soon. */

void assert_far_takes(const struct frame *expected);

void assert_silent_for(uint32_t wait_ms);
        /* The near end receives nothing for that long. */

#endif
