/* What is damaged on its way is refused, and counted. */
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

/* Each is counted: as damaged, or as foreign where the identifier became another's. */
static void refuse_and_count(struct frame frame)
{
    memset(wire.faults, 0, sizeof wire.faults);
    refuse(frame);
    TEST_ASSERT_EQUAL_UINT(1, wire.faults[FAULT_DAMAGED] + wire.faults[FAULT_FOREIGN]);
    wire.faults[FAULT_DAMAGED] = wire.faults[FAULT_FOREIGN] = 0;
}

static void refuse_every_flip(const struct frame good)
{
    for (unsigned i = 0; i < BITS; i++) {
        struct frame one = good;

        flip(&one, i);
        refuse_and_count(one);
        for (unsigned j = 0; j < i; j++) {
            struct frame two = one;

            flip(&two, j);
            refuse_and_count(two);
        }
    }
    TEST_ASSERT_NOT_EQUAL(INPUT_SILENCE, hear(good));   /* the clean control */
}

TEST(senses_with_one_or_two_flipped_bits_are_refused)
{
    refuse_every_flip(senses_frame(NODE, 123));
}

TEST(a_command_with_one_or_two_flipped_bits_is_refused)
{
    refuse_every_flip(command_frame((struct octet_command_t){.opcode = OPCODE_START, .seed = 0x12345678}));
}

TEST(a_frame_of_another_length_is_damaged)
{
    for (uint8_t len = 0; len < 8; len++) {
        struct frame senses = senses_frame(NODE, 0), command = command_of(OPCODE_STOP, 0, OWNER), ranges = ranges_frame(0);

        senses.len = command.len = ranges.len = len;
        refuse(protected_frame(senses));
        refuse(protected_frame(command));
        refuse(protected_frame(ranges));
    }
    expect(FAULT_DAMAGED, 24);
}

TEST(damaged_senses_do_not_move_the_tick)
{
    struct frame damaged = senses_frame(NODE, 10);

    read_tick(1);
    damaged.data[0] ^= 1;
    refuse(damaged);
    expect(FAULT_DAMAGED, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(2));
}

TEST(a_damaged_command_does_not_use_up_its_counter)
{
    struct frame damaged = command_of(OPCODE_ERASE, 7, OWNER);

    damaged.data[7] ^= 1;
    refuse(damaged);
    expect(FAULT_DAMAGED, 1);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_of(OPCODE_ERASE, 7, OWNER)));
}

TEST(every_counter_stays_at_255)
{
    for (unsigned fault = 0; fault < FAULT_COUNT; fault++) {
        for (unsigned i = 0; i < 300; i++)
            wire_count(&wire, (enum fault)fault);
        expect((enum fault)fault, 255);
    }
}

/* Which identifiers a robot listens for, and which frames it takes for its own. */

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
