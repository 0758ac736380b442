/* Trials and their results, lessons and their origin, and the uses of each cell. */
#include "host_sim/world/native/history.h"
#include "tests/test.h"

#include <string.h>

enum { FRONT = 2, FRONT_RIGHT_TOO = 3 };   /* patterns */

static const uint8_t NOTHING[CELL_COUNT], LEARNED[CELL_COUNT] = {[FRONT_RIGHT_TOO] = SIDE_LEFT};

static struct history history;
static struct history_note notes[2];
static int16_t rows[2][ROW_COUNT];

void setUp(void)
{
    static const int16_t wanders[ROW_COUNT] = {[ROW_ACTION] = 1, [ROW_REASON] = REASON_WANDER};

    history_begin(&history, NOTHING);
    memcpy(rows[0], wanders, sizeof wanders);
    memcpy(rows[1], wanders, sizeof wanders);
}

static size_t take(double tick, const uint8_t sides[CELL_COUNT])
{
    size_t count = history_take(&history, tick, rows[0], 1, notes);

    history_learn(&history, tick, sides);
    return count;
}

/* The next action, for a reason. */
static size_t begin(double tick, int16_t pattern, enum reason reason, const uint8_t sides[CELL_COUNT])
{
    rows[0][ROW_ACTION]++;
    rows[0][ROW_FEEL] = (int16_t)(pattern << 1);
    rows[0][ROW_REASON] = (int16_t)reason;
    return take(tick, sides);
}

static void try_left(double tick)
{
    rows[0][ROW_LEFT_MM_S] = -200;
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

TEST(new_history_is_empty)
{
    TEST_ASSERT_EQUAL_INT32(-1, history.action);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, history.trial.tick);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, history.learned[3]);
    TEST_ASSERT_EQUAL_INT32(0, history.trials);
}

TEST(trial_is_pending_until_the_next_action)
{
    try_left(7.0);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, history.trial.tick);
    TEST_ASSERT_EQUAL_INT32(FRONT_RIGHT_TOO, history.trial.cell);
    TEST_ASSERT_EQUAL_INT32(SIDE_LEFT, history.trial.side);
    TEST_ASSERT_EQUAL_INT32(-1, history.trial.helped);
    TEST_ASSERT_EQUAL_INT32(1, history.trials);
    take(8.0, NOTHING);
    TEST_ASSERT_EQUAL_INT32(-1, history.trial.helped);
    TEST_ASSERT_EQUAL_INT32(1, history.trials);
}

TEST(trial_helps_if_fewer_sensors_are_triggered)
{
    try_left(7.0);
    begin(9.0, FRONT, REASON_WANDER, LEARNED);
    TEST_ASSERT_EQUAL_INT32(1, history.trial.helped);
    TEST_ASSERT_EQUAL_INT32(0, history.trial.frozen);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_LEFT, 0);
    TEST_ASSERT_EQUAL_DOUBLE(9.0, history.learned[FRONT_RIGHT_TOO]);
    TEST_ASSERT_EQUAL_DOUBLE(7.0, history.trial.tick);
}

TEST(lesson_after_a_failed_trial_is_by_hand)
{
    try_left(7.0);
    history.frozen = true;
    begin(9.0, FRONT_RIGHT_TOO, REASON_WANDER, LEARNED);
    TEST_ASSERT_EQUAL_INT32(0, history.trial.helped);
    TEST_ASSERT_EQUAL_INT32(1, history.trial.frozen);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_LEFT, 1);
}

TEST(trial_side_is_right_when_the_left_wheel_is_faster)
{
    rows[0][ROW_RIGHT_MM_S] = -200;
    begin(3.0, FRONT, REASON_TRIAL, NOTHING);
    TEST_ASSERT_EQUAL_INT32(SIDE_RIGHT, history.trial.side);
}

TEST(history_counts_a_turn_learned_without_its_trial_as_taught)
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

TEST(generalized_lessons_are_not_by_hand)
{
    static const uint8_t all[CELL_COUNT] = {
        [1] = SIDE_LEFT, [FRONT] = SIDE_LEFT, [3] = SIDE_LEFT, [4] = SIDE_RIGHT, [5] = SIDE_LEFT, [6] = SIDE_LEFT,
    };

    try_left(0.0);
    begin(1.0, 0, REASON_WANDER, all);
    TEST_ASSERT_EQUAL_UINT32(6, history.lesson_count);
    TEST_ASSERT_EQUAL_INT32(0, history.by_hand[1]);
    TEST_ASSERT_EQUAL_INT32(0, history.by_hand[3]);
    TEST_ASSERT_EQUAL_INT32(0, history.by_hand[4]);
    TEST_ASSERT_EQUAL_INT32(1, history.by_hand[FRONT]);   /* ahead, it has no side */
    TEST_ASSERT_EQUAL_INT32(1, history.by_hand[5]);
    TEST_ASSERT_EQUAL_INT32(1, history.by_hand[6]);       /* the wrong one */
}

TEST(uses_of_a_cell_are_counted_until_it_changes)
{
    history_begin(&history, LEARNED);
    begin(1.0, FRONT_RIGHT_TOO, REASON_REMEMBERED, LEARNED);
    begin(2.0, FRONT_RIGHT_TOO, REASON_REMEMBERED, LEARNED);
    TEST_ASSERT_EQUAL_INT32(2, history.uses[FRONT_RIGHT_TOO]);
    begin(3.0, 0, REASON_WANDER, NOTHING);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_NOTHING, 0);
    TEST_ASSERT_EQUAL_INT32(0, history.uses[FRONT_RIGHT_TOO]);
}

TEST(erasing_is_by_hand_except_after_boredom_or_a_remembered_turn)
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

TEST(lesson_within_an_action_is_by_hand)
{
    try_left(7.0);
    take(8.0, LEARNED);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_LEFT, 1);
    history_relearn(&history, 9.0, NOTHING);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_NOTHING, 1);
    history_relearn(&history, 10.0, NOTHING);
    TEST_ASSERT_EQUAL_UINT32(0, history.lesson_count);
}

TEST(relearned_cells_between_ticks_are_by_hand)
{
    history_begin(&history, LEARNED);
    begin(1.0, FRONT_RIGHT_TOO, REASON_REMEMBERED, LEARNED);
    history_relearn(&history, 2.0, NOTHING);
    expect_lesson(FRONT_RIGHT_TOO, SIDE_NOTHING, 1);
}

TEST(uses_are_counted_after_the_lesson)
{
    try_left(7.0);
    begin(9.0, FRONT, REASON_REMEMBERED, LEARNED);
    TEST_ASSERT_EQUAL_INT32(0, history.uses[FRONT_RIGHT_TOO]);
    begin(10.0, FRONT_RIGHT_TOO, REASON_REMEMBERED, NOTHING);
    TEST_ASSERT_EQUAL_INT32(1, history.uses[FRONT_RIGHT_TOO]);
}

TEST(history_take_sets_pattern_and_frozen_of_rows)
{
    rows[0][ROW_FEEL] = FRONT << 1;
    rows[1][ROW_ACTION] = 2;
    rows[1][ROW_FEEL] = FRONT_RIGHT_TOO << 1;
    history.frozen = true;
    (void)history_take(&history, 5.0, rows[0], 2, notes);
    TEST_ASSERT_EQUAL_INT16(FRONT, rows[0][ROW_PATTERN]);
    TEST_ASSERT_EQUAL_INT16(FRONT_RIGHT_TOO, rows[1][ROW_PATTERN]);
    TEST_ASSERT_EQUAL_INT16(1, rows[1][ROW_FROZEN]);
}

TEST(notes_record_starts_of_turns_and_ends_of_trials)
{
    TEST_ASSERT_EQUAL_size_t(0, begin(1.0, 0, REASON_WANDER, NOTHING));
    TEST_ASSERT_EQUAL_size_t(1, begin(2.0, FRONT, REASON_TRIAL, NOTHING));
    TEST_ASSERT_EQUAL_DOUBLE(2.0, notes[0].tick);
    TEST_ASSERT_EQUAL_INT32(REASON_TRIAL, notes[0].reason);
    TEST_ASSERT_EQUAL_INT32(FRONT, notes[0].cell);
    TEST_ASSERT_EQUAL_INT32(-1, notes[0].trial.helped);
    TEST_ASSERT_EQUAL_size_t(0, take(3.0, NOTHING));
    TEST_ASSERT_EQUAL_size_t(1, begin(4.0, 0, REASON_WANDER, NOTHING));
    TEST_ASSERT_EQUAL_INT32(1, notes[0].trial.helped);
    TEST_ASSERT_EQUAL_size_t(1, begin(5.0, FRONT, REASON_REMEMBERED, NOTHING));
    TEST_ASSERT_EQUAL_size_t(1, begin(6.0, FRONT, REASON_BOREDOM, NOTHING));
}

TEST(history_restart_clears_lessons_but_not_the_trial_count)
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
