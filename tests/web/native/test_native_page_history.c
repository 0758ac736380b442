/* What a robot of a page has learned, from the rows of its last block. */
#include <stddef.h>

#include "page_rig.h"
#include "tests/test.h"

static void fill(uint32_t tick, int16_t action, enum reason reason, int16_t feel)
{
    int16_t *at = page_state()->robots[1].rows + tick * ROW_COUNT;

    at[ROW_FEEL] = feel;
    at[ROW_LEFT_MM_S] = -200;
    at[ROW_RIGHT_MM_S] = 200;
    at[ROW_REASON] = (int16_t)reason;
    at[ROW_ACTION] = action;
    page_state()->loop.ticks = tick + 1;
}

/* The robot itself knows nothing, whatever a test has put into the history. */
static void begin(void)
{
    page_history_begin(1);
    fill(0, 1, REASON_TRIAL, 6 << 1);
    fill(1, 2, REASON_WANDER, 0);
}

TEST(the_notes_of_a_block_are_handed_over)
{
    begin();
    page_history_freeze(1, 1);
    TEST_ASSERT_EQUAL_UINT32(2, page_history_take(1, 100.0));
    TEST_ASSERT_EQUAL_DOUBLE(100.0, page_notes()[0].tick);
    TEST_ASSERT_EQUAL_INT32(REASON_TRIAL, page_notes()[0].reason);
    TEST_ASSERT_EQUAL_INT32(6, page_notes()[0].cell);
    TEST_ASSERT_EQUAL_DOUBLE(101.0, page_notes()[1].tick);
    TEST_ASSERT_EQUAL_INT32(1, page_notes()[1].trial.helped);
    TEST_ASSERT_EQUAL_INT32(1, page_notes()[1].trial.frozen);
    TEST_ASSERT_EQUAL_UINT32(0, page_lesson_count(1));
}

TEST(javascript_finds_the_numbers_of_notes_and_lessons_in_their_places)
{
    TEST_ASSERT_EQUAL_size_t(14 * sizeof(int32_t), sizeof(struct history_note));
    TEST_ASSERT_EQUAL_size_t(8, offsetof(struct history_note, reason));
    TEST_ASSERT_EQUAL_size_t(24, offsetof(struct history_note, learned));
    TEST_ASSERT_EQUAL_size_t(32, offsetof(struct history_note, trial));
    TEST_ASSERT_EQUAL_size_t(4 * sizeof(int32_t), sizeof(struct history_lesson));
}

TEST(a_turn_that_is_no_longer_known_is_a_lesson)
{
    begin();
    page_state()->histories[1].sides[3] = SIDE_RIGHT;
    (void)page_history_take(1, 100.0);
    TEST_ASSERT_EQUAL_UINT32(1, page_lesson_count(1));
    TEST_ASSERT_EQUAL_INT32(3, page_lessons(1)->cell);
    TEST_ASSERT_EQUAL_INT32(1, page_lessons(1)->by_hand);
    TEST_ASSERT_EQUAL_UINT32(0, page_lesson_count(0));
}

TEST(what_is_told_between_ticks_is_by_hand)
{
    begin();
    page_state()->histories[1].sides[3] = SIDE_RIGHT;
    page_history_relearn(1, 50.0);
    TEST_ASSERT_EQUAL_INT32(3, page_lessons(1)->cell);
    TEST_ASSERT_EQUAL_DOUBLE(50.0, page_state()->histories[1].learned[3]);
    page_history_restart(1);
    TEST_ASSERT_EQUAL_UINT32(0, page_lesson_count(1));
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, page_state()->histories[1].learned[3]);
}
