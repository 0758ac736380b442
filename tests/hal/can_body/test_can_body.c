/* Opening and receiving: what comes, and silence. */
#include "fake_body.h"

#include "tests/hal/protocol/wire_frames.h"

TEST(it_listens_for_what_the_wire_wants)
{
    static const struct wire wire = {.node = NODE};
    uint16_t ids[WIRE_LISTEN_COUNT];

    wire_ids(&wire, ids);
    TEST_ASSERT_EQUAL_size_t(WIRE_LISTEN_COUNT, fake.id_count);
    TEST_ASSERT_EQUAL_UINT16_ARRAY(ids, fake.ids, WIRE_LISTEN_COUNT);
}

TEST(a_frame_for_the_machine_is_for_the_machine_alone)
{
    fake.port_id = 0x6E1;
    TEST_ASSERT_EQUAL(0, open_body());
    TEST_ASSERT_EQUAL_size_t(WIRE_LISTEN_COUNT + 1, fake.id_count);
    TEST_ASSERT_EQUAL_HEX16(0x6E1, fake.ids[WIRE_LISTEN_COUNT]);
    happens(5, 1, (struct frame){.id = 0x6E1, .len = 1, .data = {7}});
    fake.sends = 0;
    fake.port_answers = true;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.port_frames);
    TEST_ASSERT_TRUE(fake.port_at_rest);
    TEST_ASSERT_EQUAL_HEX32(0x61, fake.sent[fake.sends - 1].id);
    TEST_ASSERT_EQUAL_HEX8(7, fake.sent[fake.sends - 1].data[0]);
}

TEST(what_the_machine_leaves_without_an_answer_has_none_and_one_that_was_not_sent_is_counted)
{
    fake.port_id = 0x6E1;
    TEST_ASSERT_EQUAL(0, open_body());
    happens(5, 1, (struct frame){.id = 0x6E1, .len = 1, .data = {7}});
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned i = 0; i < fake.sends; i++)
        TEST_ASSERT_NOT_EQUAL_HEX32(0x61, fake.sent[i].id);
    happens(10, 1, (struct frame){.id = 0x6E1, .len = 1, .data = {7}});
    fake.port_answers = true;
    fake.failure = LINK_E_FULL;
    fake.failing_send = fake.sends + 1;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    command_comes(20, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    assert_faults((struct octet_faults_t){.unsent = 1});
}

TEST(a_machine_that_listens_for_nothing_hears_nothing)
{
    happens(5, 1, (struct frame){.id = 0, .len = 1});
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(0, fake.port_frames);
}

TEST(arguments_that_make_no_sense_are_a_usage_error)
{
    fake.port_result = HAL_E_USAGE;
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_body());
}

TEST(a_link_name_that_makes_no_sense_is_a_usage_error)
{
    fake.open_result = LINK_E_NAME;
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_body());
}

TEST(a_link_that_cannot_be_opened_is_no_body)
{
    fake.open_result = LINK_E_OPEN;
    TEST_ASSERT_EQUAL(HAL_E_BODY, open_body());
}

TEST(a_body_that_did_not_open_is_not_given_out)
{
    struct hal *untouched = NULL;

    fake.open_result = LINK_E_OPEN;
    (void)hal_open(&untouched, 0, NULL);
    TEST_ASSERT_NULL(untouched);
}

TEST(senses_are_received_when_they_come)
{
    senses_come(20, 7);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(7, in.senses.tick);
    TEST_ASSERT_EQUAL_UINT32(20, fake.clock_ms);
}

TEST(senses_and_commands_are_received_in_their_order)
{
    senses_come(20, 0);
    command_comes(20, (struct octet_command_t){.opcode = OPCODE_ERASE});
    senses_come(20, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
}

TEST(silence_is_100_ms_without_senses)
{
    senses_come(20, 0);
    receive();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(120, fake.clock_ms);
    assert_faults((struct octet_faults_t){.silences = 1});
}

TEST(senses_after_99_ms_are_no_silence)
{
    senses_come(99, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
}

TEST(silence_is_said_again_every_100_ms)
{
    for (uint32_t i = 1; i <= 10; i++) {
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
        TEST_ASSERT_EQUAL_UINT32(100 * i, fake.clock_ms);
    }
}

TEST(noise_does_not_break_the_silence)
{
    for (uint32_t at_ms = 10; at_ms <= 190; at_ms += 10)
        noise_comes(at_ms);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

TEST(stale_senses_do_not_break_the_silence)
{
    senses_come(0, 5);
    senses_come(50, 5);
    receive();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
    assert_faults((struct octet_faults_t){.silences = 1, .stale = 1});
}

TEST(a_command_does_not_break_the_silence)
{
    command_comes(60, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

TEST(another_robots_memory_is_received_and_does_not_break_the_silence)
{
    happens(50, 1, memory_frame(NODE + 1, 0, 0));
    TEST_ASSERT_EQUAL(INPUT_PEER, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

TEST(a_bus_that_is_down_is_silence)
{
    fake.failing_receive = 1;
    fake.failure = LINK_E_DOWN;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

TEST(what_is_no_frame_is_counted_as_damaged)
{
    happens(10, LINK_E_GARBLED, (struct frame){.len = 0});
    senses_come(20, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    assert_faults((struct octet_faults_t){.damaged = 1});
}

TEST(a_closed_link_ends_the_robot)
{
    fake.closed = true;
    TEST_ASSERT_EQUAL(HAL_E_CLOSED, receive());
}
