#include "hal/flash_store/flash.h"
#include "tests/test.h"

TEST(missing_flash_fails_every_operation)
{
    uint32_t word = 7;

    TEST_ASSERT_FALSE(flash_exists());
    TEST_ASSERT_EQUAL_UINT32(0, flash_page_size());
    TEST_ASSERT_EQUAL_UINT32(4, flash_unit());
    TEST_ASSERT_EQUAL_INT(-1, flash_read(0, 0, &word, sizeof word));
    TEST_ASSERT_EQUAL_INT(-1, flash_write(0, 0, &word, sizeof word));
    TEST_ASSERT_EQUAL_INT(-1, flash_erase(0));
    TEST_ASSERT_EQUAL_UINT32(7, word);
}
