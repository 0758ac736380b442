/* link.h, about frames: they arrive as they were, in their order, and what is not wanted is filtered where that is possible. */
#include <string.h>

#include "contract.h"

TEST(a_frame_from_the_far_end_arrives_as_it_was)
{
    rig->put(&HELLO);

    assert_receives(&HELLO);
}

TEST(a_frame_to_the_far_end_arrives_as_it_was)
{
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));

    assert_far_takes(&HELLO);
}

TEST(what_is_sent_does_not_come_back)
{
    TEST_ASSERT_EQUAL_INT(0, link_send(near, &HELLO));

    assert_silent_for(WAIT_MS);
}

TEST(every_length_passes_both_ways)
{
    for (uint8_t len = 0; len <= 8; len++) {
        struct frame frame = {.id = 0x123, .len = len};
        memset(frame.data, 0xF0 + len, len);
        rig->put(&frame);
        assert_receives(&frame);
        TEST_ASSERT_EQUAL_INT(0, link_send(near, &frame));
        assert_far_takes(&frame);
    }
}

TEST(frames_keep_their_order)
{
    for (uint16_t i = 0; i < 5; i++) rig->put(&(struct frame){.id = 0x100u + i});

    for (uint16_t i = 0; i < 5; i++) assert_receives(&(struct frame){.id = 0x100u + i});
}

TEST_IF(garbage_counts_once_and_the_next_frame_arrives, is_pair)
{
    struct frame frame;
    rig->put_garbage();
    rig->put(&HELLO);

    TEST_ASSERT_EQUAL_INT(LINK_E_GARBLED, link_receive(near, &frame, SOON_MS));
    assert_receives(&HELLO);
    assert_silent_for(0);
}

/* Where nothing filters, all arrives, with its flags. */
static void assert_unwanted(const struct frame *frame)
{
    rig->put(frame);
    rig->put(&HELLO);
    if (!rig->filters) assert_receives(frame);
    assert_receives(&HELLO);
    assert_silent_for(0);
}

TEST(other_identifiers_are_filtered_where_that_is_possible)
{
    assert_unwanted(&(struct frame){.id = 0x122});
    assert_unwanted(&(struct frame){.id = 0x000});
    assert_unwanted(&(struct frame){.id = 0x7FF});
}

TEST(extended_and_remote_frames_are_filtered_where_that_is_possible)
{
    assert_unwanted(&(struct frame){.id = 0x123 | FRAME_EXTENDED});
    assert_unwanted(&(struct frame){.id = 0x123 | FRAME_REMOTE});
    assert_unwanted(&(struct frame){.id = 0x1FFFF123 | FRAME_EXTENDED | FRAME_REMOTE, .len = 2});
}

TEST(extended_and_remote_frames_can_be_sent)
{
    const struct frame frames[] = {{.id = 0x123 | FRAME_EXTENDED}, {.id = 0x123 | FRAME_REMOTE, .len = 3}};
    for (int i = 0; i < 2; i++) {
        TEST_ASSERT_EQUAL_INT(0, link_send(near, &frames[i]));
        assert_far_takes(&frames[i]);
    }
}
