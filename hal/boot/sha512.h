/* sha512.h: SHA-512 (FIPS 180-4), fed piece by piece. */
#ifndef OCTET_SHA512_H
#define OCTET_SHA512_H

#include <stddef.h>
#include <stdint.h>

enum { SHA512_BYTES = 64, SHA512_BLOCK = 128 };

struct sha512 {
    uint64_t state[8];
    uint32_t count;                /* bytes so far, under 512 MB */
    uint8_t block[SHA512_BLOCK];   /* those of the last, incomplete block */
};

void sha512_begin(struct sha512 *hash);
void sha512_add(struct sha512 *hash, const uint8_t bytes[], size_t count);
void sha512_end(struct sha512 *hash, uint8_t out[SHA512_BYTES]);
        /* Consumes hash: call sha512_begin before using it again. */

void sha512(const uint8_t bytes[], size_t count, uint8_t out[SHA512_BYTES]);
        /* Hashes everything in one call. */

#endif
