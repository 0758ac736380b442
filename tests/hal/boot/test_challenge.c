#include <string.h>

#include "hal/boot/uds.h"
#include "hal/port/cortex_m/core.h"
#include "hal/port/cortex_m/systick.h"
#include "tests/test.h"

volatile struct systick_registers SYSTICK;
static uint32_t now_ms;

uint32_t machine_ms(void)
{
    return now_ms;
}

static void draw(uint8_t out[UDS_CHALLENGE])
{
    boot_random(out);
}

TEST(no_two_are_alike)
{
    uint8_t first[UDS_CHALLENGE], next[UDS_CHALLENGE];

    draw(first);
    for (unsigned i = 0; i < 100; i++) {
        draw(next);
        TEST_ASSERT_TRUE(memcmp(first, next, UDS_CHALLENGE) != 0);
        memcpy(first, next, UDS_CHALLENGE);
    }
}
