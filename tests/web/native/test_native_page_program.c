/* Robots of a page whose brain is a program. */
#include "page_rig.h"

#include <string.h>

static const double *load(const char *text)
{
    memcpy(page_program_text(), text, strlen(text));
    TEST_ASSERT_TRUE(page_program(0, (uint32_t)strlen(text)));
    return page_program_state(0);
}

TEST(a_program_is_the_robot_s_brain)
{
    const double *state = load("rForward 5");
    struct input in = {.senses = {.tick = 1}};
    struct output out;

    start(0, PROFILE_ARTICLE);
    page_state()->robots[0].octet->respond(&page_state()->robots[0].octet->robot, INPUT_SENSES, &in, &out);
    state = page_program_state(0);
    TEST_ASSERT_EQUAL(REASON_WANDER, out.drive.reason);
    TEST_ASSERT_EQUAL_DOUBLE(PROGRAM_RUNS, state[PAGE_PROGRAM_STATE]);
    TEST_ASSERT_EQUAL_DOUBLE(1, state[PAGE_PROGRAM_STEPS]);
    TEST_ASSERT_EQUAL_DOUBLE(1, state[PAGE_PROGRAM_NUMBERS]);
}

TEST(its_mistake_is_told)
{
    const double *state = load("x = 1\nrTrun 5");

    TEST_ASSERT_EQUAL_DOUBLE(PROGRAM_MISTAKEN, state[PAGE_PROGRAM_STATE]);
    TEST_ASSERT_EQUAL_DOUBLE(2, state[PAGE_PROGRAM_LINE]);
    TEST_ASSERT_EQUAL_STRING("rTrun", page_program_word(0));
    TEST_ASSERT_EQUAL_STRING("a command, a label, or a variable with = after it",
                             page_program_expected((uint32_t)state[PAGE_PROGRAM_EXPECTED]));
    TEST_ASSERT_EQUAL_STRING("", page_program_shown(0, 0));
}

TEST(its_names_have_their_places)
{
    const double *state = load("ab = 5\ndim c[3]"), *names = state + PAGE_PROGRAM_NUMBERS;

    TEST_ASSERT_EQUAL_DOUBLE(2, state[PAGE_PROGRAM_NAMES]);
    TEST_ASSERT_EQUAL_DOUBLE(NAME_VARIABLE, names[0]);
    TEST_ASSERT_EQUAL_DOUBLE(2, names[4]);
    TEST_ASSERT_EQUAL_DOUBLE(NAME_ARRAY, names[5]);
    TEST_ASSERT_EQUAL_DOUBLE(3, names[7]);
    TEST_ASSERT_EQUAL_DOUBLE(0, page_program_cells(0)[0]);
}
