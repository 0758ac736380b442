/* Senses that come late, not at all, or after an outage. */
#include <unity.h>

#include "reading_rig.h"

static void test_stale_senses_are_counted_and_not_answered(void)
{
    read_tick(5);
    refuse(senses_frame(NODE, 4));
    expect(FAULT_STALE, 1);
    TEST_ASSERT_NULL(wire.again);
}

static void test_ticks_that_never_came_are_counted(void)
{
    read_tick(254);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(258));
    expect(FAULT_MISSED, 3);
}

static void test_after_an_outage_any_tick_is_taken(void)
{
    read_tick(100);
    wire_outage(&wire);
    expect(FAULT_SILENCE, 1);
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(50));
}

static void test_an_outage_is_counted_once_however_long(void)
{
    read_tick(100);
    for (unsigned i = 0; i < 10; i++)
        wire_outage(&wire);
    expect(FAULT_SILENCE, 1);
}

static void test_before_the_first_senses_there_is_no_outage(void)
{
    wire_outage(&wire);
}

static void test_in_lockstep_an_outage_is_no_fault(void)
{
    start(1, 0);
    read_tick(5);
    wire_outage(&wire);
    refuse(senses_frame(NODE, 9));   /* the tick must go on as before */
    expect(FAULT_STALE, 1);
}

static void test_an_outage_loses_the_owner_the_robot(void)
{
    start(1, 0);
    wire_outage(&wire);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(command_of(OPCODE_ERASE, 9, OWNER + 1)));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_stale_senses_are_counted_and_not_answered);
    RUN_TEST(test_ticks_that_never_came_are_counted);
    RUN_TEST(test_after_an_outage_any_tick_is_taken);
    RUN_TEST(test_an_outage_is_counted_once_however_long);
    RUN_TEST(test_before_the_first_senses_there_is_no_outage);
    RUN_TEST(test_in_lockstep_an_outage_is_no_fault);
    RUN_TEST(test_an_outage_loses_the_owner_the_robot);
    return UNITY_END();
}
