#include "hal/flash_store/flash_store.h"

#include <stddef.h>
#include <string.h>

#include "hal/flash_store/crc32.h"
#include "hal/flash_store/flash.h"

enum { TRIES_MAX = 4 };   /* worn places skipped per save */

/* An interrupted erase can leave erased bytes and zeros whose CRC is this, without any record having been written: so
 * no record uses it. */
#define NOT_WRITTEN UINT32_MAX

struct record {
    uint32_t number;
    uint8_t memory[CELL_COUNT];
    uint32_t crc;
};

/* A place for one record: as many whole write units as needed. Words 1 and 2 are the eight bytes. */
union place {
    struct record record;
    uint32_t words[FLASH_UNIT_WORDS];
};

/* A mark is a record whose CRC is inverted: firmware without marks skips it as an invalid record. */
enum content { BLANK, RECORD, MARK, RUBBISH };

static uint32_t crc_of(const struct record *record)
{
    uint8_t bytes[offsetof(struct record, crc)];

    memcpy(bytes, record, sizeof bytes);
    return crc32(bytes, sizeof bytes);
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
    uint32_t difference;

    if (flash_read(page, offset, out->words, size) < 0)
        return RUBBISH;
    for (unsigned i = 0; i < size / 4; i++)
        all &= out->words[i];
    if (all == UINT32_MAX)
        return BLANK;
    difference = out->record.crc ^ crc_of(&out->record);
    if (difference == UINT32_MAX)
        return MARK;
    return difference == 0 && out->record.crc != NOT_WRITTEN ? RECORD : RUBBISH;
}

/* Offset of the blank rest of a page: everything before it is written, partly written or worn. */
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

/* Compares sequence numbers, which wrap; those of any two stored records are close together. */
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

static void make_record(union place *place, uint32_t number, const uint8_t memory[CELL_COUNT])
{
    memset(place, 0xFF, sizeof *place);
    place->record.number = number;
    memcpy(place->record.memory, memory, CELL_COUNT);
    place->record.crc = crc_of(&place->record);
}

/* Whether the page is blank after a mark. Without a mark, it may look blank after an interrupted erase, and would not
 * retain data for long. */
static bool is_erased(unsigned page, union place *scratch)
{
    return used_of(page, scratch) == size_of_place() && look(page, 0, scratch) == MARK;
}

/* The old mark is overwritten first, so that it cannot survive an erase that loses power. If the new mark cannot be
 * written, the page is used without it: its records serve the same purpose. */
static int erase(unsigned page, union place *scratch)
{
    static const uint8_t nothing[CELL_COUNT];   /* zeros */

    if (look(page, 0, scratch) != BLANK) {
        memset(scratch, 0, sizeof *scratch);
        (void)flash_write(page, 0, scratch->words, size_of_place());
    }
    if (flash_erase(page) < 0 || used_of(page, scratch) > 0)
        return HAL_E_STORE;
    make_record(scratch, 0, nothing);
    scratch->record.crc = ~scratch->record.crc;
    (void)flash_write(page, 0, scratch->words, size_of_place());
    return 0;
}

/* Continues in the other page. Returns 0, or an error as flash_store_save. */
static int turn_page(struct flash_store *store, union place *scratch, bool may_erase)
{
    uint8_t spare = (uint8_t)(2 * store->first + 1 - (has_record(store) ? store->kept : store->page));

    if (!is_erased(spare, scratch)) {
        if (!may_erase)
            return FLASH_STORE_LATER;
        if (erase(spare, scratch) < 0)
            return HAL_E_STORE;
    }
    store->page = spare;
    store->next = (uint16_t)size_of_place();
    return 0;
}

/* Records after the newest one failed to write. They may become readable later, so their numbers are skipped. */
static void go_on_behind_newest(struct flash_store *store, union place *scratch)
{
    store->page = store->kept;
    store->next = (uint16_t)used_of(store->page, scratch);
    store->number += (store->next - store->newest) / size_of_place() - 1;
}

int flash_store_open_at(struct flash_store *store, unsigned first_page, uint8_t memory[CELL_COUNT])
{
    union place place;
    bool blank = true;

    *store = (struct flash_store){
        .newest = FLASH_STORE_NOWHERE, .first = (uint8_t)first_page, .page = (uint8_t)(first_page + 1),
        .next = (uint16_t)flash_page_size(),
    };
    for (uint8_t page = store->first; page < store->first + FLASH_PAGES; page++) {
        find_newest(store, page, &place, memory);
        blank = blank && (used_of(page, &place) == 0 || is_erased(page, &place));
    }
    if (has_record(store))
        go_on_behind_newest(store, &place);
    if (store->next == flash_page_size())
        (void)turn_page(store, &place, true);   /* a failure is retried by the next save */
    if (has_record(store))
        return 1;
    return blank ? 0 : HAL_E_STORE;
}

int flash_store_open(struct flash_store *store, uint8_t memory[CELL_COUNT])
{
    return flash_store_open_at(store, 0, memory);
}

/* A failed later attempt may read as valid after a reset: then this record is not the newest. */
static bool is_stored(const struct flash_store *store, union place *scratch, const uint8_t memory[CELL_COUNT])
{
    return has_record(store) && look(store->kept, store->newest, scratch) == RECORD &&
           scratch->record.number == store->number && memcmp(scratch->record.memory, memory, CELL_COUNT) == 0;
}

static bool append(struct flash_store *store, const union place *place)
{
    uint32_t size = size_of_place();
    uint16_t here = store->next;

    store->next = (uint16_t)(here + size);
    if (flash_write(store->page, here, place->words, size) < 0)
        return false;
    store->newest = here;
    store->kept = store->page;
    return true;
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
        make_record(&place, ++store->number, memory);
        if (place.record.crc != NOT_WRITTEN && append(store, &place))
            return 0;
    }
    return HAL_E_STORE;
}
