#include "hal/stm32/comes_up.h"

#include <unity.h>

void setUp(void) {}

void tearDown(void) {}

static void test_what_is_there_is_seen(void)
{
    volatile const uint32_t reg = 0xF0;

    TEST_ASSERT_TRUE(comes_up(&reg, 0x30, 0x30));
    TEST_ASSERT_TRUE(comes_up(&reg, 0x0F, 0));
}

static void test_what_never_comes_is_given_up(void)
{
    volatile const uint32_t reg = 0xF0;

    TEST_ASSERT_FALSE(comes_up(&reg, 0x31, 0x31));
    TEST_ASSERT_FALSE(comes_up(&reg, 0x30, 0x10));
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_what_is_there_is_seen);
    RUN_TEST(test_what_never_comes_is_given_up);
    return UNITY_END();
}
