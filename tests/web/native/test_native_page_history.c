/* What a robot of a page has learned, from the rows of its last block. */
#include "page_rig.h"
#include "tests/test.h"

static int16_t *row(uint32_t tick)
{
    return page_state()->robots[1].rows + tick * LOOP_ROW;
}

static void fill(uint32_t tick, int16_t action, enum reason reason, int16_t feel)
{
    int16_t *at = row(tick);

    at[ROW_FEEL] = feel;
    at[ROW_LEFT] = -200;
    at[ROW_RIGHT] = 200;
    at[ROW_REASON] = (int16_t)reason;
    at[ROW_ACTION] = action;
    at[ROW_PATTERN] = 6;
}

static void know(uint8_t cell, uint8_t side)
{
    uint8_t sides[CELL_COUNT] = {0};

    sides[cell] = side;
    put_bytes(sides);
}

static void begin(void)
{
    know(0, 0);
    page_history_begin(1);
    fill(0, 1, REASON_TRIAL, 6 << 1);
    fill(1, 2, REASON_WANDER, 0);
}

TEST(a_trial_and_its_lesson_are_handed_over)
{
    begin();
    page_history_take(1, 100.0, 0);
    TEST_ASSERT_EQUAL_DOUBLE(100.0, page_history(1)[0]);
    TEST_ASSERT_EQUAL_DOUBLE(6.0, page_history(1)[1]);
    TEST_ASSERT_EQUAL_DOUBLE(SIDE_LEFT, page_history(1)[2]);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, page_history(1)[3]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, page_history(1)[5]);
    know(6, SIDE_LEFT);
    page_history_freeze(1, 1);
    page_history_take(1, 101.0, 1);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, page_history(1)[3]);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, page_history(1)[4]);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, page_history(1)[5]);
    TEST_ASSERT_EQUAL_DOUBLE(6.0, page_history(1)[6]);
    TEST_ASSERT_EQUAL_DOUBLE(SIDE_LEFT, page_history(1)[7]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, page_history(1)[8]);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, page_history(0)[5]);
}

TEST(what_is_told_between_ticks_is_by_hand)
{
    begin();
    know(3, SIDE_RIGHT);
    page_history_relearn(1, 50.0);
    TEST_ASSERT_EQUAL_DOUBLE(3.0, page_history(1)[6]);
    TEST_ASSERT_EQUAL_DOUBLE(1.0, page_history(1)[8]);
    know(0, 0);
    page_history_restart(1);
    TEST_ASSERT_EQUAL_DOUBLE(0.0, page_history(1)[5]);
    TEST_ASSERT_EQUAL_UINT8(SIDE_NOTHING, page_state()->histories[1].sides[3]);
}

TEST(ticks_can_be_passed_over)
{
    begin();
    page_history_pass_over(1, 0);
    TEST_ASSERT_EQUAL_INT32(1, page_state()->histories[1].action);
    TEST_ASSERT_EQUAL_INT32(6, page_state()->histories[1].pattern);
    page_history_take(1, 100.0, 0);
    TEST_ASSERT_EQUAL_DOUBLE(-1.0, page_history(1)[0]);
}
