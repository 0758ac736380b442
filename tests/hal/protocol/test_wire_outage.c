/* Senses that come late, not at all, or after an outage. */
#include "tests/test.h"
#include "reading_rig.h"

TEST(stale_senses_are_counted_and_not_answered)
{
    read_tick(5);
    refuse(senses_frame(NODE, 4));
    expect(FAULT_STALE, 1);
    TEST_ASSERT_NULL(wire.again);
}

TEST(ticks_that_never_came_are_counted)
{
    read_tick(254);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(258));
    expect(FAULT_MISSED, 3);
}

TEST(after_an_outage_any_tick_is_taken)
{
    read_tick(100);
    wire_outage(&wire);
    expect(FAULT_SILENCE, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(50));
}

TEST(an_outage_is_counted_once_however_long)
{
    read_tick(100);
    for (unsigned i = 0; i < 10; i++)
        wire_outage(&wire);
    expect(FAULT_SILENCE, 1);
}

TEST(before_the_first_senses_there_is_no_outage)
{
    wire_outage(&wire);
}

TEST(in_lockstep_an_outage_is_no_fault)
{
    start(1, 0);
    read_tick(5);
    wire_outage(&wire);
    refuse(senses_frame(NODE, 9));   /* the tick must go on as before */
    expect(FAULT_STALE, 1);
}

TEST(an_outage_loses_the_owner_the_robot)
{
    start(1, 0);
    wire_outage(&wire);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_of(OPCODE_ERASE, 9, OWNER + 1)));
}
