/* When silence begins, to the millisecond, and what waits when it has ended. */
#include "fake_body.h"

#include "tests/hal/protocol/wire_frames.h"

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
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    for (unsigned tick = 1; tick <= 5; tick++)
        senses_come(20u * tick, tick);
    fake.clock_ms += HAL_SILENCE_MS;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(5, in.senses.tick);
}

TEST(held_up_for_less_it_takes_the_next_senses)
{
    senses_come(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    for (unsigned tick = 1; tick <= 5; tick++)
        senses_come(19u * tick, tick);
    fake.clock_ms += HAL_SILENCE_MS - 1;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
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
