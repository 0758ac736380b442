#include "hal/stm32/comes_up.h"
#include "tests/test.h"
#include "hal/port/cortex_m/systick.h"

enum { LIMIT_MS = 7 };

static volatile uint32_t reg;
static uint32_t now_ms, ready_ms;

uint32_t machine_ms(void)
{
    if (now_ms >= ready_ms)
        reg = 0xF0;
    return now_ms++;
}

void setUp(void)
{
    reg = 0;
    now_ms = ready_ms = 0;
}

TEST(what_is_there_is_seen)
{
    TEST_ASSERT_TRUE(comes_up(&reg, 0x30, 0x30, LIMIT_MS));
    TEST_ASSERT_TRUE(comes_up(&reg, 0x0F, 0, LIMIT_MS));
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(2, now_ms);
}

TEST(what_comes_in_time_is_waited_for)
{
    ready_ms = LIMIT_MS;
    TEST_ASSERT_TRUE(comes_up(&reg, 0x30, 0x30, LIMIT_MS));
}

TEST(what_never_comes_is_given_up_in_time)
{
    TEST_ASSERT_FALSE(comes_up(&reg, 0x31, 0x31, LIMIT_MS));
    TEST_ASSERT_UINT32_WITHIN(1, LIMIT_MS + 2, now_ms);
    TEST_ASSERT_FALSE(comes_up(&reg, 0x30, 0x10, LIMIT_MS));
}

TEST(it_does_not_matter_how_late_it_is)
{
    now_ms = 1000;
    ready_ms = now_ms + LIMIT_MS;
    TEST_ASSERT_TRUE(comes_up(&reg, 0x30, 0x30, LIMIT_MS));
}
