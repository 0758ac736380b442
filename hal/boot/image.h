/* image.h: an image in its slot: header, program, signature. docs/update.md has the format. */
#ifndef OCTET_IMAGE_H
#define OCTET_IMAGE_H

#include <stddef.h>

#include "hal/boot/layout.h"

enum {
    IMAGE_HEADER = 64,       /* bytes */
    IMAGE_VECTORS = 256,     /* where the program begins, bytes from the begin of the slot */
    IMAGE_SIGNATURE = 64,    /* Ed25519, over all that is before it */
    IMAGE_KEY = 32
};

/* Why an image is not taken. */
enum refusal {
    REFUSAL_NONE, REFUSAL_MAGIC, REFUSAL_CHIP, REFUSAL_BOARD, REFUSAL_LAYOUT, REFUSAL_SLOT, REFUSAL_SIZE, REFUSAL_OLDER,
    REFUSAL_CHANGED, REFUSAL_DAMAGED, REFUSAL_SIGNATURE, REFUSAL_FLASH
};

struct image {
    uint32_t size;       /* bytes up to the signature, a multiple of 64 */
    uint32_t crc;        /* CRC-32 of those from the version on, up to the signature */
    uint32_t version;
};

extern const uint8_t IMAGE_SIGNER[IMAGE_KEY];   /* the public key that images and testers are proven with */

enum refusal image_judge(const uint8_t header[IMAGE_HEADER], unsigned slot, uint32_t floor, struct image *out);
        /* Whether an image with that header may be written to the slot. *out is filled if so. */

enum refusal image_check(unsigned slot, struct image *out);
        /* Whether what the slot holds is whole: its header, whatever its version, and its CRC. */

enum refusal image_verify(unsigned slot, struct image *out);
        /* The same, and whether it is signed. Takes 0.1 s on a Cortex-M3 at 72 MHz. */

uint32_t image_crc(unsigned slot, uint32_t end, bool *readable);
        /* CRC-32 of the bytes of a slot from VERSION on; end is a multiple of 64. */

uint32_t image_version(unsigned slot);
        /* As the header of what is in the slot has it; 0 if that cannot be read. Nothing is checked. */

bool image_page_is_blank(unsigned slot, uint32_t page);
        /* False also if it cannot be read. */

uint32_t image_written(unsigned slot);
        /* Bytes of the whole pages that are written in a slot: up to the last that is not blank, without that one, which a
           loss of power may have cut short. */

bool image_has_header(unsigned slot, const uint8_t header[IMAGE_HEADER]);
        /* Whether the slot begins with it. */

bool image_proves(const uint8_t signature[IMAGE_SIGNATURE], const uint8_t text[], size_t count);
        /* Whether IMAGE_SIGNER's owner has signed that text. */

#endif
