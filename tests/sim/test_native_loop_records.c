/* What a loop keeps of its ticks: poses, rows and actions. */
#include "loop_rig.h"

#include <string.h>

TEST(ticks_are_recorded)
{
    world.bodies[1].feel = FEEL_FRONT;
    world.bodies[1].lifted = true;
    loop_run(&loop, 2);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0, poses[0][0]);
    TEST_ASSERT_EQUAL_DOUBLE(1008.0, poses[0][LOOP_POSE]);
    TEST_ASSERT_EQUAL_INT16(1, rows[1][ROW_COUNT + ROW_TICK]);
    TEST_ASSERT_EQUAL_INT16(4, rows[1][ROW_FEEL]);
    TEST_ASSERT_EQUAL_INT16(200, rows[1][ROW_LEFT_MM_S]);
    TEST_ASSERT_EQUAL_INT16(1, rows[1][ROW_LIFTED]);
    TEST_ASSERT_EQUAL_INT16(0, rows[0][ROW_LIFTED]);
}

TEST(actions_are_counted_when_they_begin)
{
    loop_run(&loop, 2);
    octets[0].action = 2;
    octets[0].reason = REASON_LOOK_AROUND;
    loop_run(&loop, 2);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_WANDER]);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_LOOK_AROUND]);
}

TEST(a_tick_that_was_done_elsewhere_is_recorded_like_all)
{
    int16_t *row = rows[0] + 2 * ROW_COUNT;

    loop_run(&loop, 2);
    memcpy(row, rows[0] + ROW_COUNT, ROW_PATTERN * sizeof *row);
    row[ROW_FEEL] = FEEL_FRONT;
    row[ROW_REASON] = REASON_TRIAL;
    row[ROW_ACTION] = 5;
    world.bodies[0].x_mm = 77.0;
    world.bodies[0].lifted = true;
    loop_record(&loop);
    TEST_ASSERT_EQUAL_UINT32(3, loop.ticks);
    TEST_ASSERT_EQUAL_UINT32(3, loop.tick);
    TEST_ASSERT_EQUAL_DOUBLE(77.0, poses[0][2 * LOOP_POSE]);
    TEST_ASSERT_EQUAL_INT16(1, row[ROW_LIFTED]);
    TEST_ASSERT_EQUAL_UINT8(5, robots[0].action);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_TRIAL]);
}
