/* A flash store in use: it saves, writes and erases fail or are cut short at any place, and it is opened again. What was
 * stored last is found, or what was tried in vain since. */
#include "hal/flash_store/flash.h"

#include <string.h>

#include "hal/flash_store/flash_store.h"
#include "tests/proof/any/any.h"

enum { PAGE_SIZE = 64, UNIT = 8, ERASED = 0xFF, TRIED_MAX = 8 };

static uint8_t flash[FLASH_PAGES][PAGE_SIZE];
static uint8_t tried[TRIED_MAX][CELL_COUNT];   /* any of these may be found; the first was stored, if stored */
static unsigned tried_count;
static bool stored;

bool flash_exists(void)
{
    return true;
}

uint32_t flash_page_size(void)
{
    return PAGE_SIZE;
}

uint32_t flash_unit(void)
{
    return UNIT;
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    memcpy(words, &flash[page][offset], count);
    return 0;
}

/* How much of an operation is done, in bytes: mostly all of it. */
static uint32_t done_of(uint32_t count)
{
    return any_u8() % 8 == 1 ? any_u8() % count : count;
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    uint32_t done = done_of(count);

    for (uint32_t i = 0; i < count; i++)
        must(flash[page][offset + i] == ERASED || words[i / sizeof words[0]] == 0);
    memcpy(&flash[page][offset], words, done);
    return memcmp(&flash[page][offset], words, count) == 0 ? 0 : -1;
}

int flash_erase(unsigned page)
{
    uint32_t done = done_of(PAGE_SIZE);

    memset(flash[page], ERASED, done);
    return done == PAGE_SIZE ? 0 : -1;
}

static void may_be_found(const uint8_t memory[CELL_COUNT])
{
    if (tried_count < TRIED_MAX)
        memcpy(tried[tried_count++], memory, CELL_COUNT);
}

static void only_this_is_found(const uint8_t memory[CELL_COUNT])
{
    tried_count = 0;
    may_be_found(memory);
    stored = true;
}

static bool was_tried(const uint8_t memory[CELL_COUNT])
{
    for (unsigned i = 0; i < tried_count; i++)
        if (memcmp(tried[i], memory, CELL_COUNT) == 0)
            return true;
    return false;
}

static void save(struct flash_store *store)
{
    uint8_t memory[CELL_COUNT];
    int result;

    memset(memory, any_u8(), sizeof memory);
    result = flash_store_save(store, memory, any_u8() % 4 != 1);
    if (result == 0)
        only_this_is_found(memory);
    else if (result == HAL_E_STORE)
        may_be_found(memory);
}

static void open_again(struct flash_store *store)
{
    uint8_t memory[CELL_COUNT];
    int result = flash_store_open(store, memory);

    must(result == 1 || !stored);
    if (result == 1) {
        must(was_tried(memory));
        only_this_is_found(memory);
    }
}

void exercise(void)
{
    struct flash_store store;

    memset(flash, ERASED, sizeof flash);
    tried_count = 0;
    stored = false;
    open_again(&store);
    while (any_more() && tried_count < TRIED_MAX)
        if (any_u8() % 4 == 1)
            open_again(&store);
        else
            save(&store);
}
