/* Which senses are fresh, in lockstep and on the robot's own clock. */
#include "session_rig.h"

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

TEST(stale_senses_change_nothing)
{
    tick(5);
    tick(3);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(6));
}

TEST(in_lockstep_only_the_next_tick_is_fresh)
{
    start(1);
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(7));
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(4));
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, tick(6));
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

TEST(on_its_own_clock_the_last_tick_again_is_stale)
{
    tick(5);
    TEST_ASSERT_EQUAL(ARRIVAL_STALE, tick(5));
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
