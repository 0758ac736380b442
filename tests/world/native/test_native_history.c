/* Trials and their results, lessons and who gave them, and the use of each cell. */
#include "host_sim/world/native/history.h"
#include "tests/test.h"

enum { FRONT = 2, FRONT_RIGHT_TOO = 3 };   /* patterns */

static const uint8_t NOTHING[CELL_COUNT], LEARNED[CELL_COUNT] = {[FRONT_RIGHT_TOO] = SIDE_LEFT};

static struct history history;
static struct history_tick what;

void setUp(void)
{
    history_begin(&history, NOTHING);
    what = (struct history_tick){.action = 1, .reason = REASON_WANDER, .left_mm_s = 200, .right_mm_s = 200};
}

/* The next action, for a reason. */
static void begin(double tick, int32_t pattern, enum reason reason, const uint8_t sides[CELL_COUNT])
{
    what.action++;
    what.feel = pattern << 1;
    what.reason = (int32_t)reason;
    history_take(&history, tick, &what, sides);
}

static void try_left(double tick)
{
    what.left_mm_s = -200;
    begin(tick, FRONT_RIGHT_TOO, REASON_TRIAL, NOTHING);
}

static void expect_lesson(int32_t cell, int32_t side, int32_t by_hand)
{
    TEST_ASSERT_EQUAL_UINT32(1, history.lesson_count);
    TEST_ASSERT_EQUAL_INT32(cell, history.lessons[0].cell);
    TEST_ASSERT_EQUAL_INT32(side, history.lessons[0].side);
    TEST_ASSERT_EQUAL_INT32(by_hand, history.lessons[0].by_hand);
    TEST_ASSERT_EQUAL_INT32(by_hand, history.by_hand[cell]);
}

TEST(in_the_beginning_nothing_was_learned)
{
    TEST_ASSERT_EQUAL_INT32(-1, history.action);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, history.trial.tick);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, history.learned[3]);
    TEST_ASSERT_EQUAL_INT32(0, history.trials);
}

TEST(a_trial_is_under_way_until_the_next_action)
{
    try_left(7.0);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, history.trial.tick);
    TEST_ASSERT_EQUAL_INT32(FRONT_RIGHT_TOO, history.trial.cell);
    TEST_ASSERT_EQUAL_INT32(SIDE_LEFT, history.trial.side);
    TEST_ASSERT_EQUAL_INT32(-1, history.trial.helped);
    TEST_ASSERT_EQUAL_INT32(1, history.trials);
    history_take(&history, 8.0, &what, NOTHING);
    TEST_ASSERT_EQUAL_INT32(-1, history.trial.helped);
    TEST_ASSERT_EQUAL_INT32(1, history.trials);
}

TEST(a_trial_helps_if_fewer_sensors_are_triggered)
{
    try_left(7.0);
    begin(9.0, FRONT, REASON_WANDER, LEARNED);
    TEST_ASSERT_EQUAL_INT32(1, history.trial.helped);
    TEST_ASSERT_EQUAL_INT32(0, history.trial.frozen);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_LEFT, 0);
    TEST_ASSERT_EQUAL_DOUBLE(9.0, history.learned[FRONT_RIGHT_TOO]);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, history.trial.tick);
}

TEST(a_trial_that_does_not_help_teaches_nothing)
{
    try_left(7.0);
    history.frozen = true;
    begin(9.0, FRONT_RIGHT_TOO, REASON_WANDER, LEARNED);
    TEST_ASSERT_EQUAL_INT32(0, history.trial.helped);
    TEST_ASSERT_EQUAL_INT32(1, history.trial.frozen);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_LEFT, 1);
}

TEST(a_right_turn_has_the_faster_left_wheel)
{
    what.right_mm_s = -200;
    begin(3.0, FRONT, REASON_TRIAL, NOTHING);
    TEST_ASSERT_EQUAL_INT32(SIDE_RIGHT, history.trial.side);
}

TEST(another_turn_than_the_tried_one_was_told)
{
    static const uint8_t right[CELL_COUNT] = {[FRONT_RIGHT_TOO] = SIDE_RIGHT}, elsewhere[CELL_COUNT] = {[FRONT] = SIDE_LEFT};

    try_left(7.0);
    begin(9.0, 0, REASON_WANDER, right);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_RIGHT, 1);
    history_begin(&history, NOTHING);
    try_left(11.0);
    begin(12.0, 0, REASON_WANDER, elsewhere);
    expect_lesson(FRONT, SIDE_LEFT, 1);
}

TEST(the_use_of_a_remembered_turn_is_counted_until_it_changes)
{
    history_begin(&history, LEARNED);
    begin(1.0, FRONT_RIGHT_TOO, REASON_REMEMBERED, LEARNED);
    begin(2.0, FRONT_RIGHT_TOO, REASON_REMEMBERED, LEARNED);
    TEST_ASSERT_EQUAL_INT32(2, history.uses[FRONT_RIGHT_TOO]);
    begin(3.0, 0, REASON_WANDER, NOTHING);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_NOTHING, 0);
    TEST_ASSERT_EQUAL_INT32(0, history.uses[FRONT_RIGHT_TOO]);
}

TEST(only_a_robot_that_may_forget_erases_by_itself)
{
    history_begin(&history, LEARNED);
    begin(1.0, 0, REASON_WANDER, NOTHING);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_NOTHING, 1);
    history_begin(&history, LEARNED);
    begin(2.0, 0, REASON_BOREDOM, NOTHING);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_NOTHING, 0);
    history_begin(&history, LEARNED);
    begin(3.0, FRONT_RIGHT_TOO, REASON_REMEMBERED, NOTHING);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_NOTHING, 0);
}

TEST(within_an_action_turns_are_told)
{
    try_left(7.0);
    history_take(&history, 8.0, &what, LEARNED);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_LEFT, 1);
    history_relearn(&history, 9.0, NOTHING);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_NOTHING, 1);
    history_relearn(&history, 10.0, NOTHING);
    TEST_ASSERT_EQUAL_UINT32(0, history.lesson_count);
}

TEST(ticks_that_are_passed_over_leave_their_action)
{
    const struct history_tick last = {.action = 5, .reason = REASON_REMEMBERED};

    history_begin(&history, LEARNED);
    history_pass_over(&history, &last, FRONT);
    TEST_ASSERT_EQUAL_INT32(FRONT, history.pattern);
    what.action = 5;
    history_take(&history, 4.0, &what, LEARNED);
    TEST_ASSERT_EQUAL_INT32(FRONT, history.pattern);
    begin(5.0, 0, REASON_WANDER, NOTHING);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_NOTHING, 0);
}

TEST(a_robot_that_is_started_again_has_learned_nothing_here)
{
    try_left(7.0);
    begin(9.0, FRONT, REASON_WANDER, LEARNED);
    history.frozen = true;
    history_restart(&history, NOTHING);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, history.trial.tick);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, history.learned[FRONT_RIGHT_TOO]);
    TEST_ASSERT_EQUAL_UINT8(SIDE_NOTHING, history.sides[FRONT_RIGHT_TOO]);
    TEST_ASSERT_FALSE(history.frozen);
    TEST_ASSERT_EQUAL_UINT32(0, history.lesson_count);
    TEST_ASSERT_EQUAL_INT32(1, history.trials);
}
