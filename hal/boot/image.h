/* image.h: an image in its slot: header, program, signature. docs/update.md has the format. */
#ifndef OCTET_IMAGE_H
#define OCTET_IMAGE_H

#include <stddef.h>

#include "hal/boot/layout.h"

enum {
    IMAGE_HEADER = 64,       /* bytes */
    IMAGE_VECTORS = 256,     /* where the program begins, bytes from the start of the slot */
    IMAGE_SIGNATURE = 64,    /* Ed25519, over everything before it */
    IMAGE_KEY = 32
};

/* Why an image is refused. */
enum refusal {
    REFUSAL_NONE, REFUSAL_MAGIC, REFUSAL_CHIP, REFUSAL_BOARD, REFUSAL_LAYOUT, REFUSAL_SLOT, REFUSAL_SIZE,
    REFUSAL_OLDER, REFUSAL_CHANGED, REFUSAL_DAMAGED, REFUSAL_SIGNATURE, REFUSAL_FLASH
};

struct image {
    uint32_t size;       /* bytes up to the signature, a multiple of 64 */
    uint32_t crc;        /* CRC-32 from the version up to the signature */
    uint32_t version;
};

extern const uint8_t IMAGE_SIGNER[IMAGE_KEY];   /* the public key that authenticates images and testers */

enum refusal image_judge(const uint8_t header[IMAGE_HEADER], unsigned slot, uint32_t floor, struct image *out);
        /* Whether an image with that header may be written to the slot. Fills *out if so. */

enum refusal image_check(unsigned slot, struct image *out);
        /* Whether the slot holds an intact image: a valid header of any version, and the right CRC. */

enum refusal image_verify(unsigned slot, struct image *out);
        /* Also checks the signature. Takes 0.1 s on a Cortex-M3 at 72 MHz. */

uint32_t image_crc(unsigned slot, uint32_t end, bool *readable);
        /* CRC-32 of the bytes of a slot from VERSION on; end is a multiple of 64. */

uint32_t image_version(unsigned slot);
        /* The version in the slot's header, unchecked; 0 if it cannot be read. */

bool image_page_is_blank(unsigned slot, uint32_t page);
        /* False also if it cannot be read. */

uint32_t image_written(unsigned slot);
        /* Bytes of the slot's pages before the last one that is not blank; a loss of power may have cut that one
           short. */

bool image_has_header(unsigned slot, const uint8_t header[IMAGE_HEADER]);
        /* Whether the slot begins with it. */

bool image_proves(const uint8_t signature[IMAGE_SIGNATURE], const uint8_t text[], size_t count);
        /* Whether the signature of that text is valid for IMAGE_SIGNER. */

#endif
