/* Opening, receiving, and silence. */
#include "fake_body.h"

#include "tests/hal/protocol/wire_frames.h"

TEST(body_opens_its_link_for_the_identifiers_of_the_wire)
{
    static const struct wire wire = {.node = NODE};
    uint16_t ids[WIRE_LISTEN_COUNT];

    wire_ids(&wire, ids);
    TEST_ASSERT_EQUAL_size_t(WIRE_LISTEN_COUNT, fake.id_count);
    TEST_ASSERT_EQUAL_UINT16_ARRAY(ids, fake.ids, WIRE_LISTEN_COUNT);
}

TEST(invalid_arguments_return_usage_error)
{
    fake.port_result = HAL_E_USAGE;
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_body());
}

TEST(body_open_fails_if_its_port_does)
{
    fake.port_result = HAL_E_BODY;
    TEST_ASSERT_EQUAL(HAL_E_BODY, open_body());
}

TEST(body_passes_its_arguments_to_the_port)
{
    static char name[] = "robot";
    char *const argv[] = {name, NULL};

    TEST_ASSERT_EQUAL(0, hal_open(&hal, 1, argv));
    TEST_ASSERT_EQUAL_INT(1, fake.argc);
    TEST_ASSERT_EQUAL_PTR(argv, fake.argv);
}

TEST(invalid_link_name_returns_usage_error)
{
    fake.open_result = LINK_E_NAME;
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_body());
}

TEST(failed_link_open_returns_body_error)
{
    fake.open_result = LINK_E_OPEN;
    TEST_ASSERT_EQUAL(HAL_E_BODY, open_body());
}

TEST(failed_open_leaves_handle_unchanged)
{
    struct hal *untouched = NULL;

    fake.open_result = LINK_E_OPEN;
    (void)hal_open(&untouched, 0, NULL);
    TEST_ASSERT_NULL(untouched);
}

TEST(senses_are_received_on_arrival)
{
    script_senses(20, 7);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(7, in.senses.tick);
    TEST_ASSERT_EQUAL_UINT32(20, fake.clock_ms);
}

TEST(senses_and_commands_are_received_in_order)
{
    script_senses(20, 0);
    script_command(20, (struct octet_command_t){.opcode = OPCODE_ERASE});
    script_senses(20, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
}

TEST(silence_is_100_ms_without_senses)
{
    script_senses(20, 0);
    receive();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(120, fake.clock_ms);
    assert_faults((struct octet_faults_t){.silences = 1});
}

TEST(silence_takes_one_link_receive)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.receives);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(2, fake.receives);
    TEST_ASSERT_EQUAL(0, open_body());
    script_senses(200, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(4, fake.receives);
}

TEST(senses_after_99_ms_are_no_silence)
{
    script_senses(99, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
}

TEST(silence_is_reported_every_100_ms)
{
    for (uint32_t i = 1; i <= 10; i++) {
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
        TEST_ASSERT_EQUAL_UINT32(100 * i, fake.clock_ms);
    }
}

TEST(noise_does_not_break_the_silence)
{
    for (uint32_t at_ms = 10; at_ms <= 190; at_ms += 10)
        script_noise(at_ms);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

TEST(stale_senses_do_not_break_the_silence)
{
    script_senses(0, 5);
    script_senses(50, 5);
    receive();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
    assert_faults((struct octet_faults_t){.silences = 1, .stale = 1});
}

TEST(command_does_not_break_the_silence)
{
    script_command(60, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

TEST(peer_memory_does_not_break_the_silence)
{
    script_event(50, 1, memory_frame(NODE + 1, 0, 0));
    TEST_ASSERT_EQUAL(INPUT_PEER, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

TEST(bus_down_counts_as_silence)
{
    fake.failing_receive = 1;
    fake.failure = LINK_E_DOWN;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(100, fake.clock_ms);
}

TEST(invalid_frame_is_counted_as_damaged)
{
    script_event(10, LINK_E_GARBLED, (struct frame){.len = 0});
    script_senses(20, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    assert_faults((struct octet_faults_t){.damaged = 1});
}

TEST(receive_on_closed_link_returns_closed_error)
{
    fake.closed = true;
    TEST_ASSERT_EQUAL(HAL_E_CLOSED, receive());
}

/* Sending and storing, and a link that fails at its n-th call. */

TEST(boot_is_sent_first)
{
    script_senses(20, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.sends);
    TEST_ASSERT_EQUAL_UINT32(OCTET_BOOT_FRAME_ID, fake.sent[0].id);
}

TEST(boot_is_repeated_until_the_bus_is_up_without_a_fault)
{
    fake.failing_send = 1;
    fake.failure = LINK_E_DOWN;
    script_senses(20, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT(2, fake.sends);
    TEST_ASSERT_EQUAL_UINT32(OCTET_BOOT_FRAME_ID, fake.sent[1].id);
    assert_faults((struct octet_faults_t){.unsent = 0});
}

TEST(drive_is_sent)
{
    const struct output out = {.has_drive = true};

    TEST_ASSERT_EQUAL(0, hal_send(hal, &out));
    TEST_ASSERT_EQUAL_UINT(1, fake.sends);
    TEST_ASSERT_EQUAL_UINT32(OCTET_DRIVE_FRAME_ID, fake.sent[0].id);
}

TEST(send_on_closed_link_returns_closed_error)
{
    const struct output out = {.has_drive = true};

    fake.closed = true;
    TEST_ASSERT_EQUAL(HAL_E_CLOSED, hal_send(hal, &out));
}

static void assert_only_frame_n_is_lost(unsigned n, int failure)
{
    const struct output out = {.has_answer = true, .has_report = true, .whole_report = true, .has_drive = true};

    setUp();
    fake.failing_send = n;
    fake.failure = failure;
    TEST_ASSERT_EQUAL(0, hal_send(hal, &out));
    TEST_ASSERT_EQUAL_UINT(FRAMES, fake.sends);
    assert_faults((struct octet_faults_t){.unsent = 1});
}

TEST(unsent_frame_is_counted_and_the_rest_is_sent)
{
    for (unsigned n = 1; n <= FRAMES; n++) {
        assert_only_frame_n_is_lost(n, LINK_E_FULL);
        assert_only_frame_n_is_lost(n, LINK_E_DOWN);
    }
}

/* Receives twenty ticks with an outage in the middle; link_receive fails at its n-th call. */
static int receive_with_failure(unsigned n, int failure)
{
    int result = 0;

    setUp();
    fake.failing_receive = n;
    fake.failure = failure;
    for (uint16_t tick = 0; tick < 20; tick++)
        script_senses(20u * tick + (tick < 10 ? 0 : 300), tick);
    while (result >= 0 && fake.next < fake.events)
        result = receive();
    return result;
}

TEST(body_continues_after_bus_down_at_any_receive)
{
    for (unsigned n = 1; n <= 25; n++)
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive_with_failure(n, LINK_E_DOWN));
}

TEST(body_counts_garbled_frame_at_any_receive)
{
    for (unsigned n = 1; n <= 20; n++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive_with_failure(n, LINK_E_GARBLED));
        TEST_ASSERT_EQUAL_UINT8(1, faults().damaged);
    }
}

TEST(body_returns_closed_error_at_any_receive)
{
    for (unsigned n = 1; n <= 20; n++)
        TEST_ASSERT_EQUAL(HAL_E_CLOSED, receive_with_failure(n, LINK_E_CLOSED));
}

TEST(memory_is_loaded_and_stored_through_the_port)
{
    uint8_t memory[CELL_COUNT] = {0};

    fake.store_result = 1;
    TEST_ASSERT_EQUAL(1, hal_load(hal, memory));
    fake.store_result = 0;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory, false));
    assert_faults((struct octet_faults_t){.unsaved = 0});
}

TEST(failed_store_is_counted)
{
    static const uint8_t memory[CELL_COUNT] = {0, 2};

    fake.store_result = HAL_E_STORE;
    TEST_ASSERT_EQUAL(HAL_E_STORE, hal_store(hal, memory, false));
    assert_faults((struct octet_faults_t){.unsaved = 1});
}

TEST(failed_load_is_counted)
{
    uint8_t memory[CELL_COUNT];

    fake.store_result = HAL_E_STORE;
    TEST_ASSERT_EQUAL(HAL_E_STORE, hal_load(hal, memory));
    assert_faults((struct octet_faults_t){.unsaved = 1});
}

TEST(load_without_stored_memory_is_no_fault)
{
    uint8_t memory[CELL_COUNT];

    TEST_ASSERT_EQUAL(0, hal_load(hal, memory));
    assert_faults((struct octet_faults_t){.unsaved = 0});
}

static void postpone_store(void)
{
    static const uint8_t memory[CELL_COUNT] = {0, 2};

    fake.needs_rest = true;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory, false));
}

TEST(slow_store_waits_for_silence)
{
    postpone_store();
    TEST_ASSERT_EQUAL_UINT(0, fake.stores);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.stores);
    assert_faults((struct octet_faults_t){.unsaved = 0});
}

TEST(slow_store_happens_at_once_at_rest)
{
    static const uint8_t memory[CELL_COUNT] = {0, 2};

    fake.needs_rest = true;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory, true));
    TEST_ASSERT_EQUAL_UINT(1, fake.stores);
}

TEST(health_reports_a_postponed_store)
{
    postpone_store();
    (void)faults();
    TEST_ASSERT_EQUAL_UINT32(OCTET_HEALTH_FRAME_ID, fake.sent[fake.sends - 1].id);
    TEST_ASSERT_EQUAL_HEX8(1u << 6, fake.sent[fake.sends - 1].data[1] & 1u << 6);
}

TEST(postponed_store_happens_once)
{
    postpone_store();
    for (unsigned i = 0; i < 3; i++)
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT(1, fake.stores);
}

TEST(failed_postponed_store_is_counted)
{
    postpone_store();
    fake.store_result = HAL_E_STORE;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsaved = 1});
}

TEST(entropy_comes_from_the_port)
{
    TEST_ASSERT_EQUAL_HEX32(0xC0FFEE, hal_entropy(hal));
}
