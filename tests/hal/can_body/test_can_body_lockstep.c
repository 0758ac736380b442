/* Lockstep: time is the other side's, and what was answered is answered again. */
#include "fake_body.h"

#include <stddef.h>

/* INPUT_SILENCE: the robot has another owner. */
static enum input_kind owner_starts(uint32_t at_ms, uint8_t owner)
{
    const struct output answer = {.has_answer = true};

    command_comes(at_ms, (struct octet_command_t){.opcode = OPCODE_START, .counter = 1, .owner = owner, .lockstep = 1});
    if (receive() != INPUT_COMMAND)
        return INPUT_SILENCE;
    TEST_ASSERT_EQUAL(0, hal_send(hal, &answer));
    return INPUT_COMMAND;
}

static void start_in_lockstep(void)
{
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(0, 1));
}

static void silences(unsigned count)
{
    for (unsigned i = 0; i < count; i++)
        TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
}

TEST(in_lockstep_silence_is_no_fault)
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

TEST(in_lockstep_nothing_is_passed_over_after_silence)
{
    start_in_lockstep();
    for (unsigned tick = 0; tick < 3; tick++)
        senses_come(5000, tick);
    silences(49);
    for (unsigned tick = 0; tick < 3; tick++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
        TEST_ASSERT_EQUAL_UINT8(tick, in.senses.tick);
    }
}

TEST(in_lockstep_senses_that_came_again_meanwhile_are_not_stale)
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

TEST(in_lockstep_another_may_take_over_after_a_second)
{
    start_in_lockstep();
    silences(9);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, other_owner_starts(950));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, other_owner_starts(1050));
}

static void answered_senses_come_again(void)
{
    const struct output drive = {.has_drive = true};

    start_in_lockstep();
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(0, hal_send(hal, &drive));
    senses_come(50, 0);
}

TEST(what_was_answered_is_answered_again_at_once)
{
    answered_senses_come_again();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(OCTET_DRIVE_FRAME_ID, fake.sent[fake.sends - 1].id);
    TEST_ASSERT_EQUAL_MEMORY(&fake.sent[fake.sends - 2], &fake.sent[fake.sends - 1], sizeof(struct frame));
}

TEST(an_answer_again_that_does_not_leave_is_counted)
{
    answered_senses_come_again();
    fake.failure = LINK_E_FULL;
    fake.failing_send = fake.sends + 1;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsent = 1});
}

TEST(in_lockstep_senses_begin_the_count_of_silences_anew)
{
    start_in_lockstep();
    silences(9);
    senses_come(910, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    silences(9);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, owner_starts(1820, 2));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(1920, 2));
}

TEST(in_lockstep_an_owner_that_never_sends_senses_is_soon_no_owner)
{
    start_in_lockstep();
    silences(10);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(1010, 2));
    silences(1);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, owner_starts(1110, 3));
}

TEST(an_answer_that_is_given_again_is_no_fault)
{
    answered_senses_come_again();
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    assert_faults((struct octet_faults_t){.unsent = 0});
}

TEST(every_wait_gives_signs_of_life)
{
    start_in_lockstep();
    silences(30);
    TEST_ASSERT_EQUAL_UINT32(HAL_SILENCE_MS, fake.longest_wait_ms);
}

/* What the body tells of the machine that it runs on, and of the bus. */

static const struct output REPORT = {.has_report = true, .whole_report = true};

static void report_anew(void)
{
    TEST_ASSERT_EQUAL(0, open_body());
    TEST_ASSERT_EQUAL(0, hal_send(hal, &REPORT));
}

/* The last frame with this identifier. */
static const uint8_t *told_in(uint32_t id)
{
    for (unsigned i = fake.sends; i-- > 0;)
        if (fake.sent[i].id == id)
            return fake.sent[i].data;
    TEST_FAIL_MESSAGE("it was not sent");
    return NULL;
}

TEST(the_machine_hears_that_the_link_is_open)
{
    TEST_ASSERT_EQUAL_UINT(1, fake.readies);
    fake.open_result = LINK_E_OPEN;
    (void)open_body();
    TEST_ASSERT_EQUAL_UINT(1, fake.readies);
}

TEST(it_tells_why_the_machine_has_started)
{
    struct octet_boot_t boot;

    fake.reset_cause = RESET_WATCHDOG;
    report_anew();
    TEST_ASSERT_EQUAL(0, octet_boot_unpack(&boot, told_in(OCTET_BOOT_FRAME_ID), OCTET_BOOT_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(RESET_WATCHDOG, boot.reset_cause);
}

TEST(it_tells_of_the_machines_last_crash)
{
    static const struct crash crash = {.cause = 3, .count = 1, .values = {0x12345678}};
    struct octet_crash_t told;

    fake.crash = &crash;
    report_anew();
    TEST_ASSERT_EQUAL(0, octet_crash_unpack(&told, told_in(OCTET_CRASH_FRAME_ID), OCTET_CRASH_LENGTH));
    TEST_ASSERT_EQUAL_HEX32(0x12345678, told.value);
}

static struct octet_health_t health(void)
{
    struct octet_health_t told;

    report_anew();
    TEST_ASSERT_EQUAL(0, octet_health_unpack(&told, told_in(OCTET_HEALTH_FRAME_ID), OCTET_HEALTH_LENGTH));
    return told;
}

TEST(it_tells_whether_the_clock_is_exact)
{
    TEST_ASSERT_EQUAL_UINT8(0, health().clock);
    fake.clock_exact = true;
    TEST_ASSERT_EQUAL_UINT8(1, health().clock);
}

TEST(it_reports_the_state_of_the_bus)
{
    fake.bus = (struct link_health){.state = BUS_PASSIVE, .tx_errors = 130, .rx_errors = 7};
    TEST_ASSERT_EQUAL_UINT8(BUS_PASSIVE, health().bus_state);
    TEST_ASSERT_EQUAL_UINT8(130, health().tx_errors);
    TEST_ASSERT_EQUAL_UINT8(7, health().rx_errors);
}

TEST(the_bus_is_looked_at_for_a_report_only)
{
    static const struct output drive = {.has_drive = true};

    TEST_ASSERT_EQUAL(0, hal_send(hal, &drive));
    TEST_ASSERT_EQUAL_UINT(0, fake.looks_at_health);
    TEST_ASSERT_EQUAL(0, hal_send(hal, &REPORT));
    TEST_ASSERT_EQUAL_UINT(1, fake.looks_at_health);
}

TEST(every_byte_that_was_put_off_is_stored)
{
    static const uint8_t memory[CELL_COUNT] = {0x0F, 2, 3, 4, 5, 6, 7, 8};

    fake.needs_rest = true;
    TEST_ASSERT_EQUAL(0, hal_store(hal, memory, false));
    TEST_ASSERT_EQUAL(INPUT_SILENCE, hal_receive(hal, &in));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(memory, fake.stored, CELL_COUNT);
}
