#include "firmware/memory/confidence.h"
#include "tests/test.h"

TEST(a_cell_is_nothing_or_a_side_with_confidence_1_to_3)
{
    static const bool valid[] = {[0] = true, [5] = true, [6] = true, [9] = true, [10] = true, [13] = true, [14] = true};

    for (unsigned cell = 0; cell <= UINT8_MAX; cell++)
        TEST_ASSERT_EQUAL(cell < sizeof valid && valid[cell], confidence_is_cell((uint8_t)cell));
}

TEST(the_side_is_below_and_the_confidence_above)
{
    TEST_ASSERT_EQUAL_UINT8(5, confidence_cell(SIDE_LEFT, 1));
    TEST_ASSERT_EQUAL_UINT8(14, confidence_cell(SIDE_RIGHT, 3));
}

TEST(more_confidence_ends_at_3)
{
    TEST_ASSERT_EQUAL_UINT8(9, confidence_changed(5, 1));
    TEST_ASSERT_EQUAL_UINT8(14, confidence_changed(14, 1));
}

TEST(a_cell_with_no_confidence_left_is_empty)
{
    TEST_ASSERT_EQUAL_UINT8(6, confidence_changed(14, -2));
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(10, -2));
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(5, -2));
}

TEST(an_empty_cell_stays_empty)
{
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(0, 1));
    TEST_ASSERT_EQUAL_UINT8(0, confidence_changed(0, -2));
}
