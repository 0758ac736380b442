/* An image that no boot loader started. */
#include "hal/port/cortex_m/loader.h"
#include "tests/test.h"

TEST(it_has_the_number_that_it_was_built_with_and_listens_for_nothing)
{
    struct frame frame = {.id = 0}, answer;

    TEST_ASSERT_EQUAL_UINT8(5, loader_node(5));
    TEST_ASSERT_EQUAL_STRING("", loader_link());
    loader_alive(false);
    TEST_ASSERT_EQUAL_UINT16(0, loader_id());
    TEST_ASSERT_FALSE(loader_frame(&frame, true, &answer));
}
