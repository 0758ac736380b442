#include "hal/flash_store/flash_store.h"

#include <stddef.h>
#include <string.h>

#include "hal/flash_store/flash.h"

enum { TRIES_MAX = 4 };   /* worn places passed over in one go */

struct record {
    uint32_t number;
    uint8_t memory[CELL_COUNT];
    uint32_t crc;
};

/* A record's place: as many whole write units as it takes. Words 1 and 2 are the eight bytes. */
union place {
    struct record record;
    uint32_t words[FLASH_UNIT_MAX / 4];
};

enum content { BLANK, RECORD, RUBBISH };

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

static uint32_t size_of_place(void)
{
    uint32_t unit = flash_unit();

    return unit > sizeof(struct record) ? unit : sizeof(struct record);
}

static enum content look(unsigned page, uint32_t offset, union place *out)
{
    uint32_t size = size_of_place();
    uint32_t all = UINT32_MAX;

    if (flash_read(page, offset, out->words, size) < 0)
        return RUBBISH;
    for (unsigned i = 0; i < size / 4; i++)
        all &= out->words[i];
    if (all == UINT32_MAX)
        return BLANK;
    return out->record.crc == crc_of(&out->record) ? RECORD : RUBBISH;
}

/* Where the rest of a page begins that is blank: what comes before is written, or half written, or worn. */
static uint32_t used_of(unsigned page, union place *scratch)
{
    uint32_t size = size_of_place();
    uint32_t used = flash_page_size();

    while (used > 0 && look(page, used - size, scratch) == BLANK)
        used -= size;
    return used;
}

static bool has_record(const struct flash_store *store)
{
    return store->newest != FLASH_STORE_NOWHERE;
}

/* Numbers wrap; those of two records that are there at once lie close together. */
static bool is_newer(const struct flash_store *store, uint32_t number)
{
    return !has_record(store) || number - store->number - 1 < UINT32_MAX / 2;
}

static void find_newest(struct flash_store *store, uint8_t page, union place *found, uint8_t memory[CELL_COUNT])
{
    for (uint32_t at = 0; at < flash_page_size(); at += size_of_place())
        if (look(page, at, found) == RECORD && is_newer(store, found->record.number)) {
            store->number = found->record.number;
            store->newest = (uint16_t)at;
            store->kept = page;
            memcpy(memory, found->record.memory, CELL_COUNT);
        }
}

int flash_store_open(struct flash_store *store, uint8_t memory[CELL_COUNT])
{
    union place place;

    *store = (struct flash_store){.newest = FLASH_STORE_NOWHERE};
    for (uint8_t page = 0; page < FLASH_PAGES; page++)
        find_newest(store, page, &place, memory);
    store->page = store->kept;
    store->next = (uint16_t)used_of(store->page, &place);
    if (has_record(store))
        return 1;
    return used_of(0, &place) + used_of(1, &place) == 0 ? 0 : HAL_E_STORE;
}

static bool is_stored(const struct flash_store *store, union place *scratch, const uint8_t memory[CELL_COUNT])
{
    uint32_t wanted[CELL_COUNT / 4];

    memcpy(wanted, memory, sizeof wanted);
    return has_record(store) && look(store->kept, store->newest, scratch) == RECORD &&
           scratch->words[1] == wanted[0] && scratch->words[2] == wanted[1];
}

/* Goes on in the page that can be spared. 0, or as flash_store_save. */
static int turn_page(struct flash_store *store, union place *scratch, bool may_erase)
{
    uint8_t spare = 1 - (has_record(store) ? store->kept : store->page);

    if (used_of(spare, scratch) > 0) {
        if (!may_erase)
            return FLASH_STORE_LATER;
        if (flash_erase(spare) < 0 || used_of(spare, scratch) > 0)
            return HAL_E_STORE;
    }
    store->page = spare;
    store->next = 0;
    return 0;
}

static bool append(struct flash_store *store, const union place *place)
{
    uint32_t size = size_of_place();
    uint16_t here = store->next;

    store->next = (uint16_t)(here + size);
    if (flash_write(store->page, here, place->words, size) < 0)
        return false;
    store->number = place->record.number;
    store->newest = here;
    store->kept = store->page;
    return true;
}

static void make_record(union place *place, uint32_t number, const uint8_t memory[CELL_COUNT])
{
    memset(place, 0xFF, sizeof *place);
    place->record.number = number;
    memcpy(place->record.memory, memory, CELL_COUNT);
    place->record.crc = crc_of(&place->record);
}

int flash_store_save(struct flash_store *store, const uint8_t memory[CELL_COUNT], bool may_erase)
{
    union place place;

    if (is_stored(store, &place, memory))
        return 0;
    for (unsigned tries = 0; tries < TRIES_MAX; tries++) {
        int result = store->next < flash_page_size() ? 0 : turn_page(store, &place, may_erase);

        if (result != 0)
            return result;
        make_record(&place, store->number + 1, memory);
        if (append(store, &place))
            return 0;
    }
    return HAL_E_STORE;
}
