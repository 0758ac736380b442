/* After an outage, only the newest of the queued senses count. */
#include "fake_body.h"

#include "tests/hal/protocol/wire_frames.h"

TEST(last_queued_senses_count_whatever_their_tick)
{
    static const unsigned ticks[] = {1500, 1501, 1502, 0, 1, 2};

    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned i = 0; i < 6; i++)
        script_senses(150, ticks[i]);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT8(2, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 5});
}

TEST(only_newest_senses_count_after_an_outage)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    for (unsigned tick = 0; tick < 30; tick++)
        script_senses(150, tick);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(29, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 29});
}

TEST(queued_noise_is_skipped_and_counted)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    script_senses(150, 0);
    script_noise(150);
    script_event(150, LINK_E_GARBLED, (struct frame){.len = 0});
    script_senses(150, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 1, .foreign = 1, .damaged = 1});
}

TEST(queued_peer_memory_is_skipped)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    script_senses(150, 0);
    script_event(150, 1, memory_frame(NODE + 1, 0, 0));
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    assert_faults((struct octet_faults_t){.stale = 0});
}

TEST(senses_without_an_outage_are_all_received)
{
    for (unsigned tick = 0; tick < 30; tick++)
        script_senses(20, tick);
    for (unsigned tick = 0; tick < 30; tick++) {
        TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
        TEST_ASSERT_EQUAL_UINT16(tick, in.senses.tick);
    }
}

TEST(queued_command_comes_before_the_newest_senses)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    script_senses(150, 0);
    script_command(150, (struct octet_command_t){.opcode = OPCODE_ERASE});
    script_senses(150, 1);
    script_senses(150, 2);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(2, in.senses.tick);
    assert_faults((struct octet_faults_t){.stale = 2});
}

TEST(senses_before_a_queued_command_do_not_end_the_outage)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    script_senses(150, 0);
    script_command(150, (struct octet_command_t){.opcode = OPCODE_ERASE});
    TEST_ASSERT_EQUAL(INPUT_COMMAND, receive());
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(200, fake.clock_ms);
}

TEST(reopened_body_has_no_outage)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL(0, open_body());
    script_senses(150, 0);
    script_senses(150, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(0, in.senses.tick);
}

TEST(outage_ends_with_the_first_senses)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    script_senses(150, 0);
    script_senses(170, 1);
    script_senses(170, 2);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT16(1, in.senses.tick);
}

/* The tick that a delayed robot takes next; senses come apart_ms apart. */
static unsigned tick_after(uint32_t delay_ms, unsigned ticks, uint32_t apart_ms)
{
    script_senses(0, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    for (unsigned tick = 1; tick <= ticks; tick++)
        script_senses(apart_ms * tick, tick);
    fake.clock_ms += delay_ms;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    return in.senses.tick;
}

TEST(delayed_robot_takes_the_newest_senses)
{
    TEST_ASSERT_EQUAL_UINT(7, tick_after(150, 7, 20));
    assert_faults((struct octet_faults_t){.silences = 1, .stale = 6});
}

TEST(delay_during_an_outage_counts_no_silence)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    script_senses(150, 0);
    fake.clock_ms += HAL_SILENCE_MS;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    assert_faults((struct octet_faults_t){.silences = 0});
}

/* When silence begins, to the millisecond, and which senses count after it. */

enum { RECEIVES_MAX = 4096 };   /* of queued frames, in search of the newest senses */

TEST(silence_counts_from_the_last_senses_despite_noise)
{
    script_senses(50, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    script_noise(90);
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(150, fake.clock_ms);
}

TEST(robot_delayed_for_the_limit_takes_the_newest_senses)
{
    TEST_ASSERT_EQUAL_UINT(5, tick_after(HAL_SILENCE_MS, 5, 20));
}

TEST(robot_delayed_below_the_limit_takes_the_next_senses)
{
    TEST_ASSERT_EQUAL_UINT(1, tick_after(HAL_SILENCE_MS - 1, 5, 19));
}

TEST(delayed_robot_without_senses_reports_silence_at_once)
{
    script_noise(10);
    fake.clock_ms += 150;
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    TEST_ASSERT_EQUAL_UINT32(150, fake.clock_ms);
}

TEST(search_for_newest_senses_does_not_wait)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    script_senses(150, 0);
    script_senses(150, 1);
    fake.receives = 0;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT(3, fake.receives);   /* the last of them finds no frame */
    TEST_ASSERT_EQUAL_UINT32(150, fake.clock_ms);
}

TEST(search_for_newest_senses_is_limited)
{
    TEST_ASSERT_EQUAL(INPUT_SILENCE, receive());
    script_senses(150, 0);
    fake.endless = true;
    fake.receives = 0;
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
    TEST_ASSERT_EQUAL_UINT(1 + RECEIVES_MAX, fake.receives);
}

TEST(reopened_body_counts_no_earlier_silence)
{
    fake.clock_ms += 150;
    fake.closed = true;
    TEST_ASSERT_EQUAL(HAL_E_CLOSED, receive());
    fake.closed = false;
    TEST_ASSERT_EQUAL(0, open_body());
    script_senses(170, 0);
    TEST_ASSERT_EQUAL(INPUT_SENSES, receive());
}
