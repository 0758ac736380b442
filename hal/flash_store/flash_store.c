#include "hal/flash_store/flash_store.h"

#include <stddef.h>
#include <string.h>

#include "hal/flash_store/flash.h"

enum { WORDS = 4, TRIES_MAX = 4 };   /* of a record; worn places passed over in one go */

struct record {
    uint32_t number;
    uint8_t memory[CELL_COUNT];
    uint32_t crc;
};

/* CRC-32 as in Ethernet: polynomial 0xEDB88320 reflected, start and final xor all ones. */
static uint32_t crc_of(const struct record *record)
{
    uint8_t bytes[offsetof(struct record, crc)];
    uint32_t crc = UINT32_MAX;

    memcpy(bytes, record, sizeof bytes);
    for (unsigned i = 0; i < sizeof bytes; i++) {
        crc ^= bytes[i];
        for (unsigned bit = 0; bit < 8; bit++)
            crc = crc >> 1 ^ (crc & 1u ? 0xEDB88320u : 0);
    }
    return ~crc;
}

static uint32_t records_per_page(void)
{
    return flash_page_size() / sizeof(struct record);
}

static struct record record_at(unsigned page, uint32_t place)
{
    struct record record;

    memcpy(&record, (const char *)flash_page(page) + place * sizeof record, sizeof record);
    return record;
}

static bool is_blank(unsigned page, uint32_t place)
{
    const uint8_t *byte = (const uint8_t *)flash_page(page) + place * sizeof(struct record);
    uint8_t all = 0xFF;

    for (unsigned i = 0; i < sizeof(struct record); i++)
        all &= byte[i];
    return all == 0xFF;
}

/* The first place from which on all is blank: what comes before is written, or half written, or worn. */
static uint32_t used_of(unsigned page)
{
    uint32_t used = records_per_page();

    while (used > 0 && is_blank(page, used - 1))
        used--;
    return used;
}

static void look_at_page(struct flash_store *store, uint8_t page, uint8_t memory[CELL_COUNT])
{
    uint32_t used = used_of(page);

    for (uint32_t place = 0; place < used; place++) {
        struct record record = record_at(page, place);

        if (record.number <= store->number || record.crc != crc_of(&record))
            continue;
        store->number = record.number;
        store->kept = page;
        memcpy(memory, record.memory, CELL_COUNT);
    }
}

int flash_store_open(struct flash_store *store, uint8_t memory[CELL_COUNT])
{
    *store = (struct flash_store){.number = 0};
    for (uint8_t page = 0; page < FLASH_PAGES; page++)
        look_at_page(store, page, memory);
    store->page = store->kept;
    store->next = used_of(store->page);
    if (store->number > 0)
        return 1;
    return used_of(0) + used_of(1) == 0 ? 0 : HAL_E_STORE;
}

/* Goes on in the page that can be spared. 0, or as flash_store_save. */
static int turn_page(struct flash_store *store, bool may_erase)
{
    uint8_t spare = store->number > 0 ? 1 - store->kept : 1 - store->page;

    if (used_of(spare) > 0) {
        if (!may_erase)
            return FLASH_STORE_LATER;
        if (flash_erase(spare) < 0 || used_of(spare) > 0)
            return HAL_E_STORE;
    }
    store->page = spare;
    store->next = 0;
    return 0;
}

static bool append(struct flash_store *store, const struct record *record)
{
    uint32_t offset = store->next * (uint32_t)sizeof *record;
    uint32_t words[WORDS];

    memcpy(words, record, sizeof words);
    store->next++;
    for (unsigned i = 0; i < WORDS; i++)
        if (flash_write(store->page, offset + 4 * i, words[i]) < 0)
            return false;
    store->number = record->number;
    store->kept = store->page;
    return true;
}

int flash_store_save(struct flash_store *store, const uint8_t memory[CELL_COUNT], bool may_erase)
{
    struct record record = {.number = store->number + 1};

    memcpy(record.memory, memory, CELL_COUNT);
    record.crc = crc_of(&record);
    for (unsigned tries = 0; tries < TRIES_MAX; tries++) {
        int result = store->next < records_per_page() ? 0 : turn_page(store, may_erase);

        if (result != 0)
            return result;
        if (append(store, &record))
            return 0;
    }
    return HAL_E_STORE;
}
