/* The eight bytes of a page's robots: as they are, as turns, and as another behaviour would have them. */
#include "page_rig.h"

#include "firmware/memory/feel_memory.h"

enum { ALL_FOUR = 15, UPPER = 1 << 4 };

TEST(a_new_robot_remembers_nothing)
{
    static const uint8_t nothing[CELL_COUNT] = {0};

    TEST_ASSERT_EQUAL_HEX8_ARRAY(nothing, page_memory(0), CELL_COUNT);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(nothing, page_sides(0), CELL_COUNT);
}

TEST(what_is_written_is_in_its_cells)
{
    static const uint8_t expected[CELL_COUNT] = {0, SIDE_LEFT, SIDE_RIGHT, 0, 0, 0, 0, SIDE_LEFT};

    start(0, PROFILE_ARTICLE);
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_WRITE, 1 << 1 | 1 << 2, SIDE_LEFT << 8 | SIDE_RIGHT << 16));
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_WRITE, UPPER | 1 << 3, (uint32_t)SIDE_LEFT << 24));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, page_memory(0), CELL_COUNT);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, page_sides(0), CELL_COUNT);
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_ERASE, 0, 0));
    TEST_ASSERT_EACH_EQUAL_HEX8(0, page_memory(0), CELL_COUNT);
}

TEST(a_turn_is_put_into_bytes_of_the_behaviours_own_kind)
{
    static const uint8_t sides[PAGE_BYTES] = {0, 0, SIDE_LEFT}, none[PAGE_BYTES] = {0};
    static const uint8_t expected[PAGE_BYTES] = {0, 0, SIDE_LEFT, SIDE_RIGHT};

    start(0, PROFILE_ARTICLE);
    put_bytes(sides);
    page_write_side(0, 3, SIDE_RIGHT);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, page_bytes(), PAGE_BYTES);
    start(1, PROFILE_FIVE);
    put_bytes(none);
    TEST_ASSERT_TRUE(page_translate(1));
    page_write_side(1, 3, SIDE_RIGHT);
    TEST_ASSERT_TRUE(feel_memory_is(page_bytes()));
}

TEST(bytes_of_another_kind_are_translated)
{
    static const uint8_t sides[PAGE_BYTES] = {0, 0, SIDE_LEFT, SIDE_RIGHT};

    start(0, PROFILE_FIVE);
    put_bytes(sides);
    TEST_ASSERT_TRUE(page_translate(0));
    TEST_ASSERT_TRUE(feel_memory_is(page_bytes()));
    start(1, PROFILE_ARTICLE);
    TEST_ASSERT_TRUE(page_translate(1));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(sides, page_bytes(), PAGE_BYTES);
}

TEST(bytes_that_are_no_memory_are_left_alone)
{
    static const uint8_t garbage[PAGE_BYTES] = {1, 2, 3, 255, 255, 255, 255, 255};

    start(0, PROFILE_ARTICLE);
    put_bytes(garbage);
    TEST_ASSERT_FALSE(page_translate(0));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(garbage, page_bytes(), PAGE_BYTES);
}

TEST(turns_are_told_whatever_kind_of_memory_it_is)
{
    static const uint8_t sides[PAGE_BYTES] = {0, 0, SIDE_LEFT, SIDE_RIGHT};

    for (uint8_t profile = 0; profile < PROFILE_COUNT; profile++) {
        const uint8_t *bytes = page_bytes();

        start(0, (enum profile)profile);
        if (profile == PROFILE_FIXED)   /* its turns are given */
            continue;
        put_bytes(sides);
        TEST_ASSERT_TRUE(page_translate(0));
        for (uint32_t half = 0; half < 2; half++, bytes += 4) {
            uint32_t word = bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;

            page_state()->robots[0].octet->robot.brain.memory.cell[0] = page_bytes()[0];
            TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(0, OPCODE_WRITE, half << 4 | ALL_FOUR, word));
        }
        TEST_ASSERT_EQUAL_HEX8_ARRAY(sides, page_sides(0), CELL_COUNT);
    }
}
