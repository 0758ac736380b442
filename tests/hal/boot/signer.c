#include "signer.h"

#include <string.h>

#include <monocypher.h>

#include "hal/boot/sha512.h"
#include "hal/flash_store/crc32.h"

enum { SIZE_AT = 8, CRC_AT = 12, VERSION_AT = 16, SIZE = SIGNED_BYTES - IMAGE_SIGNATURE };

/* Test 3 of RFC 8032 7.1: this key, and its public half. */
static const uint8_t SECRET[32] = {
    0xC5, 0xAA, 0x8D, 0xF4, 0x3F, 0x9F, 0x83, 0x7B, 0xED, 0xB7, 0x44, 0x2F, 0x31, 0xDC, 0xB7, 0xB1,
    0x66, 0xD3, 0x85, 0x35, 0x07, 0x6F, 0x09, 0x4B, 0x85, 0xCE, 0x3A, 0x2E, 0x0B, 0x44, 0x58, 0xF7,
};
const uint8_t IMAGE_SIGNER[IMAGE_KEY] = {
    0xFC, 0x51, 0xCD, 0x8E, 0x62, 0x18, 0xA1, 0xA3, 0x8D, 0xA4, 0x7E, 0xD0, 0x02, 0x30, 0xF0, 0x58,
    0x08, 0x16, 0xED, 0x13, 0xBA, 0x33, 0x03, 0xAC, 0x5D, 0xEB, 0x91, 0x15, 0x48, 0x90, 0x80, 0x25,
};

static void reduced_hash(const uint8_t a[32], const uint8_t b[32], const uint8_t text[], size_t count, uint8_t out[32])
{
    struct sha512 hash;
    uint8_t long_hash[SHA512_BYTES];

    sha512_begin(&hash);
    sha512_add(&hash, a, 32);
    if (b)
        sha512_add(&hash, b, 32);
    sha512_add(&hash, text, count);
    sha512_end(&hash, long_hash);
    crypto_eddsa_reduce(out, long_hash);
}

/* RFC 8032 5.1.6. */
void signer_sign(const uint8_t text[], size_t count, uint8_t signature[IMAGE_SIGNATURE])
{
    uint8_t expanded[SHA512_BYTES], scalar[32], r[32], h[32];
    struct sha512 hash;

    sha512_begin(&hash);
    sha512_add(&hash, SECRET, sizeof SECRET);
    sha512_end(&hash, expanded);
    crypto_eddsa_trim_scalar(scalar, expanded);
    reduced_hash(&expanded[32], NULL, text, count, r);
    crypto_eddsa_scalarbase(signature, r);
    reduced_hash(signature, IMAGE_SIGNER, text, count, h);
    crypto_eddsa_mul_add(&signature[32], h, scalar, r);
}

static void put(uint8_t *at, uint32_t number)
{
    for (unsigned i = 0; i < 4; i++)
        at[i] = (uint8_t)(number >> 8 * i);
}

void signer_seal(struct signed_image *image)
{
    put(&image->bytes[CRC_AT], crc32(&image->bytes[VERSION_AT], SIZE - VERSION_AT));
    signer_sign(image->bytes, SIZE, &image->bytes[SIZE]);
}

struct signed_image signer_image(unsigned slot, uint32_t version)
{
    struct signed_image image;

    for (unsigned i = 0; i < SIGNED_BYTES; i++)
        image.bytes[i] = (uint8_t)(i * 7 + version);
    memset(image.bytes, 0, IMAGE_HEADER);
    memcpy(image.bytes, "OCTETIMG", 8);
    put(&image.bytes[SIZE_AT], SIZE);
    put(&image.bytes[VERSION_AT], version);
    image.bytes[20] = 1;
    image.bytes[21] = (uint8_t)slot;
    image.bytes[22] = LAYOUT.number;
    memcpy(&image.bytes[24], LAYOUT.chip, strlen(LAYOUT.chip));
    memcpy(&image.bytes[36], LAYOUT.board, strlen(LAYOUT.board));
    signer_seal(&image);
    return image;
}

void signer_put(unsigned slot, uint32_t version)
{
    struct signed_image image = signer_image(slot, version);

    memcpy(boot_flash_slot(slot), image.bytes, sizeof image.bytes);
}
