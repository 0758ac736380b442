#include "hal/boot/server.h"

#include <string.h>

#include "tests/test.h"

#include "tester.h"

enum { NODE = 3, REQUEST = 0x6E0 + NODE, ANSWER = 0x060 + NODE, NOW_MS = 50 };

static struct server server;
static struct frame said[8];
static unsigned said_count;
static int link_result;

int link_send(struct link *link, const struct frame *frame)
{
    (void)link;
    if (link_result == 0)
        said[said_count++ % 8] = *frame;
    return link_result;
}

void setUp(void)
{
    boot_flash_clear();
    tester_power_on();
    said_count = 0;
    link_result = 0;
    server_begin(&server, &choices, NODE, NOW_MS);
}

static void hear(uint32_t id, const uint8_t data[8])
{
    struct frame frame = {.id = id, .len = 8};

    memcpy(frame.data, data, 8);
    server_take(&server, &frame, NOW_MS);
    server_send(&server, NULL, NOW_MS);
}

TEST(a_request_to_this_node_is_answered)
{
    hear(REQUEST, (const uint8_t[8]){2, 0x3E, 0});
    TEST_ASSERT_EQUAL_UINT(1, said_count);
    TEST_ASSERT_EQUAL_HEX32(ANSWER, said[0].id);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){2, 0x7E, 0, 0xCC}), said[0].data, 4);
}

TEST(other_frames_are_not)
{
    hear(REQUEST + 1, (const uint8_t[8]){2, 0x3E, 0});
    hear(ANSWER, (const uint8_t[8]){2, 0x3E, 0});
    hear(REQUEST | FRAME_EXTENDED, (const uint8_t[8]){2, 0x3E, 0});
    hear(REQUEST | FRAME_REMOTE, (const uint8_t[8]){2, 0x3E, 0});
    hear(REQUEST, (const uint8_t[8]){2, 0x3E, 0x80});
    TEST_ASSERT_EQUAL_UINT(0, said_count);
}

TEST(what_a_full_bus_does_not_take_is_sent_later)
{
    link_result = LINK_E_FULL;
    hear(REQUEST, (const uint8_t[8]){2, 0x3E, 0});
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS));
    link_result = 0;
    server_send(&server, NULL, NOW_MS);
    TEST_ASSERT_EQUAL_UINT(1, said_count);
}

TEST(a_tester_that_is_present_interrupts_no_answer)
{
    hear(REQUEST, (const uint8_t[8]){3, 0x22, 0xFD, 0});
    hear(REQUEST, (const uint8_t[8]){2, 0x3E, 0x80});
    TEST_ASSERT_EQUAL_UINT(1, said_count);
    hear(REQUEST, (const uint8_t[8]){0x30, 0, 0});
    TEST_ASSERT_EQUAL_HEX8(0x21, said[1].data[0]);
}

TEST(a_programming_session_that_an_image_was_asked_for_is_answered_by_the_boot_loader)
{
    server_programming(&server);
    server_send(&server, NULL, NOW_MS);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){6, 0x50, 2}), said[0].data, 3);
    TEST_ASSERT_TRUE(server.uds.programming);
}

TEST(it_restarts_once_the_answer_to_that_has_left)
{
    hear(REQUEST, (const uint8_t[8]){2, 0x11, 1});
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){2, 0x51, 1}), said[0].data, 3);
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS));
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS + SERVER_LAST_MS - 1));
    TEST_ASSERT_FALSE(server_work(&server, NOW_MS + SERVER_LAST_MS));
}

TEST(with_an_image_it_leaves_when_nobody_is_there)
{
    choices.now.installed = 1;
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS + SERVER_IDLE_MS - 1));
    TEST_ASSERT_FALSE(server.leaving);
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS + SERVER_IDLE_MS));
    TEST_ASSERT_FALSE(server_work(&server, NOW_MS + SERVER_IDLE_MS + SERVER_LAST_MS));
}

TEST(without_an_image_it_stays)
{
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS + SERVER_IDLE_MS));
    TEST_ASSERT_FALSE(server.leaving);
}

TEST(long_work_is_done_in_steps_and_answered_at_its_end)
{
    struct signed_image image = signer_image(0, 1);
    unsigned steps = 0;

    server.uds.programming = server.uds.unlocked = true;
    memcpy(server.isotp.rx, (const uint8_t[]){0x31, 1, 0xFF, 0, 0, 0, 0, 0}, 8);
    memcpy(&server.isotp.rx[8], image.bytes, IMAGE_HEADER);
    server.isotp.rx_len = 8 + IMAGE_HEADER;
    server.isotp.rx_at = 71;
    server.isotp.rx_number = 5;
    server.isotp.rx_ms = NOW_MS;
    hear(REQUEST, (const uint8_t[8]){0x25, image.bytes[63]});
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){3, 0x7F, 0x31, 0x78}), said[0].data, 4);
    while (said_count == 1 && steps++ < 20) {
        TEST_ASSERT_TRUE(server_work(&server, NOW_MS));
        server_send(&server, NULL, NOW_MS);
    }
    TEST_ASSERT_EQUAL_UINT(SLOT_PAGES, steps);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){5, 0x71, 1, 0xFF, 0, 0}), said[1].data, 6);
}

TEST(a_session_ends_although_a_request_was_never_completed)
{
    server.uds.programming = true;
    hear(REQUEST, (const uint8_t[8]){0x10, 20, 0x36, 1});
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS + ISOTP_TIMEOUT_MS));
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS + ISOTP_TIMEOUT_MS + UDS_SESSION_MS - 1));
    TEST_ASSERT_TRUE(server.uds.programming);
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS + ISOTP_TIMEOUT_MS + UDS_SESSION_MS));
    TEST_ASSERT_FALSE(server.uds.programming);
}

TEST(it_does_not_rest_while_more_of_a_block_can_be_written)
{
    server.uds.programming = server.uds.unlocked = server.uds.loading = true;
    server.uds.slot = 1;
    server.uds.number = 1;
    server.uds.image.size = 2 * PAGE;
    TEST_ASSERT_FALSE(server.hurries);
    hear(REQUEST, (const uint8_t[8]){0x10, 20, 0x36, 1, 'O', 'C', 'T', 'E'});
    TEST_ASSERT_TRUE(server.hurries);
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS));
    TEST_ASSERT_EQUAL_MEMORY("OCTE\xFF", boot_flash_slot(1), 5);
    TEST_ASSERT_TRUE(server.hurries);
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS));
    TEST_ASSERT_FALSE(server.hurries);
}

TEST(nothing_more_is_written_of_a_block_that_was_never_completed)
{
    server.uds.programming = server.uds.unlocked = server.uds.loading = true;
    server.uds.slot = 1;
    server.uds.number = 1;
    server.uds.image.size = 2 * PAGE;
    hear(REQUEST, (const uint8_t[8]){0x10, 20, 0x36, 1, 'O', 'C', 'T', 'E'});
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS + ISOTP_TIMEOUT_MS + 1));
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, boot_flash_slot(1), 8);
}

TEST(a_request_counts_as_one_when_it_came)
{
    server.uds.asked_ms = 0;
    hear(REQUEST, (const uint8_t[8]){2, 0x3E, 0});
    TEST_ASSERT_EQUAL_UINT32(NOW_MS, server.uds.asked_ms);
}

TEST(late_is_not_too_late_to_leave)
{
    choices.now.installed = 1;
    TEST_ASSERT_TRUE(server_work(&server, NOW_MS + SERVER_IDLE_MS + 1));
    TEST_ASSERT_TRUE(server.leaving);
    TEST_ASSERT_FALSE(server_work(&server, NOW_MS + SERVER_IDLE_MS + SERVER_LAST_MS + 2));
}
