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

TEST(arguments_that_make_no_sense_are_a_usage_error)
{
    fake.port_result = HAL_E_USAGE;
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_body());
}

TEST(a_machine_without_a_body_has_none)
{
    fake.port_result = HAL_E_BODY;
    TEST_ASSERT_EQUAL(HAL_E_BODY, open_body());
}

TEST(the_machine_gets_the_arguments)
{
    static char name[] = "robot";
    char *const argv[] = {name, NULL};

    TEST_ASSERT_EQUAL(0, hal_open(&hal, 1, argv));
    TEST_ASSERT_EQUAL_INT(1, fake.argc);
    TEST_ASSERT_EQUAL_PTR(argv, fake.argv);
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

TEST(each_silence_is_one_wait)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.receives);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(2, fake.receives);
    TEST_ASSERT_EQUAL(0, open_body());
    senses_come(200, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(4, fake.receives);
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

TEST(an_invalid_frame_is_counted_as_damaged)
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
