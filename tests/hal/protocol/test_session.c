/* Whose commands count, and which. */
#include "session_rig.h"

TEST(without_an_owner_whatever_comes_is_taken)
{
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_STOP, 9, THEIRS));
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_ERASE, 3, OURS));
    TEST_ASSERT_EQUAL_UINT8(0, session.owner);
}

TEST(a_start_that_the_robot_refused_makes_no_owner)
{
    command(OPCODE_START, 1, OURS);
    session_executed(&session, RESULT_UNKNOWN_PROFILE);
    TEST_ASSERT_EQUAL_UINT8(0, session.owner);
    TEST_ASSERT_FALSE(session.lockstep);
}

TEST(only_start_says_whose_clock_counts)
{
    start(1);
    TEST_ASSERT_TRUE(session.lockstep);
    command(OPCODE_FREEZE, 2, OURS);
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_TRUE(session.lockstep);
}

TEST(resume_makes_an_owner_again)
{
    start(1);
    command(OPCODE_STOP, 2, OURS);
    session_executed(&session, RESULT_DONE);
    command(OPCODE_RESUME, 3, OURS);
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_EQUAL_UINT8(OURS, session.owner);
    TEST_ASSERT_TRUE(session.lockstep);
}

TEST(an_owner_whose_senses_come_again_is_the_owner_again)
{
    start(0);
    session.hears = false;
    tick(0);
    refuses(RESULT_OWNED, OPCODE_ERASE, 2, THEIRS);
}

TEST(the_owners_counter_goes_on_by_1_to_7)
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

TEST(an_owners_old_stop_does_not_stop_the_robot)
{
    start(0);
    refuses(RESULT_OUT_OF_SEQUENCE, OPCODE_STOP, 0, OURS);
}

TEST(a_command_that_differs_in_anything_is_another)
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

TEST(the_first_command_is_none_again_whatever_it_is)
{
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command((enum opcode)0, 0, 0));
    TEST_ASSERT_EQUAL(ARRIVAL_AGAIN, command((enum opcode)0, 0, 0));
}

/* Which senses are fresh, in lockstep and on the robot's own clock. */

TEST(any_tick_may_be_the_first)
{
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(200));
    TEST_ASSERT_EQUAL_UINT(0, missed);
}

TEST(up_to_14_ticks_ahead_are_fresh)
{
    for (unsigned ahead = 0; ahead < 256; ahead++) {
        setUp();
        tick(300);
        TEST_ASSERT_EQUAL(ahead >= 1 && ahead <= SESSION_WINDOW ? ARRIVAL_FRESH : ARRIVAL_STALE, tick(300 + ahead));
    }
}

TEST(ticks_that_were_left_out_are_counted)
{
    tick(254);
    tick(258);
    TEST_ASSERT_EQUAL_UINT(3, missed);
}

TEST(a_tick_of_a_round_ago_is_stale)
{
    tick(0);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(257));   /* tick 1, but not its counter */
}

TEST(the_counter_goes_on_with_the_tick)
{
    for (uint8_t counter = 0; counter < E2E_COUNTERS; counter++) {
        setUp();
        tick(5);
        TEST_ASSERT_EQUAL(counter == 8 ? ARRIVAL_FRESH : ARRIVAL_STALE, session_senses(&session, 8, counter, &missed));
    }
}

TEST(in_lockstep_the_last_tick_may_come_again)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_AGAIN, tick(5));
}

TEST(in_lockstep_the_last_tick_with_another_counter_is_stale)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, session_senses(&session, 5, 6, &missed));
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, session_senses(&session, 5, 4, &missed));
}

TEST(in_lockstep_another_tick_with_the_last_counter_is_stale)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(5 + E2E_COUNTERS));
}

TEST(after_start_and_stop_any_tick_is_taken)
{
    tick(100);
    start(1);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(50));
    session_end(&session);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(20));
}

TEST(after_a_refused_start_the_tick_must_go_on)
{
    tick(100);
    command(OPCODE_START, 1, OURS);
    session_executed(&session, RESULT_UNKNOWN_PROFILE);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(50));
}
