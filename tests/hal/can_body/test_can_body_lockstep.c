/* Lockstep: the simulator sets the time, and repeated senses get the same answer again. */
#include "fake_body.h"

#include <stddef.h>

/* INPUT_SILENCE: the robot has another owner. */
static enum input_kind owner_starts(uint32_t at_ms, uint8_t owner)
{
    const struct output answer = {.has_answer = true};

    script_command(at_ms, (struct octet_command_t){.opcode = OPCODE_START, .counter = 1, .owner = owner, .lockstep = 1});
    if (receive() != INPUT_COMMAND)
        return INPUT_SILENCE;
    TEST_ASSERT_EQUAL(0, hal_send(hal, &answer));
    return INPUT_COMMAND;
}

static void start_in_lockstep(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(0, 1));
}

static void receive_silences(unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
}

TEST(lockstep_silence_counts_no_fault)
{
    start_in_lockstep();
    script_senses(0, 0);
    receive();
    for (uint32_t i = 1; i <= 50; i++) {
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
        TEST_ASSERT_EQUAL_UINT32(100 * i, fake.clock_ms);
    }
    assert_faults((struct octet_faults_t){.silences = 0});
}

TEST(lockstep_skips_no_senses_after_silence)
{
    start_in_lockstep();
    for (unsigned tick = 0; tick < 3; tick++)
        script_senses(5000, tick);
    receive_silences(49);
    for (unsigned tick = 0; tick < 3; tick++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
        TEST_ASSERT_EQUAL_UINT8(tick, in.senses.tick);
    }
}

TEST(lockstep_repeated_senses_after_silence_are_not_stale)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    start_in_lockstep();
    for (unsigned i = 0; i < 3; i++)
        script_senses(150, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.silences = 0});
}

static enum input_kind other_owner_starts(uint32_t at_ms)
{
    script_command(at_ms, (struct octet_command_t){.opcode = OPCODE_START, .counter = 9, .owner = 2});
    return (enum input_kind)receive();
}

TEST(lockstep_owner_can_be_replaced_after_1_s)
{
    start_in_lockstep();
    receive_silences(9);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, other_owner_starts(950));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, other_owner_starts(1050));
}

static void script_answered_senses_again(void)
{
    const struct output drive = {.has_drive = true};

    start_in_lockstep();
    script_senses(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(0, hal_send(hal, &drive));
    script_senses(50, 0);
}

TEST(repeated_senses_are_answered_again_at_once)
{
    script_answered_senses_again();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(OCTET_DRIVE_FRAME_ID, fake.sent[fake.sends - 1].id);
    TEST_ASSERT_EQUAL_MEMORY(&fake.sent[fake.sends - 2], &fake.sent[fake.sends - 1], sizeof(struct frame));
}

TEST(unsent_repeated_answer_is_counted)
{
    script_answered_senses_again();
    fake.failure = LINK_E_FULL;
    fake.failing_send = fake.sends + 1;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsent = 1});
}

TEST(lockstep_senses_reset_the_owner_timeout)
{
    start_in_lockstep();
    receive_silences(9);
    script_senses(910, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    receive_silences(9);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, owner_starts(1820, 2));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(1920, 2));
}

TEST(lockstep_owner_without_senses_times_out)
{
    start_in_lockstep();
    receive_silences(10);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(1010, 2));
    receive_silences(1);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(1110, 3));
}

TEST(repeated_answer_is_no_fault)
{
    script_answered_senses_again();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsent = 0});
}

TEST(port_alive_is_called_every_100_ms)
{
    start_in_lockstep();
    receive_silences(30);
    TEST_ASSERT_EQUAL_UINT32(HAL_SILENCE_MS, fake.longest_wait_ms);
}

/* What the body reports of its machine and of the bus. */

static const struct output REPORT = {.has_report = true, .whole_report = true};

static void report_anew(void)
{
    TEST_ASSERT_EQUAL(0, open_body());
    TEST_ASSERT_EQUAL(0, hal_send(hal, &REPORT));
}

/* The data of the last frame with this identifier. */
static const uint8_t *last_data_of(uint32_t id)
{
    for (unsigned i = fake.sends; i-- > 0;)
        if (fake.sent[i].id == id)
            return fake.sent[i].data;
    TEST_FAIL_MESSAGE("it was not sent");
    return NULL;
}

TEST(body_reports_readiness_to_the_port)
{
    TEST_ASSERT_EQUAL_UINT(1, fake.ready_calls);
    fake.open_result = LINK_E_OPEN;
    (void)open_body();
    TEST_ASSERT_EQUAL_UINT(1, fake.ready_calls);
}

TEST(boot_reports_the_reset_cause_of_the_port)
{
    struct octet_boot_t boot;

    fake.reset_cause = RESET_WATCHDOG;
    report_anew();
    TEST_ASSERT_EQUAL(0, octet_boot_unpack(&boot, last_data_of(OCTET_BOOT_FRAME_ID), OCTET_BOOT_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(RESET_WATCHDOG, boot.reset_cause);
}

TEST(report_contains_the_last_crash)
{
    static const struct crash crash = {.cause = 3, .count = 1, .values = {0x12345678}};
    struct octet_crash_t told;

    fake.crash = &crash;
    report_anew();
    TEST_ASSERT_EQUAL(0, octet_crash_unpack(&told, last_data_of(OCTET_CRASH_FRAME_ID), OCTET_CRASH_LENGTH));
    TEST_ASSERT_EQUAL_HEX32(0x12345678, told.value);
}

static struct octet_health_t health(void)
{
    struct octet_health_t told;

    report_anew();
    TEST_ASSERT_EQUAL(0, octet_health_unpack(&told, last_data_of(OCTET_HEALTH_FRAME_ID), OCTET_HEALTH_LENGTH));
    return told;
}

TEST(health_reports_whether_the_clock_is_exact)
{
    TEST_ASSERT_EQUAL_UINT8(0, health().clock);
    fake.clock_exact = true;
    TEST_ASSERT_EQUAL_UINT8(1, health().clock);
}

TEST(health_reports_bus_state_and_error_counters)
{
    fake.bus = (struct link_health){.state = BUS_PASSIVE, .tx_errors = 130, .rx_errors = 7};
    TEST_ASSERT_EQUAL_UINT8(BUS_PASSIVE, health().bus_state);
    TEST_ASSERT_EQUAL_UINT8(130, health().tx_errors);
    TEST_ASSERT_EQUAL_UINT8(7, health().rx_errors);
}

TEST(bus_health_is_read_for_reports_only)
{
    static const struct output drive = {.has_drive = true};

    TEST_ASSERT_EQUAL(0, hal_send(hal, &drive));
    TEST_ASSERT_EQUAL_UINT(0, fake.health_reads);
    TEST_ASSERT_EQUAL(0, hal_send(hal, &REPORT));
    TEST_ASSERT_EQUAL_UINT(1, fake.health_reads);
}

TEST(postponed_store_writes_every_byte)
{
    static const uint8_t memory[CELL_COUNT] = {0x0F, 2, 3, 4, 5, 6, 7, 8};

    fake.needs_rest = true;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory, false));
    TEST_ASSERT_EQUAL(INPUT_SILENCE, hal_receive(hal, &in));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(memory, fake.stored, CELL_COUNT);
}
