/* Opening and receiving: what comes, silence, and outages. */
#include "fake_body.h"

#include "wire_frames.h"

static void test_it_listens_for_what_the_wire_wants(void)
{
    static const struct wire wire = {.node = NODE};
    uint16_t ids[WIRE_LISTEN_COUNT];

    wire_ids(&wire, ids);
    TEST_ASSERT_EQUAL_UINT16_ARRAY(ids, fake.ids, WIRE_LISTEN_COUNT);
}

static void test_arguments_that_make_no_sense_are_a_usage_error(void)
{
    fake.port_result = HAL_E_USAGE;
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_body());
}

static void test_a_link_name_that_makes_no_sense_is_a_usage_error(void)
{
    fake.open_result = LINK_E_NAME;
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_body());
}

static void test_a_link_that_cannot_be_opened_is_no_body(void)
{
    fake.open_result = LINK_E_OPEN;
    TEST_ASSERT_EQUAL(HAL_E_BODY, open_body());
}

static void test_a_body_that_did_not_open_is_not_given_out(void)
{
    struct hal *untouched = NULL;

    fake.open_result = LINK_E_OPEN;
    (void)hal_open(&untouched, 0, NULL);
    TEST_ASSERT_NULL(untouched);
}

static void test_senses_are_received_when_they_come(void)
{
    senses_come(20, 7);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(7, in.senses.tick);
    TEST_ASSERT_EQUAL_UINT32(20, fake.clock_ms);
}

static void test_senses_and_commands_are_received_in_their_order(void)
{
    senses_come(20, 0);
    command_comes(20, (struct octet_command_t){.opcode = OPCODE_ERASE});
    senses_come(20, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
}

static void test_silence_is_100_ms_without_senses(void)
{
    senses_come(20, 0);
    receive();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(120, fake.clock_ms);
    assert_faults((struct octet_faults_t){.silences = 1});
}

static void test_senses_after_99_ms_are_no_silence(void)
{
    senses_come(99, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
}

static void test_silence_is_said_again_every_100_ms(void)
{
    for (uint32_t i = 1; i <= 10; i++) {
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
        TEST_ASSERT_EQUAL_UINT32(100 * i, fake.clock_ms);
    }
}

static void test_noise_does_not_break_the_silence(void)
{
    for (uint32_t at_ms = 10; at_ms <= 190; at_ms += 10)
        noise_comes(at_ms);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

static void test_stale_senses_do_not_break_the_silence(void)
{
    senses_come(0, 5);
    senses_come(50, 5);
    receive();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
    assert_faults((struct octet_faults_t){.silences = 1, .stale = 1});
}

static void test_a_command_does_not_break_the_silence(void)
{
    command_comes(60, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

static void start_in_lockstep(void)
{
    const struct output answer = {.has_answer = true};

    command_comes(0, (struct octet_command_t){.opcode = OPCODE_START, .counter = 1, .owner = 1, .lockstep = 1});
    receive();
    TEST_ASSERT_EQUAL(0, hal_send(hal, &answer));
}

static void test_in_lockstep_silence_is_no_fault(void)
{
    start_in_lockstep();
    senses_come(0, 0);
    receive();
    for (uint32_t i = 1; i <= 50; i++) {
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
        TEST_ASSERT_EQUAL_UINT32(100 * i, fake.clock_ms);
    }
    assert_faults((struct octet_faults_t){.silences = 0});
}

static void test_in_lockstep_nothing_is_passed_over_after_silence(void)
{
    start_in_lockstep();
    for (unsigned tick = 0; tick < 3; tick++)
        senses_come(5000, tick);
    for (unsigned i = 0; i < 49; i++)
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned tick = 0; tick < 3; tick++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
        TEST_ASSERT_EQUAL_UINT8(tick, in.senses.tick);
    }
}

static void test_in_lockstep_senses_that_came_again_meanwhile_are_not_stale(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    start_in_lockstep();
    for (unsigned i = 0; i < 3; i++)
        senses_come(150, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.silences = 0});
}

static enum input_kind other_owner_starts(uint32_t at_ms)
{
    command_comes(at_ms, (struct octet_command_t){.opcode = OPCODE_START, .counter = 9, .owner = 2});
    return (enum input_kind)receive();
}

static void test_in_lockstep_another_may_take_over_after_a_second(void)
{
    start_in_lockstep();
    for (unsigned i = 0; i < 9; i++)
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, other_owner_starts(950));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, other_owner_starts(1050));
}

static void test_what_was_answered_is_answered_again_at_once(void)
{
    const struct output drive = {.has_drive = true};

    start_in_lockstep();
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(0, hal_send(hal, &drive));
    senses_come(50, 0);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(OCTET_DRIVE_FRAME_ID, fake.sent[fake.sends - 1].id);
    TEST_ASSERT_EQUAL_MEMORY(&fake.sent[fake.sends - 2], &fake.sent[fake.sends - 1], sizeof(struct frame));
}

static void test_an_answer_again_that_does_not_leave_is_counted(void)
{
    const struct output drive = {.has_drive = true};

    start_in_lockstep();
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(0, hal_send(hal, &drive));
    senses_come(50, 0);
    fake.failure = LINK_E_FULL;
    fake.failing_send = fake.sends + 1;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsent = 1});
}

static void test_after_an_outage_the_last_senses_count_whatever_their_number(void)
{
    static const unsigned ticks[] = {1500, 1501, 1502, 0, 1, 2};

    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned i = 0; i < 6; i++)
        senses_come(150, ticks[i]);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT8(2, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 5});
}

static void test_after_an_outage_only_the_newest_senses_count(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned tick = 0; tick < 30; tick++)
        senses_come(150, tick);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(29, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 29});
}

static void test_noise_among_what_queued_up_is_passed_over(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    noise_comes(150);
    happens(150, LINK_E_GARBLED, (struct frame){.len = 0});
    senses_come(150, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 1, .foreign = 1, .damaged = 1});
}

static void test_another_robots_memory_is_received_and_does_not_break_the_silence(void)
{
    happens(50, 1, memory_frame(NODE + 1, 0, 0));
    TEST_ASSERT_EQUAL(INPUT_PEER, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

static void test_another_robots_memory_that_queued_up_is_passed_over(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    happens(150, 1, memory_frame(NODE + 1, 0, 0));
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    assert_faults((struct octet_faults_t){.stale = 0});
}

static void test_without_an_outage_nothing_is_passed_over(void)
{
    for (unsigned tick = 0; tick < 30; tick++)
        senses_come(20, tick);
    for (unsigned tick = 0; tick < 30; tick++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
        TEST_ASSERT_EQUAL_UINT16(tick, in.senses.tick);
    }
}

static void test_after_an_outage_a_queued_command_comes_first(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    command_comes(150, (struct octet_command_t){.opcode = OPCODE_ERASE});
    senses_come(150, 1);
    senses_come(150, 2);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(2, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 2});
}

static void test_senses_that_a_queued_command_outdates_do_not_end_the_outage(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    command_comes(150, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(200, fake.clock_ms);
}

static void test_a_body_opened_again_has_no_outage(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL(0, open_body());
    senses_come(150, 0);
    senses_come(150, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(0, in.senses.tick);
}

static void test_an_outage_ends_with_its_first_senses(void)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    senses_come(170, 1);
    senses_come(170, 2);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
}

static void test_a_robot_that_was_held_up_itself_takes_the_newest_senses(void)
{
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    for (unsigned tick = 1; tick <= 7; tick++)
        senses_come(20u * tick, tick);
    fake.clock_ms += 150;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(7, in.senses.tick);
    assert_faults((struct octet_faults_t){.silences = 1, .stale = 6});
}

static void test_every_wait_gives_signs_of_life(void)
{
    start_in_lockstep();
    for (unsigned i = 0; i < 30; i++)
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(HAL_SILENCE_MS, fake.longest_wait_ms);
}

static void test_a_bus_that_is_down_is_silence(void)
{
    fake.failing_receive = 1;
    fake.failure = LINK_E_DOWN;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

static void test_what_is_no_frame_is_counted_as_damaged(void)
{
    happens(10, LINK_E_GARBLED, (struct frame){.len = 0});
    senses_come(20, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    assert_faults((struct octet_faults_t){.damaged = 1});
}

static void test_a_closed_link_ends_the_robot(void)
{
    fake.closed = true;
    TEST_ASSERT_EQUAL(HAL_E_CLOSED, receive());
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_it_listens_for_what_the_wire_wants);
    RUN_TEST(test_arguments_that_make_no_sense_are_a_usage_error);
    RUN_TEST(test_a_link_name_that_makes_no_sense_is_a_usage_error);
    RUN_TEST(test_a_link_that_cannot_be_opened_is_no_body);
    RUN_TEST(test_a_body_that_did_not_open_is_not_given_out);
    RUN_TEST(test_senses_are_received_when_they_come);
    RUN_TEST(test_senses_and_commands_are_received_in_their_order);
    RUN_TEST(test_silence_is_100_ms_without_senses);
    RUN_TEST(test_senses_after_99_ms_are_no_silence);
    RUN_TEST(test_silence_is_said_again_every_100_ms);
    RUN_TEST(test_noise_does_not_break_the_silence);
    RUN_TEST(test_stale_senses_do_not_break_the_silence);
    RUN_TEST(test_a_command_does_not_break_the_silence);
    RUN_TEST(test_in_lockstep_silence_is_no_fault);
    RUN_TEST(test_in_lockstep_nothing_is_passed_over_after_silence);
    RUN_TEST(test_in_lockstep_senses_that_came_again_meanwhile_are_not_stale);
    RUN_TEST(test_in_lockstep_another_may_take_over_after_a_second);
    RUN_TEST(test_what_was_answered_is_answered_again_at_once);
    RUN_TEST(test_an_answer_again_that_does_not_leave_is_counted);
    RUN_TEST(test_after_an_outage_the_last_senses_count_whatever_their_number);
    RUN_TEST(test_after_an_outage_only_the_newest_senses_count);
    RUN_TEST(test_noise_among_what_queued_up_is_passed_over);
    RUN_TEST(test_another_robots_memory_is_received_and_does_not_break_the_silence);
    RUN_TEST(test_another_robots_memory_that_queued_up_is_passed_over);
    RUN_TEST(test_without_an_outage_nothing_is_passed_over);
    RUN_TEST(test_after_an_outage_a_queued_command_comes_first);
    RUN_TEST(test_senses_that_a_queued_command_outdates_do_not_end_the_outage);
    RUN_TEST(test_a_body_opened_again_has_no_outage);
    RUN_TEST(test_an_outage_ends_with_its_first_senses);
    RUN_TEST(test_a_robot_that_was_held_up_itself_takes_the_newest_senses);
    RUN_TEST(test_every_wait_gives_signs_of_life);
    RUN_TEST(test_a_bus_that_is_down_is_silence);
    RUN_TEST(test_what_is_no_frame_is_counted_as_damaged);
    RUN_TEST(test_a_closed_link_ends_the_robot);
    return UNITY_END();
}
