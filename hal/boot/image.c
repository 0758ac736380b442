#include "hal/boot/image.h"

#include <string.h>

#include <monocypher.h>

#include "hal/boot/sha512.h"
#include "hal/flash_store/crc32.h"
#include "hal/flash_store/flash.h"

enum {
    PIECE = 64,              /* bytes read at once: the size of header and signature; all else is a multiple of it */
    FORMAT = 1,
    SIZE_AT = 8, CRC_AT = 12, VERSION_AT = 16, FORMAT_AT = 20, SLOT_AT = 21, LAYOUT_AT = 22, CHIP_AT = 24,
    BOARD_AT = 36
};

static const uint8_t MAGIC[8] = {'O', 'C', 'T', 'E', 'T', 'I', 'M', 'G'};

static uint32_t little_endian(const uint8_t *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

/* A text is padded with zeros to the size of its field. */
static bool is_text(const uint8_t *field, size_t size, const char *text)
{
    for (size_t i = 0; i < size; i++) {
        if (field[i] != (uint8_t)*text)
            return false;
        if (*text != '\0')
            text++;
    }
    return true;
}

static enum refusal judge_place(const uint8_t header[IMAGE_HEADER], unsigned slot)
{
    if (memcmp(header, MAGIC, sizeof MAGIC) != 0 || header[FORMAT_AT] != FORMAT)
        return REFUSAL_MAGIC;
    if (!is_text(&header[CHIP_AT], BOARD_AT - CHIP_AT, LAYOUT.chip))
        return REFUSAL_CHIP;
    if (!is_text(&header[BOARD_AT], IMAGE_HEADER - BOARD_AT, LAYOUT.board))
        return REFUSAL_BOARD;
    if (header[LAYOUT_AT] != LAYOUT.number)
        return REFUSAL_LAYOUT;
    return header[SLOT_AT] == slot ? REFUSAL_NONE : REFUSAL_SLOT;
}

enum refusal image_judge(const uint8_t header[IMAGE_HEADER], unsigned slot, uint32_t floor, struct image *out)
{
    struct image image = {little_endian(&header[SIZE_AT]), little_endian(&header[CRC_AT]),
                          little_endian(&header[VERSION_AT])};
    uint32_t room = LAYOUT.slot_pages * flash_page_size() - IMAGE_SIGNATURE;
    enum refusal why = judge_place(header, slot);

    if (why != REFUSAL_NONE)
        return why;
    if (image.size <= IMAGE_VECTORS || image.size > room || image.size % PIECE != 0)
        return REFUSAL_SIZE;
    if (image.version < floor)
        return REFUSAL_OLDER;
    *out = image;
    return REFUSAL_NONE;
}

static bool read(unsigned slot, uint32_t at, uint32_t words[PIECE / 4])
{
    uint32_t page = LAYOUT.slot_page[slot] + at / flash_page_size();

    return flash_read(page, at % flash_page_size(), words, PIECE) == 0;
}

uint32_t image_crc(unsigned slot, uint32_t end, bool *readable)
{
    uint32_t words[PIECE / 4];
    uint32_t crc = 0;

    *readable = true;
    for (uint32_t at = 0; at < end && *readable; at += PIECE) {
        uint32_t skipped = at == 0 ? VERSION_AT : 0;   /* skips magic, size and the CRC itself */

        *readable = read(slot, at, words);
        crc = crc32_more(crc, (const uint8_t *)words + skipped, PIECE - skipped);
    }
    return crc;
}

bool image_page_is_blank(unsigned slot, uint32_t page)
{
    uint32_t words[PIECE / 4];
    uint32_t all = UINT32_MAX;

    for (uint32_t at = 0; at < flash_page_size() && all == UINT32_MAX; at += PIECE) {
        if (!read(slot, page * flash_page_size() + at, words))
            return false;
        for (unsigned i = 0; i < PIECE / 4; i++)
            all &= words[i];
    }
    return all == UINT32_MAX;
}

uint32_t image_written(unsigned slot)
{
    uint32_t pages = LAYOUT.slot_pages;

    while (pages > 0 && image_page_is_blank(slot, pages - 1))
        pages--;
    return pages > 0 ? (pages - 1) / LAYOUT.at_once * LAYOUT.at_once * flash_page_size() : 0;
}

uint32_t image_version(unsigned slot)
{
    uint32_t header[PIECE / 4];

    return read(slot, 0, header) ? header[VERSION_AT / 4] : 0;
}

bool image_has_header(unsigned slot, const uint8_t header[IMAGE_HEADER])
{
    uint32_t words[PIECE / 4];

    return read(slot, 0, words) && memcmp(words, header, IMAGE_HEADER) == 0;
}

enum refusal image_check(unsigned slot, struct image *out)
{
    uint32_t header[PIECE / 4];
    bool readable;
    enum refusal why;

    if (!read(slot, 0, header))
        return REFUSAL_DAMAGED;
    why = image_judge((const uint8_t *)header, slot, 0, out);
    if (why != REFUSAL_NONE)
        return why;
    if (image_crc(slot, out->size, &readable) != out->crc || !readable)
        return REFUSAL_DAMAGED;
    return REFUSAL_NONE;
}

/* Checks an Ed25519 signature (RFC 8032 5.1.7), given the hash of R, key and message. */
static bool equation_holds(const uint8_t signature[IMAGE_SIGNATURE], struct sha512 *hash)
{
    uint8_t long_hash[SHA512_BYTES];
    uint8_t reduced[IMAGE_KEY];

    sha512_end(hash, long_hash);
    crypto_eddsa_reduce(reduced, long_hash);
    return crypto_eddsa_check_equation(signature, IMAGE_SIGNER, reduced) == 0;
}

static void begin(struct sha512 *hash, const uint8_t signature[IMAGE_SIGNATURE])
{
    sha512_begin(hash);
    sha512_add(hash, signature, IMAGE_KEY);
    sha512_add(hash, IMAGE_SIGNER, IMAGE_KEY);
}

bool image_proves(const uint8_t signature[IMAGE_SIGNATURE], const uint8_t text[], size_t count)
{
    struct sha512 hash;

    begin(&hash, signature);
    sha512_add(&hash, text, count);
    return equation_holds(signature, &hash);
}

enum refusal image_verify(unsigned slot, struct image *out)
{
    uint32_t signature[PIECE / 4];
    uint32_t words[PIECE / 4];
    struct sha512 hash;
    enum refusal why = image_check(slot, out);

    if (why != REFUSAL_NONE)
        return why;
    if (!read(slot, out->size, signature))
        return REFUSAL_DAMAGED;
    begin(&hash, (const uint8_t *)signature);
    for (uint32_t at = 0; at < out->size; at += PIECE) {
        if (!read(slot, at, words))
            return REFUSAL_DAMAGED;
        sha512_add(&hash, (const uint8_t *)words, PIECE);
    }
    return equation_holds((const uint8_t *)signature, &hash) ? REFUSAL_NONE : REFUSAL_SIGNATURE;
}
