/* can_link_cases.h: what the tests of the link over a CAN controller have in common. */
#ifndef OCTET_CAN_LINK_CASES_H
#define OCTET_CAN_LINK_CASES_H

#include <string.h>

#include "tests/test.h"
#include CAN_RIG

enum { WAIT_MS = 20, RECOVERY_MS = 250, DRIVE = 0x041, ANSWER = 0x141, MEMORY = 0x681, HEARTBEAT = 0x6A1, HEALTH = 0x7C1 };

static const uint16_t WANTED[2] = {0x0C1, 0x041};   /* identifiers that it listens for */
static struct link *link_here;

/* A frame with a number in its first byte. */
static inline struct frame numbered(uint32_t id, uint8_t number)
{
    return (struct frame){.id = id, .len = 8, .data = {number, 1, 2, 3, 4, 5, 6, 0xF7}};
}

/* Opens the link for two identifiers; as link_open. */
static inline int open_link(void)
{
    return link_open(&link_here, "", WANTED, 2);
}

static inline void assert_frame(const struct frame *expected, const struct frame *actual)
{
    TEST_ASSERT_EQUAL_HEX32(expected->id, actual->id);
    TEST_ASSERT_EQUAL_UINT8(expected->len, actual->len);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected->data, actual->data, 8);
}

/* As link_send. */
static inline int try_to_send(uint32_t id, uint8_t number)
{
    struct frame frame = numbered(id, number);

    return link_send(link_here, &frame);
}

static inline void send_numbered(uint32_t id, uint8_t number)
{
    TEST_ASSERT_EQUAL(0, try_to_send(id, number));
}

/* The next frame that comes. */
static inline void assert_receives(const struct frame *expected)
{
    struct frame frame;

    memset(&frame, 0xEE, sizeof frame);
    TEST_ASSERT_EQUAL(1, link_receive(link_here, &frame, WAIT_MS));
    assert_frame(expected, &frame);
}

/* The link is given time to send; nothing comes meanwhile. */
static inline void wait_ms(uint32_t ms)
{
    struct frame frame;

    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, ms));
}

/* The n-th frame on the bus. */
static inline void assert_sent(unsigned n, uint32_t id, uint8_t number)
{
    TEST_ASSERT_LESS_THAN_UINT(rig_sent_count(), n);
    TEST_ASSERT_EQUAL_HEX32(id, rig_sent(n)->id);
    TEST_ASSERT_EQUAL_UINT8(number, rig_sent(n)->data[0]);
}

static inline struct link_health health_now(void)
{
    struct link_health health;

    link_health(link_here, &health);
    return health;
}

/* Sends until no more is taken; returns how many were. */
static inline unsigned fill_up(void)
{
    unsigned count = 0;

    while (try_to_send(HEARTBEAT, (uint8_t)count) == 0)
        TEST_ASSERT_LESS_THAN_UINT(100, ++count);
    return count;
}

#endif
