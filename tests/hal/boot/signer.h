/* signer.h: images for the chip of boot_flash.h, signed or spoilt. */
#ifndef OCTET_SIGNER_H
#define OCTET_SIGNER_H

#include "hal/boot/image.h"

#include "boot_flash.h"

enum { PROGRAM_BYTES = 320, SIGNED_BYTES = IMAGE_VECTORS + PROGRAM_BYTES + IMAGE_SIGNATURE };

struct signed_image {
    uint8_t bytes[SIGNED_BYTES];
};

void signer_sign(const uint8_t text[], size_t count, uint8_t signature[IMAGE_SIGNATURE]);
        /* By the owner of IMAGE_SIGNER. */

struct signed_image signer_image(unsigned slot, uint32_t version);
        /* For that slot; two of different versions differ everywhere. */

void signer_seal(struct signed_image *image);
        /* Its CRC and its signature fit again, whatever was changed. */

void signer_put(unsigned slot, uint32_t version);
        /* A probe has written such an image there. */

#endif
