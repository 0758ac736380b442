/* Which identifiers a robot listens for, and which frames it takes for its own. */
#include "hal/protocol/wire.h"
#include "tests/test.h"
#include "wire_frames.h"

#include "reading_rig.h"

TEST(each_node_hears_its_own_frames)
{
    for (uint8_t node = 1; node <= NODE_MAX; node++) {
        wire_init(&wire, node);
        TEST_ASSERT_EQUAL(INPUT_SENSES, hear(senses_frame(node, 0)));
    }
}

TEST(no_node_hears_anothers_frames)
{
    for (uint8_t node = 2; node <= NODE_MAX; node++)
        refuse(senses_frame(node, 0));
    expect(FAULT_FOREIGN, NODE_MAX - 1);
}

TEST(no_node_hears_what_is_meant_for_its_neighbours)
{
    static const uint32_t ids[] = {
        OCTET_SENSES_FRAME_ID, OCTET_RANGES_FRAME_ID, OCTET_COMMAND_FRAME_ID, OCTET_DRIVE_FRAME_ID, OCTET_HEARTBEAT_FRAME_ID,
    };

    for (unsigned i = 0; i < sizeof ids / sizeof *ids; i++)
        for (uint8_t node = 1; node <= NODE_MAX; node++) {
            wire_init(&wire, node);
            refuse((struct frame){.id = ids[i] + node - 2u, .len = 8});
            refuse((struct frame){.id = ids[i] + node, .len = 8});
            TEST_ASSERT_EQUAL_UINT8(2, wire.faults[FAULT_FOREIGN]);
        }
    expect(FAULT_FOREIGN, 2);
}

TEST(the_first_and_the_last_node_listen_for_their_own)
{
    static const uint16_t expected[2][WIRE_LISTEN_COUNT] = {
        {0x101, 0x121, 0x021, 0x041, 0x6A1, LINK_FAMILY | 0x680},
        {0x11F, 0x13F, 0x03F, 0x05F, 0x6BF, LINK_FAMILY | 0x680},
    };
    static const uint8_t nodes[2] = {1, NODE_MAX};
    uint16_t ids[WIRE_LISTEN_COUNT];

    for (unsigned i = 0; i < 2; i++) {
        wire_init(&wire, nodes[i]);
        wire_ids(&wire, ids);
        TEST_ASSERT_EQUAL_UINT16_ARRAY(expected[i], ids, WIRE_LISTEN_COUNT);
    }
}

TEST(other_messages_of_robots_are_foreign)
{
    refuse((struct frame){.id = OCTET_ANSWER_FRAME_ID, .len = OCTET_ANSWER_LENGTH});
    refuse((struct frame){.id = OCTET_FAULTS_FRAME_ID, .len = OCTET_FAULTS_LENGTH});
    expect(FAULT_FOREIGN, 2);
}

TEST(extended_remote_and_error_frames_are_foreign)
{
    static const uint32_t flags[] = {FRAME_EXTENDED, FRAME_REMOTE, FRAME_ERROR};

    for (unsigned i = 0; i < 3; i++) {
        struct frame frame = senses_frame(NODE, 0);

        frame.id |= flags[i];
        refuse(frame);
    }
    expect(FAULT_FOREIGN, 3);
}
