/* The flash store: whatever the flash holds, and whichever of its operations fail. */
#include "hal/flash_store/flash_store.h"
#include "tests/proof/any/any.h"
#include "tests/proof/any/flash.h"

const unsigned ANY_FLASH_PAGES = FLASH_PAGES;

void exercise(void)
{
    struct flash_store store;
    uint8_t memory[CELL_COUNT] = {SIDE_NOTHING};

    (void)flash_store_open(&store, memory);
    while (any_more()) {
        for (unsigned p = 0; p < CELL_COUNT; p++)
            memory[p] = any_u8();
        (void)flash_store_save(&store, memory, any_bool());
    }
}
