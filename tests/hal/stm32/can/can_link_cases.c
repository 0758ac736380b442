#include "can_link_cases.h"

#include <string.h>

const uint16_t WANTED[2] = {0x0C1, 0x041};
struct link *link_here;

struct frame numbered(uint32_t id, uint8_t number)
{
    return (struct frame){.id = id, .len = 8, .data = {number, 1, 2, 3, 4, 5, 6, 0xF7}};
}

int open_link(void)
{
    return link_open(&link_here, "", WANTED, 2);
}

void assert_frame(const struct frame *expected, const struct frame *actual)
{
    TEST_ASSERT_EQUAL_HEX32(expected->id, actual->id);
    TEST_ASSERT_EQUAL_UINT8(expected->len, actual->len);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected->data, actual->data, 8);
}

int try_to_send(uint32_t id, uint8_t number)
{
    struct frame frame = numbered(id, number);

    return link_send(link_here, &frame);
}

void send_numbered(uint32_t id, uint8_t number)
{
    TEST_ASSERT_EQUAL(0, try_to_send(id, number));
}

void assert_receives(const struct frame *expected)
{
    struct frame frame;

    memset(&frame, 0xEE, sizeof frame);
    TEST_ASSERT_EQUAL(1, link_receive(link_here, &frame, WAIT_MS));
    assert_frame(expected, &frame);
}

void wait_ms(uint32_t ms)
{
    struct frame frame;

    TEST_ASSERT_EQUAL(0, link_receive(link_here, &frame, ms));
}

void assert_sent(unsigned n, uint32_t id, uint8_t number)
{
    TEST_ASSERT_LESS_THAN_UINT(rig_sent_count(), n);
    TEST_ASSERT_EQUAL_HEX32(id, rig_sent(n)->id);
    TEST_ASSERT_EQUAL_UINT8(number, rig_sent(n)->data[0]);
}

struct link_health health_now(void)
{
    struct link_health health;

    link_health(link_here, &health);
    return health;
}

unsigned fill_up(void)
{
    unsigned count = 0;

    while (try_to_send(HEARTBEAT, (uint8_t)count) == 0)
        TEST_ASSERT_LESS_THAN_UINT(100, ++count);
    return count;
}
