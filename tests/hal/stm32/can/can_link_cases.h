/* can_link_cases.h: what the tests of the link over a CAN controller have in common. */
#ifndef OCTET_CAN_LINK_CASES_H
#define OCTET_CAN_LINK_CASES_H

#include "tests/test.h"
#include "can_rig.h"

enum { WAIT_MS = 20, RECOVERY_MS = 250, DRIVE = 0x041, ANSWER = 0x141, MEMORY = 0x681, HEARTBEAT = 0x6A1, HEALTH = 0x7C1 };

extern const uint16_t WANTED[2];   /* identifiers that it listens for */
extern struct link *link_here;

struct frame numbered(uint32_t id, uint8_t number);
        /* A frame with a number in its first byte. */

int open_link(void);
        /* Opens the link for two identifiers; as link_open. */

void assert_frame(const struct frame *expected, const struct frame *actual);

int try_to_send(uint32_t id, uint8_t number);
        /* As link_send. */

void send_numbered(uint32_t id, uint8_t number);

void assert_receives(const struct frame *expected);
        /* The next frame that comes. */

void wait_ms(uint32_t ms);
        /* The link is given time to send; nothing comes meanwhile. */

void assert_sent(unsigned n, uint32_t id, uint8_t number);
        /* The n-th frame on the bus. */

struct link_health health_now(void);

unsigned fill_up(void);
        /* Sends until no more is taken; returns how many were. */

#endif
