/* Whose commands count, and which. */
#include "session_rig.h"

TEST(without_an_owner_whatever_comes_is_taken)
{
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_STOP, 9, THEIRS));
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_ERASE, 3, OURS));
    TEST_ASSERT_EQUAL_UINT8(0, session.owner);
}

TEST(start_makes_its_sender_the_owner)
{
    start(0);
    TEST_ASSERT_EQUAL_UINT8(OURS, session.owner);
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

TEST(other_senders_are_refused)
{
    start(0);
    refuses(RESULT_OWNED, OPCODE_ERASE, 2, THEIRS);
    refuses(RESULT_OWNED, OPCODE_START, 2, THEIRS);
}

TEST(anybody_may_stop_the_robot)
{
    start(0);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_STOP, 9, THEIRS));
    session_executed(&session, RESULT_DONE);
    TEST_ASSERT_EQUAL_UINT8(0, session.owner);
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

TEST(an_owner_whose_senses_fail_to_come_has_lost_the_robot)
{
    start(0);
    session.hears = false;
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_START, 9, THEIRS));
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

TEST(the_same_command_again_is_told_apart)
{
    start(0);
    TEST_ASSERT_EQUAL(ARRIVAL_FRESH, command(OPCODE_ERASE, 2, OURS));
    TEST_ASSERT_EQUAL(ARRIVAL_AGAIN, command(OPCODE_ERASE, 2, OURS));
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
