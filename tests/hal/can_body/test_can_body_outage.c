/* After an outage: of all that queued up meanwhile, the newest senses count. */
#include "fake_body.h"

#include "tests/hal/protocol/wire_frames.h"

TEST(after_an_outage_the_last_senses_count_whatever_their_number)
{
    static const unsigned ticks[] = {1500, 1501, 1502, 0, 1, 2};

    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned i = 0; i < 6; i++)
        senses_come(150, ticks[i]);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT8(2, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 5});
}

TEST(after_an_outage_only_the_newest_senses_count)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned tick = 0; tick < 30; tick++)
        senses_come(150, tick);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(29, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 29});
}

TEST(noise_among_what_queued_up_is_passed_over)
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

TEST(another_robots_memory_that_queued_up_is_passed_over)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    happens(150, 1, memory_frame(NODE + 1, 0, 0));
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    assert_faults((struct octet_faults_t){.stale = 0});
}

TEST(without_an_outage_nothing_is_passed_over)
{
    for (unsigned tick = 0; tick < 30; tick++)
        senses_come(20, tick);
    for (unsigned tick = 0; tick < 30; tick++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
        TEST_ASSERT_EQUAL_UINT16(tick, in.senses.tick);
    }
}

TEST(after_an_outage_a_queued_command_comes_first)
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

TEST(senses_that_a_queued_command_outdates_do_not_end_the_outage)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    command_comes(150, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(200, fake.clock_ms);
}

TEST(a_body_opened_again_has_no_outage)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL(0, open_body());
    senses_come(150, 0);
    senses_come(150, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(0, in.senses.tick);
}

TEST(an_outage_ends_with_its_first_senses)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    senses_come(170, 1);
    senses_come(170, 2);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
}

/* The tick that a robot takes next which was held up, while senses came so many milliseconds apart. */
static unsigned tick_after(uint32_t held_up_ms, unsigned ticks, uint32_t apart_ms)
{
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    for (unsigned tick = 1; tick <= ticks; tick++)
        senses_come(apart_ms * tick, tick);
    fake.clock_ms += held_up_ms;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    return in.senses.tick;
}

TEST(a_robot_that_was_held_up_itself_takes_the_newest_senses)
{
    TEST_ASSERT_EQUAL_UINT(7, tick_after(150, 7, 20));
    assert_faults((struct octet_faults_t){.silences = 1, .stale = 6});
}

TEST(held_up_during_an_outage_it_counts_no_silence)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    fake.clock_ms += HAL_SILENCE_MS;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    assert_faults((struct octet_faults_t){.silences = 0});
}

/* When silence begins, to the millisecond, and what waits when it has ended. */

enum { LOOKS_MAX = 4096 };   /* at the link, for the newest senses */

TEST(silence_counts_from_the_last_senses_whatever_else_comes)
{
    senses_come(50, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    noise_comes(90);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(150, fake.clock_ms);
}

TEST(held_up_for_the_limit_it_takes_the_newest_senses)
{
    TEST_ASSERT_EQUAL_UINT(5, tick_after(HAL_SILENCE_MS, 5, 20));
}

TEST(held_up_for_less_it_takes_the_next_senses)
{
    TEST_ASSERT_EQUAL_UINT(1, tick_after(HAL_SILENCE_MS - 1, 5, 19));
}

TEST(held_up_for_longer_with_nothing_of_use_it_reports_silence_at_once)
{
    noise_comes(10);
    fake.clock_ms += 150;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(150, fake.clock_ms);
}

TEST(looking_for_the_newest_senses_takes_no_time_and_no_look_too_many)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    senses_come(150, 1);
    fake.receives = 0;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT(3, fake.receives);   /* one finds nothing more */
    TEST_ASSERT_EQUAL_UINT32(150, fake.clock_ms);
}

TEST(of_endless_senses_a_limited_number_is_looked_at)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    senses_come(150, 0);
    fake.endless = true;
    fake.receives = 0;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT(1 + LOOKS_MAX, fake.receives);
}

TEST(opened_again_it_has_heard_of_no_silence)
{
    fake.clock_ms += 150;
    fake.closed = true;
    TEST_ASSERT_EQUAL(HAL_E_CLOSED, receive());
    fake.closed = false;
    TEST_ASSERT_EQUAL(0, open_body());
    senses_come(170, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
}
