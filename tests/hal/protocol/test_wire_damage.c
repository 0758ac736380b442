/* Damaged frames are refused and counted. */
#include <string.h>

#include "tests/test.h"
#include "reading_rig.h"
#include "wire_frames.h"
#include "hal/protocol/wire.h"

static void flip(struct frame *frame, unsigned bit)
{
    if (bit < ID_BITS)
        frame->id ^= 1u << bit;
    else
        frame->data[(bit - ID_BITS) / 8] ^= (uint8_t)(1u << (bit - ID_BITS) % 8);
}

/* The frame is counted as damaged, or as foreign if its identifier is another node's. */
static void assert_refused_and_counted(struct frame frame)
{
    memset(wire.faults, 0, sizeof wire.faults);
    assert_ignored(frame);
    TEST_ASSERT_EQUAL_UINT(1, wire.faults[FAULT_DAMAGED] + wire.faults[FAULT_FOREIGN]);
    wire.faults[FAULT_DAMAGED] = wire.faults[FAULT_FOREIGN] = 0;
}

static void assert_every_flip_refused(const struct frame good)
{
    for (unsigned i = 0; i < BITS; i++) {
        struct frame one = good;

        flip(&one, i);
        assert_refused_and_counted(one);
        for (unsigned j = 0; j < i; j++) {
            struct frame two = one;

            flip(&two, j);
            assert_refused_and_counted(two);
        }
    }
    TEST_ASSERT_NOT_EQUAL(INPUT_SILENCE, feed(good));   /* the clean control */
}

TEST(senses_with_one_or_two_flipped_bits_are_refused)
{
    assert_every_flip_refused(senses_frame(NODE, 123));
}

TEST(command_with_one_or_two_flipped_bits_is_refused)
{
    assert_every_flip_refused(command_frame((struct octet_command_t){.opcode = OPCODE_START, .seed = 0x12345678}));
}

TEST(frame_of_wrong_length_is_damaged)
{
    for (uint8_t len = 0; len < 8; len++) {
        struct frame senses = senses_frame(NODE, 0), command = command_of(OPCODE_STOP, 0, OWNER), ranges = ranges_frame(0);

        senses.len = command.len = ranges.len = len;
        assert_ignored(protected_frame(senses));
        assert_ignored(protected_frame(command));
        assert_ignored(protected_frame(ranges));
    }
    expect(FAULT_DAMAGED, 24);
}

TEST(damaged_senses_do_not_move_the_tick)
{
    struct frame damaged = senses_frame(NODE, 10);

    read_tick(1);
    damaged.data[0] ^= 1;
    assert_ignored(damaged);
    expect(FAULT_DAMAGED, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(2));
}

TEST(damaged_command_does_not_use_its_counter)
{
    struct frame damaged = command_of(OPCODE_ERASE, 7, OWNER);

    damaged.data[7] ^= 1;
    assert_ignored(damaged);
    expect(FAULT_DAMAGED, 1);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(command_of(OPCODE_ERASE, 7, OWNER)));
}

TEST(fault_counters_stay_at_255)
{
    for (unsigned fault = 0; fault < FAULT_COUNT; fault++) {
        for (unsigned i = 0; i < 300; i++)
            wire_count(&wire, (enum fault)fault);
        expect((enum fault)fault, 255);
    }
}

/* Which identifiers a robot listens for, and which frames it takes for its own. */

TEST(node_receives_its_own_frames)
{
    for (uint8_t node = 1; node <= NODE_MAX; node++) {
        wire_init(&wire, node);
        TEST_ASSERT_EQUAL(INPUT_SENSES, feed(senses_frame(node, 0)));
    }
}

TEST(frames_of_other_nodes_are_foreign)
{
    for (uint8_t node = 2; node <= NODE_MAX; node++)
        assert_ignored(senses_frame(node, 0));
    expect(FAULT_FOREIGN, NODE_MAX - 1);
}

TEST(frames_of_neighbouring_nodes_are_foreign)
{
    static const uint32_t ids[] = {
        OCTET_SENSES_FRAME_ID, OCTET_RANGES_FRAME_ID, OCTET_COMMAND_FRAME_ID, OCTET_DRIVE_FRAME_ID, OCTET_HEARTBEAT_FRAME_ID,
    };

    for (unsigned i = 0; i < sizeof ids / sizeof *ids; i++)
        for (uint8_t node = 1; node <= NODE_MAX; node++) {
            wire_init(&wire, node);
            assert_ignored((struct frame){.id = ids[i] + node - 2u, .len = 8});
            assert_ignored((struct frame){.id = ids[i] + node, .len = 8});
            TEST_ASSERT_EQUAL_UINT8(2, wire.faults[FAULT_FOREIGN]);
        }
    expect(FAULT_FOREIGN, 2);
}

TEST(first_and_last_node_listen_for_their_identifiers)
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
    assert_ignored((struct frame){.id = OCTET_ANSWER_FRAME_ID, .len = OCTET_ANSWER_LENGTH});
    assert_ignored((struct frame){.id = OCTET_FAULTS_FRAME_ID, .len = OCTET_FAULTS_LENGTH});
    expect(FAULT_FOREIGN, 2);
}

TEST(extended_remote_and_error_frames_are_foreign)
{
    static const uint32_t flags[] = {FRAME_EXTENDED, FRAME_REMOTE, FRAME_ERROR};

    for (unsigned i = 0; i < 3; i++) {
        struct frame frame = senses_frame(NODE, 0);

        frame.id |= flags[i];
        assert_ignored(frame);
    }
    expect(FAULT_FOREIGN, 3);
}

static void assert_peer(bool upper, uint8_t first)
{
    const uint8_t expected[] = {first, 1, 2, 1};

    TEST_ASSERT_EQUAL(upper, in.peer.upper);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, in.peer.cell, CELL_COUNT / 2);
}

TEST(memory_of_every_other_node_is_received)
{
    for (uint8_t node = 2; node <= NODE_MAX; node++) {
        TEST_ASSERT_EQUAL(INPUT_PEER, feed(memory_frame(node, 0, 0)));
        assert_peer(false, 0);
        TEST_ASSERT_EQUAL(INPUT_PEER, feed(memory_frame(node, 1, 2)));
        assert_peer(true, 2);
    }
}

TEST(peer_memory_is_received_once_per_report)
{
    TEST_ASSERT_EQUAL(INPUT_PEER, feed(memory_frame(2, 0, 0)));
    TEST_ASSERT_EQUAL(INPUT_PEER, feed(memory_frame(2, 1, 0)));
    assert_ignored(memory_frame(2, 0, 0));
    assert_ignored(memory_frame(2, 1, 0));
    respond((struct output){.has_drive = true});
    assert_ignored(memory_frame(2, 0, 0));
    respond((struct output){.has_drive = true, .has_report = true});
    TEST_ASSERT_EQUAL(INPUT_PEER, feed(memory_frame(2, 0, 0)));
    TEST_ASSERT_EQUAL(INPUT_PEER, feed(memory_frame(2, 1, 0)));
}

TEST(peer_memory_is_received_again_after_a_start)
{
    TEST_ASSERT_EQUAL(INPUT_PEER, feed(memory_frame(2, 0, 0)));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, feed(command_frame((struct octet_command_t){.counter = 1, .opcode = OPCODE_START})));
    respond((struct output){.has_answer = true});
    TEST_ASSERT_EQUAL(INPUT_PEER, feed(memory_frame(2, 0, 0)));
}

TEST(last_node_receives_all_memories_again_after_a_report)
{
    wire_init(&wire, NODE_MAX);
    for (unsigned reports = 0; reports < 2; reports++) {
        for (uint8_t node = 1; node < NODE_MAX; node++)
            TEST_ASSERT_EQUAL(INPUT_PEER, feed(memory_frame(node, 0, 0)));
        respond((struct output){.has_drive = true, .has_report = true});
    }
}

TEST(peer_memory_is_received_with_any_counter)
{
    for (uint8_t counter = 0; counter < E2E_COUNTERS; counter++) {
        struct frame lower = memory_frame(counter + 2u, 0, 0), upper = memory_frame(counter + 2u, 1, 0);

        lower.data[1] |= counter;
        upper.data[1] |= counter;
        TEST_ASSERT_EQUAL(INPUT_PEER, feed(protected_frame(lower)));
        assert_peer(false, 0);
        TEST_ASSERT_EQUAL(INPUT_PEER, feed(protected_frame(upper)));
        assert_peer(true, 0);
    }
}

TEST(peer_memory_of_all_five_sensors_is_ignored)
{
    assert_ignored(memory_frame(2, 0, 0x0F));
    assert_ignored(memory_frame(2, 1, 0));
}

TEST(upper_half_alone_is_ignored)
{
    assert_ignored(memory_frame(2, 1, 0));
}

TEST(damaged_peer_memory_is_counted)
{
    struct frame frame = memory_frame(2, 0, 0);

    frame.data[3] ^= 1;
    assert_ignored(frame);
    expect(FAULT_DAMAGED, 1);
}

TEST(identifiers_next_to_memories_are_foreign)
{
    assert_ignored(memory_frame(0, 0, 0));
    assert_ignored(memory_frame(NODE_MAX + 1, 0, 0));
    assert_ignored(memory_frame(NODE_MAX + 3, 0, 0));   /* a heartbeat's, of node 2 */
    expect(FAULT_FOREIGN, 3);
}
