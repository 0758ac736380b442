/* contract.h: what link.h promises, asked of the kind of link that the first argument names: fd, slcan, or socketcan [IFACE].
 * A part of the contract is a test program of its own. */
#ifndef OCTET_CONTRACT_H
#define OCTET_CONTRACT_H

#include "tests/test.h"
#include "rig.h"

enum { SOON_MS = 5000, WAIT_MS = 60, LATE_MS = 5000 };

bool is_pair(void);
        /* It has one far end, which a bus has not, and a queue of its own. */

bool is_interface(void);
        /* Of the network: it comes and goes. */

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
