/* flash_store_rig.h: a store in a fake flash with injected faults, and what a start loads from it. */
#ifndef OCTET_FLASH_STORE_RIG_H
#define OCTET_FLASH_STORE_RIG_H

#include <setjmp.h>
#include <stdint.h>
#include <string.h>

#include "tests/test.h"
#include "hal/flash_store/flash.h"
#include "hal/flash_store/flash_store.h"

/* Four small pages of flash in RAM, of any write unit, with a power cut at a given operation. */

enum {
    FAKE_PAGES = 2 * FLASH_PAGES,  /* of two stores */
    FAKE_RECORDS = 4,              /* of a page */
    FAKE_PAGE_MAX = FLASH_UNIT_MAX * FAKE_RECORDS
};

struct fake_flash_kind {
    uint32_t unit;          /* as flash_unit */
    uint32_t step;          /* bytes that the flash itself writes at once, a part of the unit or all of it */
    bool corrects;          /* with error correction: what was cut short can be unreadable */
};

struct fake_flash {
    struct fake_flash_kind kind;
    uint8_t bytes[FAKE_PAGES][FAKE_PAGE_MAX];
    uint32_t unreadable[FAKE_PAGES];   /* bit n: word n */
    unsigned operations;        /* so far: each step written, each page erased */
    unsigned cut_at;            /* power fails within this one, counted from 1; 0: never */
    unsigned damage;            /* how far it gets then: FAKE_DAMAGES kinds */
    jmp_buf cut;                /* and control goes here */
    unsigned writes, erases;
    bool erase_fails;
    bool erase_does_nothing;    /* and reports success */
    bool write_fails;           /* reports failure, though all is written */
    bool weak[FAKE_PAGES];     /* its erase was cut short: it must not be written */
    uint8_t worn[FAKE_PAGES];  /* bit r: record r of the page takes no writes */
};

enum { FAKE_DAMAGES = 5 };      /* not begun, half done, nearly or wholly done, unreadable where that can be, half otherwise */

static struct fake_flash fake_flash;

static const struct fake_flash_kind KINDS[5] = {{4, 2, false}, {4, 4, false}, {8, 8, true}, {16, 16, true}, {32, 32, true}};

#define FOR_EACH_KIND for (kind = KINDS; kind < KINDS + sizeof KINDS / sizeof KINDS[0]; kind++)

enum { CHANGES = FAKE_RECORDS - 1 };   /* of a page, beside its mark */

static const struct fake_flash_kind *kind = KINDS;

static struct flash_store store;

static uint8_t found[CELL_COUNT];

enum { RECORD_SIZE = 16, UNREADABLE = 3, FIRST_PLACE_STAYS = 4 };

/* All erased, nothing fails. */
static inline void fake_flash_clear(const struct fake_flash_kind *like)
{
    memset(&fake_flash, 0, sizeof fake_flash);
    memset(fake_flash.bytes, 0xFF, sizeof fake_flash.bytes);
    fake_flash.kind = *like;
}

/* Bytes from one record to the next. */
static inline uint32_t fake_flash_place(void)
{
    return fake_flash.kind.unit > RECORD_SIZE ? fake_flash.kind.unit : RECORD_SIZE;
}

bool flash_exists(void)
{
    return true;
}

uint32_t flash_page_size(void)
{
    return FAKE_RECORDS * fake_flash_place();
}

uint32_t flash_unit(void)
{
    return fake_flash.kind.unit;
}

static uint32_t mask_of(uint32_t offset, uint32_t count)
{
    return (uint32_t)(((1ull << count / 4) - 1) << offset / 4);
}

static void assert_within(unsigned page, uint32_t offset, uint32_t count)
{
    TEST_ASSERT_LESS_THAN_UINT(FAKE_PAGES, page);
    TEST_ASSERT_EQUAL_UINT32(0, offset % fake_flash.kind.unit);
    TEST_ASSERT_EQUAL_UINT32(0, count % fake_flash.kind.unit);
    TEST_ASSERT_LESS_OR_EQUAL_UINT32(flash_page_size(), offset + count);
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    assert_within(page, offset, count);
    memcpy(words, &fake_flash.bytes[page][offset], count);
    return fake_flash.unreadable[page] & mask_of(offset, count) ? -1 : 0;
}

static bool power_fails_now(void)
{
    return ++fake_flash.operations == fake_flash.cut_at;
}

/* Not begun, half its bits, or all of them. */
static uint8_t written_partly(uint8_t old, uint8_t byte)
{
    static const uint8_t kept[FAKE_DAMAGES] = {0xFF, 0x5A, 0x00, 0x5A, 0xA5};

    return old & (uint8_t)(byte | kept[fake_flash.damage]);
}

static void spoil(unsigned page, uint32_t offset, uint32_t count)
{
    if (fake_flash.damage == UNREADABLE && fake_flash.kind.corrects)
        fake_flash.unreadable[page] |= mask_of(offset, count);
}

/* Of all that can be written a second time, every real flash takes zeros only. */
static void assert_allowed(unsigned page, uint32_t offset, const uint8_t *bytes)
{
    const uint8_t *at = &fake_flash.bytes[page][offset];
    unsigned set = 0;

    for (unsigned i = 0; i < fake_flash.kind.step; i++)
        set |= bytes[i];
    if (set == 0)
        return;
    TEST_ASSERT_FALSE_MESSAGE(fake_flash.weak[page], "written to a page whose erase was cut short");
    TEST_ASSERT_EACH_EQUAL_HEX8(0xFF, at, fake_flash.kind.step);
    TEST_ASSERT_EQUAL_HEX32(0, fake_flash.unreadable[page] & mask_of(offset, fake_flash.kind.step));
}

static void write_step(unsigned page, uint32_t offset, const uint8_t *bytes)
{
    uint8_t *at = &fake_flash.bytes[page][offset];
    bool cut = power_fails_now();

    assert_allowed(page, offset, bytes);
    for (unsigned i = 0; i < fake_flash.kind.step; i++)
        at[i] = cut ? written_partly(at[i], bytes[i]) : bytes[i];
    fake_flash.unreadable[page] &= ~mask_of(offset, fake_flash.kind.step);
    if (cut) {
        spoil(page, offset, fake_flash.kind.step);
        longjmp(fake_flash.cut, 1);
    }
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    assert_within(page, offset, count);
    fake_flash.writes++;
    if (fake_flash.worn[page] >> offset / fake_flash_place() & 1)
        return -1;
    for (uint32_t done = 0; done < count; done += fake_flash.kind.step)
        write_step(page, offset + done, (const uint8_t *)words + done);
    return fake_flash.write_fails ? -1 : 0;
}

/* Not begun, every other byte, all of them to all appearances, or all but the first place. */
static void erase_partly(unsigned page)
{
    unsigned first = fake_flash.damage == FIRST_PLACE_STAYS ? fake_flash_place() : 0;

    for (unsigned i = first; i < flash_page_size(); i++)
        if (fake_flash.damage == 2 || first > 0 || (fake_flash.damage != 0 && i % 2 == 0))
            fake_flash.bytes[page][i] = 0xFF;
    spoil(page, 0, flash_page_size());
}

int flash_erase(unsigned page)
{
    if (fake_flash.erase_fails)
        return -1;
    if (fake_flash.erase_does_nothing)
        return 0;
    fake_flash.erases++;
    fake_flash.weak[page] = power_fails_now();
    if (fake_flash.weak[page]) {
        erase_partly(page);
        longjmp(fake_flash.cut, 1);
    }
    memset(fake_flash.bytes[page], 0xFF, FAKE_PAGE_MAX);
    fake_flash.unreadable[page] = 0;
    return 0;
}

/* As an F1 has it, an F4, a G4, and chips that we have not met yet. */

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
static inline const uint8_t *memory_number(unsigned n)
{
    static uint8_t memory[CELL_COUNT];

    memory[0] = 0;
    for (unsigned p = 1; p < CELL_COUNT; p++)
        memory[p] = (uint8_t)(n + 1);
    return memory;
}

static inline int start(void)
{
    memset(found, 0, sizeof found);
    return flash_store_open(&store, found);
}

static inline int save(unsigned n)
{
    return flash_store_save(&store, memory_number(n), true);
}

static inline void save_many(unsigned count)
{
    TEST_ASSERT_TRUE(start() >= 0);
    for (unsigned n = 0; n < count; n++)
        TEST_ASSERT_EQUAL(0, save(n));
}

static inline void assert_found(unsigned n)
{
    TEST_ASSERT_EQUAL(1, start());
    TEST_ASSERT_EQUAL_UINT8_ARRAY(memory_number(n), found, CELL_COUNT);
}

#endif
