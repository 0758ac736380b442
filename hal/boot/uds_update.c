/* Services that change the flash: erase, download, check. */
#include "hal/boot/uds_parts.h"

#include <string.h>

#include "hal/flash_store/flash.h"

enum {
    ROUTINE_ERASE = 0xFF00, ROUTINE_CHECK = 0xFF01, ROUTINE_FLOOR = 0xF000,
    ROUTINE_OPTIONS = 4,          /* their offset in a request */
    PLAIN = 0,                    /* not compressed, not encrypted */
    FOUR_AND_FOUR = 0x44,         /* number of bytes of address and size */
    BLOCK_LENGTH_OF_2 = 0x20,
    TRANSFER_DATA = 2             /* offset of data in a request */
};

static uint32_t erased_at_once(void)
{
    return LAYOUT.at_once * flash_page_size();
}

static uint32_t slot_bytes(void)
{
    return LAYOUT.slot_pages * flash_page_size();
}

static enum nrc refuse(struct uds *uds, enum refusal why, enum nrc nrc)
{
    uds->why = (uint8_t)why;
    return nrc;
}

/* Erase: takes the first byte to erase, and the header of the new image. All that can be wrong with them is found
 * before anything is erased. */
static enum nrc begin_erase(struct uds *uds, const struct exchange *exchange)
{
    const uint8_t *options = &exchange->request[ROUTINE_OPTIONS];
    enum refusal why;

    if (exchange->len != ROUTINE_OPTIONS + 4 + IMAGE_HEADER)
        return NRC_LENGTH;
    uds->loading = uds->loaded = uds->erased = false;
    uds->ahead = 0;
    uds->slot = choice_free_slot(&uds->choices->now);
    why = image_judge(&options[4], uds->slot, uds->choices->now.floor, &uds->image);
    if (why != REFUSAL_NONE)
        return refuse(uds, why, why == REFUSAL_OLDER ? NRC_CONDITIONS : NRC_RANGE);
    uds->at = uds->from = uds_number(options);
    if (uds->from % erased_at_once() != 0 || uds->from >= uds->image.size || uds->from > image_written(uds->slot))
        return NRC_RANGE;
    memcpy(uds->header, &options[4], IMAGE_HEADER);
    uds->why = REFUSAL_NONE;
    uds->work = WORK_ERASE;
    return NRC_PENDING;
}

/* The owner of the key may permit older versions. */
static enum nrc set_floor(struct uds *uds, struct exchange *exchange)
{
    struct choice next = uds->choices->now;

    if (exchange->len != ROUTINE_OPTIONS + 4)
        return NRC_LENGTH;
    next.floor = uds_number(&exchange->request[ROUTINE_OPTIONS]);
    uds_put(exchange, ROUTINE_FLOOR, 2);
    uds_put(exchange, 0, 1);
    return choices_save(uds->choices, &next, true) == 0 ? NRC_NONE : NRC_FAILURE;
}

enum nrc uds_routine(struct uds *uds, struct exchange *exchange)
{
    switch ((unsigned)exchange->request[2] << 8 | exchange->request[3]) {
    case ROUTINE_ERASE: return begin_erase(uds, exchange);
    case ROUTINE_FLOOR: return set_floor(uds, exchange);
    case ROUTINE_CHECK:
        if (exchange->len != ROUTINE_OPTIONS)
            return NRC_LENGTH;
        if (!uds->loaded)
            return NRC_SEQUENCE;
        uds->loaded = false;
        uds->work = WORK_CHECK;
        return NRC_PENDING;
    default: return NRC_RANGE;
    }
}

/* Downloads from the first erased byte to the end of the announced image. */
enum nrc uds_download(struct uds *uds, struct exchange *exchange)
{
    uint32_t end = uds->image.size + IMAGE_SIGNATURE;

    if (exchange->request[1] != PLAIN || exchange->request[2] != FOUR_AND_FOUR)
        return NRC_RANGE;
    if (!uds->erased && (!uds->loading || uds->took))   /* taken again while loading: its answer was lost */
        return NRC_SEQUENCE;
    if (uds_number(&exchange->request[3]) != uds->at || uds_number(&exchange->request[7]) != end - uds->at)
        return NRC_RANGE;
    uds->erased = false;
    uds->loading = true;
    uds->took = false;
    uds->number = 1;
    uds_put(exchange, BLOCK_LENGTH_OF_2, 1);
    uds_put(exchange, UDS_BLOCK_MAX, 2);
    return NRC_NONE;
}

/* Writes the next unit of the incoming block; the bytes need no alignment. */
static bool write_unit(struct uds *uds, const uint8_t *block)
{
    uint32_t words[FLASH_UNIT_MAX / 4];
    uint32_t at = uds->at + uds->ahead;

    memcpy(words, &block[uds->ahead], flash_unit());
    if (flash_write(LAYOUT.slot_page[uds->slot] + at / flash_page_size(), at % flash_page_size(), words,
                    flash_unit()) < 0)
        return false;
    uds->ahead += flash_unit();
    return true;
}

/* Writes before the block is complete. If that fails, it is tried again, and refused, once the block is complete. */
bool uds_ahead(struct uds *uds, const uint8_t request[], uint16_t len)
{
    uint32_t next = uds->ahead + flash_unit();

    return uds->loading && request[0] == TRANSFER && request[1] == uds->number && next + TRANSFER_DATA <= len &&
           next <= uds->image.size + IMAGE_SIGNATURE - uds->at && write_unit(uds, &request[TRANSFER_DATA]);
}

/* Whether a block is repeated because its answer was lost. */
static bool came_before(const struct uds *uds, uint8_t number)
{
    return number == (uint8_t)(uds->number - 1) && uds->took;
}

static enum nrc take_block(struct uds *uds, const uint8_t *bytes, uint32_t count)
{
    uint32_t end = uds->image.size + IMAGE_SIGNATURE;

    if (count == 0 || count % flash_unit() != 0 || count > end - uds->at)
        return NRC_RANGE;
    while (uds->ahead < count)
        if (!write_unit(uds, bytes)) {
            uds->loading = false;
            return refuse(uds, REFUSAL_FLASH, NRC_FAILURE);
        }
    uds->at += count;
    uds->ahead -= count;
    uds->number++;
    uds->took = true;
    return NRC_NONE;
}

enum nrc uds_transfer(struct uds *uds, struct exchange *exchange)
{
    uint8_t number = exchange->request[1];
    enum nrc why = NRC_NONE;

    if (!uds->loading)
        return NRC_SEQUENCE;
    if (number == uds->number)
        why = take_block(uds, &exchange->request[TRANSFER_DATA], exchange->len - (uint32_t)TRANSFER_DATA);
    else if (!came_before(uds, number))
        why = NRC_BLOCK;
    uds_put(exchange, number, 1);
    return why;
}

enum nrc uds_transfer_exit(struct uds *uds)
{
    if (uds->loaded)
        return NRC_NONE;   /* as above */
    if (!uds->loading || uds->at != uds->image.size + IMAGE_SIGNATURE)
        return NRC_SEQUENCE;
    uds->loading = false;
    uds->loaded = true;
    return NRC_NONE;
}

/* After the image, blank pages are skipped: erasing a page takes as long as the frames that fill it. */
static enum nrc erase_one(struct uds *uds)
{
    uint32_t page = uds->at / flash_page_size();
    bool needed = uds->at < uds->image.size + IMAGE_SIGNATURE || !image_page_is_blank(uds->slot, page);

    if (needed && flash_erase(LAYOUT.slot_page[uds->slot] + page) < 0)
        return refuse(uds, REFUSAL_FLASH, NRC_FAILURE);
    uds->at += erased_at_once();
    if (uds->at < slot_bytes())
        return NRC_PENDING;
    uds->at = uds->from;
    uds->erased = true;
    return NRC_NONE;
}

/* The old image is unlisted before its first page is erased. */
static enum nrc step_erase(struct uds *uds)
{
    struct choice cleared = choice_cleared(&uds->choices->now);

    if ((uds->choices->now.installed & 1u << uds->slot) != 0) {
        if (choices_save(uds->choices, &cleared, true) != 0)
            return refuse(uds, REFUSAL_FLASH, NRC_FAILURE);
        return NRC_PENDING;
    }
    return erase_one(uds);
}

static enum nrc check(struct uds *uds)
{
    struct choice next = choice_installed(&uds->choices->now);
    struct image image;
    enum refusal why = image_verify(uds->slot, &image);

    if (why == REFUSAL_NONE && !image_has_header(uds->slot, uds->header))
        why = REFUSAL_CHANGED;
    if (why != REFUSAL_NONE)
        return refuse(uds, why, NRC_FAILURE);
    if (choices_save(uds->choices, &next, true) != 0)
        return refuse(uds, REFUSAL_FLASH, NRC_FAILURE);
    return NRC_NONE;
}

enum nrc uds_step(struct uds *uds)
{
    return uds->work == WORK_ERASE ? step_erase(uds) : check(uds);
}
