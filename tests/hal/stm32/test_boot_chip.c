/* What a boot loader and its images need of an STM32: a word that outlives a reset, and the way to an image. */
#include <string.h>

#include "hal/boot/handover.h"
#include "hal/boot/image.h"
#include "hal/port/cortex_m/leave.h"
#include "hal/stm32/clock.h"
#include "hal/stm32/flash_table.h"
#include "tests/test.h"

volatile uint32_t HANDOVER[2];

const struct layout LAYOUT = {.slot_page = {10, 20}};

static struct {
    unsigned page;
    uint32_t offset;
    bool stopped;
    const uint32_t *vectors;
} did;

static uint32_t memory[4];

volatile void *flash_place(unsigned page, uint32_t offset)
{
    did.page = page;
    did.offset = offset;
    return memory;
}

void clock_stop(void)
{
    did.stopped = did.vectors == NULL;
}

void leave_to(const uint32_t vectors[])
{
    did.vectors = vectors;
}

void setUp(void)
{
    memset(&did, 0, sizeof did);
    HANDOVER[0] = HANDOVER[1] = 0xFFFFFFFF;
}

TEST(what_was_asked_is_taken_once)
{
    TEST_ASSERT_FALSE(handover_take());
    handover_ask();
    TEST_ASSERT_TRUE(handover_take());
    TEST_ASSERT_FALSE(handover_take());
}

TEST(half_of_it_is_not_enough)
{
    handover_ask();
    HANDOVER[1] ^= 1;
    TEST_ASSERT_FALSE(handover_take());
    handover_ask();
    HANDOVER[0] ^= 1;
    TEST_ASSERT_FALSE(handover_take());
}

TEST(an_image_starts_at_its_vectors_with_the_clocks_as_after_a_reset)
{
    boot_start(1);
    TEST_ASSERT_TRUE(did.stopped);
    TEST_ASSERT_EQUAL_PTR(memory, did.vectors);
    TEST_ASSERT_EQUAL_UINT(20, did.page);
    TEST_ASSERT_EQUAL_UINT32(IMAGE_VECTORS, did.offset);
}
