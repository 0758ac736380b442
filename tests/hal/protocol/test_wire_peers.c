#include "hal/protocol/wire.h"
#include "tests/test.h"
#include "wire_frames.h"

#include "reading_rig.h"

static void assert_peer(bool upper, uint8_t first)
{
    const uint8_t expected[] = {first, 1, 2, 1};

    TEST_ASSERT_EQUAL(upper, in.peer.upper);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, in.peer.cell, CELL_COUNT / 2);
}

TEST(every_other_robots_memory_is_heard)
{
    for (uint8_t node = 2; node <= NODE_MAX; node++) {
        TEST_ASSERT_EQUAL(INPUT_PEER, hear(memory_frame(node, 0, 0)));
        assert_peer(false, 0);
        TEST_ASSERT_EQUAL(INPUT_PEER, hear(memory_frame(node, 1, 2)));
        assert_peer(true, 2);
    }
}

TEST(a_memory_is_heard_once_from_report_to_report)
{
    TEST_ASSERT_EQUAL(INPUT_PEER, hear(memory_frame(2, 0, 0)));
    TEST_ASSERT_EQUAL(INPUT_PEER, hear(memory_frame(2, 1, 0)));
    refuse(memory_frame(2, 0, 0));
    refuse(memory_frame(2, 1, 0));
    respond((struct output){.has_drive = true});
    refuse(memory_frame(2, 0, 0));
    respond((struct output){.has_drive = true, .has_report = true});
    TEST_ASSERT_EQUAL(INPUT_PEER, hear(memory_frame(2, 0, 0)));
    TEST_ASSERT_EQUAL(INPUT_PEER, hear(memory_frame(2, 1, 0)));
}

TEST(a_memory_is_heard_again_after_a_start)
{
    TEST_ASSERT_EQUAL(INPUT_PEER, hear(memory_frame(2, 0, 0)));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_frame((struct octet_command_t){.counter = 1, .opcode = OPCODE_START})));
    respond((struct output){.has_answer = true});
    TEST_ASSERT_EQUAL(INPUT_PEER, hear(memory_frame(2, 0, 0)));
}

TEST(the_last_robot_hears_all_others_again_after_a_report)
{
    wire_init(&wire, NODE_MAX);
    for (unsigned reports = 0; reports < 2; reports++) {
        for (uint8_t node = 1; node < NODE_MAX; node++)
            TEST_ASSERT_EQUAL(INPUT_PEER, hear(memory_frame(node, 0, 0)));
        respond((struct output){.has_drive = true, .has_report = true});
    }
}

TEST(a_memory_is_heard_whatever_its_number)
{
    for (uint8_t counter = 0; counter < E2E_COUNTERS; counter++) {
        struct frame lower = memory_frame(counter + 2u, 0, 0), upper = memory_frame(counter + 2u, 1, 0);

        lower.data[1] |= counter;
        upper.data[1] |= counter;
        TEST_ASSERT_EQUAL(INPUT_PEER, hear(protected_frame(lower)));
        assert_peer(false, 0);
        TEST_ASSERT_EQUAL(INPUT_PEER, hear(protected_frame(upper)));
        assert_peer(true, 0);
    }
}

TEST(a_memory_of_all_sensors_is_not_heard)
{
    refuse(memory_frame(2, 0, 0x0F));
    refuse(memory_frame(2, 1, 0));
}

TEST(an_upper_half_alone_is_not_heard)
{
    refuse(memory_frame(2, 1, 0));
}

TEST(a_damaged_memory_is_counted)
{
    struct frame frame = memory_frame(2, 0, 0);

    frame.data[3] ^= 1;
    refuse(frame);
    expect(FAULT_DAMAGED, 1);
}

TEST(the_identifiers_beside_the_memories_are_foreign)
{
    refuse(memory_frame(0, 0, 0));
    refuse(memory_frame(NODE_MAX + 1, 0, 0));
    refuse(memory_frame(NODE_MAX + 3, 0, 0));   /* a heartbeat's, of node 2 */
    expect(FAULT_FOREIGN, 3);
}
