/* Which commands a session accepts, and from whom. */
#include "tests/test.h"
#include "hal/protocol/e2e.h"
#include "hal/protocol/session.h"

/* A session without an owner. */

enum { OURS = 1, THEIRS = 2 };

static struct session session;
static enum result why;   /* the last command was refused */
static unsigned missed;   /* ticks before the last senses; 999: not set */

void setUp(void)
{
    session = (struct session){.owner = 0};
    missed = 999;
}

static enum arrival command(enum opcode opcode, uint8_t counter, uint8_t owner)
{
    const struct request request = {.command = {.opcode = opcode}, .counter = counter, .owner = owner};

    return session_request(&session, &request, &why);
}

/* From OURS, with counter 1, and the robot does it. */
static enum arrival start(bool lockstep)
{
    const struct request request = {
        .command = {.opcode = OPCODE_START}, .counter = 1, .owner = OURS, .lockstep = lockstep};
    enum arrival arrival = session_request(&session, &request, &why);

    session_executed(&session, RESULT_DONE);
    return arrival;
}

/* Senses of that tick, with its counter. */
static enum arrival tick(unsigned ticks)
{
    return session_senses(&session, (uint8_t)ticks, (uint8_t)(ticks % E2E_COUNTERS), &missed);
}

/* Such a command is refused with this reason. */
static void assert_refused(enum result expected, enum opcode opcode, uint8_t counter, uint8_t owner)
{
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, command(opcode, counter, owner));
    TEST_ASSERT_EQUAL(expected, why);
}

TEST(session_without_owner_accepts_any_command)
{
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_STOP, 9, THEIRS));
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_ERASE, 3, OURS));
    TEST_ASSERT_EQUAL_UINT8(0, session.owner);
}

TEST(refused_start_makes_no_owner)
{
    command(OPCODE_START, 1, OURS);
    session_executed(&session, RESULT_UNKNOWN_PROFILE);
    TEST_ASSERT_EQUAL_UINT8(0, session.owner);
    TEST_ASSERT_FALSE(session.lockstep);
}

TEST(only_start_sets_lockstep)
{
    start(1);
    TEST_ASSERT_TRUE(session.lockstep);
    command(OPCODE_FREEZE, 2, OURS);
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_TRUE(session.lockstep);
}

TEST(resume_restores_the_owner)
{
    start(1);
    command(OPCODE_STOP, 2, OURS);
    session_executed(&session, RESULT_DONE);
    command(OPCODE_RESUME, 3, OURS);
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_EQUAL_UINT8(OURS, session.owner);
    TEST_ASSERT_TRUE(session.lockstep);
}

TEST(returning_senses_restore_the_owner)
{
    start(0);
    session.hears = false;
    tick(0);
    assert_refused(RESULT_OWNED, OPCODE_ERASE, 2, THEIRS);
}

TEST(owner_counter_may_advance_by_1_to_7)
{
    for (uint8_t counter = 0; counter < E2E_COUNTERS; counter++) {
        bool ahead = counter >= 2 && counter <= 8;

        setUp();
        start(0);
        if (ahead)
            TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_ERASE, counter, OURS));
        else
            assert_refused(RESULT_OUT_OF_SEQUENCE, OPCODE_ERASE, counter, OURS);
    }
}

TEST(old_stop_of_the_owner_is_refused)
{
    start(0);
    assert_refused(RESULT_OUT_OF_SEQUENCE, OPCODE_STOP, 0, OURS);
}

TEST(command_differing_in_any_field_is_no_repetition)
{
    static const struct request first = {{OPCODE_SET, 1, 2}, 3, OURS, false};
    static const struct request others[] = {
        {{OPCODE_GET, 1, 2}, 3, OURS, false}, {{OPCODE_SET, 2, 2}, 3, OURS, false},
        {{OPCODE_SET, 1, 3}, 3, OURS, false}, {{OPCODE_SET, 1, 2}, 4, OURS, false},
        {{OPCODE_SET, 1, 2}, 3, THEIRS, false}, {{OPCODE_SET, 1, 2}, 3, OURS, true},
    };

    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, session_request(&session, &first, &why));
    for (unsigned i = 0; i < sizeof others / sizeof *others; i++) {
        TEST_ASSERT_EQUAL(ARRIVAL_FRESH, session_request(&session, &others[i], &why));
        TEST_ASSERT_EQUAL(ARRIVAL_FRESH, session_request(&session, &first, &why));
    }
}

TEST(first_command_is_no_repetition)
{
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command((enum opcode)0, 0, 0));
    TEST_ASSERT_EQUAL(ARRIVAL_AGAIN, command((enum opcode)0, 0, 0));
}

/* Which senses are fresh, in lockstep and on the robot's own clock. */

TEST(first_tick_may_have_any_number)
{
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(200));
    TEST_ASSERT_EQUAL_UINT(0, missed);
}

TEST(senses_up_to_14_ticks_ahead_are_fresh)
{
    for (unsigned ahead = 0; ahead < 256; ahead++) {
        setUp();
        tick(300);
        TEST_ASSERT_EQUAL(ahead >= 1 && ahead <= SESSION_WINDOW ? ARRIVAL_FRESH : ARRIVAL_STALE, tick(300 + ahead));
    }
}

TEST(skipped_ticks_are_counted)
{
    tick(254);
    tick(258);
    TEST_ASSERT_EQUAL_UINT(3, missed);
}

TEST(tick_of_another_wrap_is_stale)
{
    tick(0);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(257));   /* tick 1, but not its counter */
}

TEST(counter_must_advance_with_the_tick)
{
    for (uint8_t counter = 0; counter < E2E_COUNTERS; counter++) {
        setUp();
        tick(5);
        TEST_ASSERT_EQUAL(counter == 8 ? ARRIVAL_FRESH : ARRIVAL_STALE, session_senses(&session, 8, counter, &missed));
    }
}

TEST(lockstep_accepts_the_last_tick_again)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_AGAIN, tick(5));
}

TEST(lockstep_last_tick_with_another_counter_is_stale)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, session_senses(&session, 5, 6, &missed));
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, session_senses(&session, 5, 4, &missed));
}

TEST(lockstep_other_tick_with_the_last_counter_is_stale)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(5 + E2E_COUNTERS));
}

TEST(start_and_stop_accept_any_next_tick)
{
    tick(100);
    start(1);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(50));
    session_end(&session);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(20));
}

TEST(refused_start_keeps_the_expected_tick)
{
    tick(100);
    command(OPCODE_START, 1, OURS);
    session_executed(&session, RESULT_UNKNOWN_PROFILE);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(50));
}
