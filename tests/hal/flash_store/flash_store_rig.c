#include "flash_store_rig.h"

#include <string.h>

#include <unity.h>

/* As an F1 has it, an F4, a G4, and chips that we have not met yet. */
const struct fake_flash_kind KINDS[5] = {{4, 2, false}, {4, 4, false}, {8, 8, true}, {16, 16, true}, {32, 32, true}};

const struct fake_flash_kind *kind = KINDS;
struct flash_store store;
uint8_t found[CELL_COUNT];

void setUp(void)
{
    fake_flash_clear(kind);
    memset(&store, 0xA5, sizeof store);
}

void tearDown(void)
{
    kind = KINDS;
}

/* Any two differ in every byte but the first, so that a mix of two is neither. */
const uint8_t *memory_number(unsigned n)
{
    static uint8_t memory[CELL_COUNT];

    memory[0] = 0;
    for (unsigned p = 1; p < CELL_COUNT; p++)
        memory[p] = (uint8_t)(n + 1);
    return memory;
}

int start(void)
{
    memset(found, 0, sizeof found);
    return flash_store_open(&store, found);
}

int save(unsigned n)
{
    return flash_store_save(&store, memory_number(n), true);
}

void save_many(unsigned count)
{
    TEST_ASSERT_TRUE(start() >= 0);
    for (unsigned n = 0; n < count; n++)
        TEST_ASSERT_EQUAL(0, save(n));
}

void assert_found(unsigned n)
{
    TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL_UINT8_ARRAY(memory_number(n), found, CELL_COUNT);
}
