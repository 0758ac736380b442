/* What a loop keeps of its ticks: poses, rows, actions and decisions. */
#include "loop_rig.h"

#include <string.h>

TEST(ticks_are_recorded)
{
    world.bodies[1].feel = FEEL_FRONT;
    world.bodies[1].lifted = true;
    loop_run(&loop, 2);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0, poses[0][0]);
    TEST_ASSERT_EQUAL_DOUBLE(1008.0, poses[0][LOOP_POSE]);
    TEST_ASSERT_EQUAL_INT16(1, rows[1][LOOP_ROW]);       /* tick */
    TEST_ASSERT_EQUAL_INT16(4, rows[1][1]);              /* feel */
    TEST_ASSERT_EQUAL_INT16(200, rows[1][8]);            /* left wheel */
    TEST_ASSERT_EQUAL_INT16(2, rows[1][14]);             /* pattern */
    TEST_ASSERT_EQUAL_INT16(1, rows[1][15]);             /* lifted */
    TEST_ASSERT_EQUAL_INT16(0, rows[0][15]);
}

TEST(actions_are_counted_when_they_begin)
{
    loop_run(&loop, 2);
    octets[0].action = 2;
    octets[0].reason = REASON_LOOK_AROUND;
    loop_run(&loop, 2);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_WANDER]);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_LOOK_AROUND]);
    TEST_ASSERT_EQUAL_size_t(0, robots[0].decision_count);
}

TEST(the_pattern_is_that_of_the_tick_in_which_the_action_began)
{
    world.bodies[0].feel = FEEL_FRONT_RIGHT;
    loop_run(&loop, 1);
    world.bodies[0].feel = 0;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT8(1, robots[0].pattern);
    octets[0].action = 2;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT8(0, robots[0].pattern);
}

static void begins(enum reason reason)
{
    octets[0].action++;
    octets[0].reason = reason;
    loop_run(&loop, 1);
}

TEST(decisions_to_learn_from_are_noted)
{
    begins(REASON_TRIAL);
    TEST_ASSERT_EQUAL_size_t(1, robots[0].decision_count);
    begins(REASON_WANDER);   /* the trial's end */
    TEST_ASSERT_EQUAL_size_t(1, robots[0].decision_count);
    begins(REASON_WANDER);
    TEST_ASSERT_EQUAL_size_t(0, robots[0].decision_count);
    begins(REASON_REMEMBERED);
    TEST_ASSERT_EQUAL_size_t(1, robots[0].decision_count);
    TEST_ASSERT_EQUAL_UINT32(0, decisions[0][0]);
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_size_t(0, robots[0].decision_count);
}

TEST(a_tick_that_was_done_elsewhere_is_recorded_like_all)
{
    int16_t *row = rows[0] + 2 * LOOP_ROW;

    loop_run(&loop, 2);
    memcpy(row, rows[0] + LOOP_ROW, 14 * sizeof *row);
    row[1] = FEEL_FRONT;
    row[10] = REASON_TRIAL;
    row[12] = 5;
    world.bodies[0].x_mm = 77.0;
    world.bodies[0].lifted = true;
    loop_record(&loop);
    TEST_ASSERT_EQUAL_UINT32(3, loop.ticks);
    TEST_ASSERT_EQUAL_UINT32(3, loop.tick);
    TEST_ASSERT_EQUAL_DOUBLE(77.0, poses[0][2 * LOOP_POSE]);
    TEST_ASSERT_EQUAL_INT16(2, row[14]);
    TEST_ASSERT_EQUAL_INT16(1, row[15]);
    TEST_ASSERT_EQUAL_UINT8(5, robots[0].action);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_TRIAL]);
    TEST_ASSERT_EQUAL_size_t(1, robots[0].decision_count);
    TEST_ASSERT_EQUAL_UINT32(2, decisions[0][0]);
}
