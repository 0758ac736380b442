#include "hal/protocol/session.h"

#include <unity.h>

#include "hal/protocol/e2e.h"

enum { OURS = 1, THEIRS = 2 };

static struct session session;
static enum result why;
static unsigned missed;

void setUp(void)
{
    session = (struct session){.owner = 0};
    missed = 999;
}

void tearDown(void) {}

static enum arrival command(enum opcode opcode, uint8_t counter, uint8_t owner)
{
    const struct request request = {.command = {.opcode = opcode}, .counter = counter, .owner = owner};

    return session_request(&session, &request, &why);
}

static enum arrival start(bool lockstep)
{
    const struct request request = {
        .command = {.opcode = OPCODE_START}, .counter = 1, .owner = OURS, .lockstep = lockstep};
    enum arrival arrival = session_request(&session, &request, &why);

    session_executed(&session, RESULT_DONE);
    return arrival;
}

static enum arrival tick(unsigned ticks)
{
    return session_senses(&session, (uint8_t)ticks, (uint8_t)(ticks % E2E_COUNTERS), &missed);
}

static void refuses(enum result expected, enum opcode opcode, uint8_t counter, uint8_t owner)
{
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, command(opcode, counter, owner));
    TEST_ASSERT_EQUAL(expected, why);
}

static void test_without_an_owner_whatever_comes_is_taken(void)
{
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_STOP, 9, THEIRS));
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_ERASE, 3, OURS));
    TEST_ASSERT_EQUAL_UINT8(0, session.owner);
}

static void test_start_makes_its_sender_the_owner(void)
{
    start(0);
    TEST_ASSERT_EQUAL_UINT8(OURS, session.owner);
}

static void test_a_start_that_the_robot_refused_makes_no_owner(void)
{
    command(OPCODE_START, 1, OURS);
    session_executed(&session, RESULT_UNKNOWN_PROFILE);
    TEST_ASSERT_EQUAL_UINT8(0, session.owner);
    TEST_ASSERT_FALSE(session.lockstep);
}

static void test_only_start_says_whose_clock_counts(void)
{
    start(1);
    TEST_ASSERT_TRUE(session.lockstep);
    command(OPCODE_FREEZE, 2, OURS);
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_TRUE(session.lockstep);
}

static void test_other_senders_are_refused(void)
{
    start(0);
    refuses(RESULT_OWNED, OPCODE_ERASE, 2, THEIRS);
    refuses(RESULT_OWNED, OPCODE_START, 2, THEIRS);
}

static void test_anybody_may_stop_the_robot(void)
{
    start(0);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_STOP, 9, THEIRS));
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_EQUAL_UINT8(0, session.owner);
}

static void test_resume_makes_an_owner_again(void)
{
    start(1);
    command(OPCODE_STOP, 2, OURS);
    session_executed(&session, RESULT_DONE);
    command(OPCODE_RESUME, 3, OURS);
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_EQUAL_UINT8(OURS, session.owner);
    TEST_ASSERT_TRUE(session.lockstep);
}

static void test_an_owner_whose_senses_fail_to_come_has_lost_the_robot(void)
{
    start(0);
    session.hears = false;
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_START, 9, THEIRS));
}

static void test_an_owner_whose_senses_come_again_is_the_owner_again(void)
{
    start(0);
    session.hears = false;
    tick(0);
    refuses(RESULT_OWNED, OPCODE_ERASE, 2, THEIRS);
}

static void test_the_owners_counter_goes_on_by_1_to_7(void)
{
    for (uint8_t counter = 0; counter < E2E_COUNTERS; counter++) {
        bool ahead = counter >= 2 && counter <= 8;

        setUp();
        start(0);
        if (ahead)
            TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_ERASE, counter, OURS));
        else
            refuses(RESULT_OUT_OF_SEQUENCE, OPCODE_ERASE, counter, OURS);
    }
}

static void test_an_owners_old_stop_does_not_stop_the_robot(void)
{
    start(0);
    refuses(RESULT_OUT_OF_SEQUENCE, OPCODE_STOP, 0, OURS);
}

static void test_the_same_command_again_is_told_apart(void)
{
    start(0);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_ERASE, 2, OURS));
    TEST_ASSERT_EQUAL(ARRIVAL_AGAIN, command(OPCODE_ERASE, 2, OURS));
}

static void test_a_command_that_differs_in_anything_is_another(void)
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

static void test_the_first_command_is_none_again_whatever_it_is(void)
{
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command((enum opcode)0, 0, 0));
    TEST_ASSERT_EQUAL(ARRIVAL_AGAIN, command((enum opcode)0, 0, 0));
}

static void test_any_tick_may_be_the_first(void)
{
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(200));
    TEST_ASSERT_EQUAL_UINT(0, missed);
}

static void test_up_to_14_ticks_ahead_are_fresh(void)
{
    for (unsigned ahead = 0; ahead < 256; ahead++) {
        setUp();
        tick(300);
        TEST_ASSERT_EQUAL(ahead >= 1 && ahead <= SESSION_WINDOW ? ARRIVAL_FRESH : ARRIVAL_STALE, tick(300 + ahead));
    }
}

static void test_ticks_that_were_left_out_are_counted(void)
{
    tick(254);
    tick(258);
    TEST_ASSERT_EQUAL_UINT(3, missed);
}

static void test_a_tick_of_a_round_ago_is_stale(void)
{
    tick(0);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(257));   /* tick 1, but not its counter */
}

static void test_the_counter_goes_on_with_the_tick(void)
{
    for (uint8_t counter = 0; counter < E2E_COUNTERS; counter++) {
        setUp();
        tick(5);
        TEST_ASSERT_EQUAL(counter == 8 ? ARRIVAL_FRESH : ARRIVAL_STALE, session_senses(&session, 8, counter, &missed));
    }
}

static void test_stale_senses_change_nothing(void)
{
    tick(5);
    tick(3);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(6));
}

static void test_in_lockstep_only_the_next_tick_is_fresh(void)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(7));
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(4));
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(6));
}

static void test_in_lockstep_the_last_tick_may_come_again(void)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_AGAIN, tick(5));
}

static void test_in_lockstep_the_last_tick_with_another_counter_is_stale(void)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, session_senses(&session, 5, 6, &missed));
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, session_senses(&session, 5, 4, &missed));
}

static void test_in_lockstep_another_tick_with_the_last_counter_is_stale(void)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(5 + E2E_COUNTERS));
}

static void test_on_its_own_clock_the_last_tick_again_is_stale(void)
{
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(5));
}

static void test_after_start_and_stop_any_tick_is_taken(void)
{
    tick(100);
    start(1);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(50));
    session_end(&session);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(20));
}

static void test_after_a_refused_start_the_tick_must_go_on(void)
{
    tick(100);
    command(OPCODE_START, 1, OURS);
    session_executed(&session, RESULT_UNKNOWN_PROFILE);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(50));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_without_an_owner_whatever_comes_is_taken);
    RUN_TEST(test_start_makes_its_sender_the_owner);
    RUN_TEST(test_a_start_that_the_robot_refused_makes_no_owner);
    RUN_TEST(test_only_start_says_whose_clock_counts);
    RUN_TEST(test_other_senders_are_refused);
    RUN_TEST(test_anybody_may_stop_the_robot);
    RUN_TEST(test_resume_makes_an_owner_again);
    RUN_TEST(test_an_owner_whose_senses_fail_to_come_has_lost_the_robot);
    RUN_TEST(test_an_owner_whose_senses_come_again_is_the_owner_again);
    RUN_TEST(test_the_owners_counter_goes_on_by_1_to_7);
    RUN_TEST(test_an_owners_old_stop_does_not_stop_the_robot);
    RUN_TEST(test_the_same_command_again_is_told_apart);
    RUN_TEST(test_a_command_that_differs_in_anything_is_another);
    RUN_TEST(test_the_first_command_is_none_again_whatever_it_is);
    RUN_TEST(test_any_tick_may_be_the_first);
    RUN_TEST(test_up_to_14_ticks_ahead_are_fresh);
    RUN_TEST(test_ticks_that_were_left_out_are_counted);
    RUN_TEST(test_a_tick_of_a_round_ago_is_stale);
    RUN_TEST(test_the_counter_goes_on_with_the_tick);
    RUN_TEST(test_stale_senses_change_nothing);
    RUN_TEST(test_in_lockstep_only_the_next_tick_is_fresh);
    RUN_TEST(test_in_lockstep_the_last_tick_may_come_again);
    RUN_TEST(test_in_lockstep_the_last_tick_with_another_counter_is_stale);
    RUN_TEST(test_in_lockstep_another_tick_with_the_last_counter_is_stale);
    RUN_TEST(test_on_its_own_clock_the_last_tick_again_is_stale);
    RUN_TEST(test_after_start_and_stop_any_tick_is_taken);
    RUN_TEST(test_after_a_refused_start_the_tick_must_go_on);
    return UNITY_END();
}
