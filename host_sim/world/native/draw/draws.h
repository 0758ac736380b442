/* draws.h: random numbers, the same as random.Random(text).random() in every version of Python. */
#ifndef OCTET_DRAWS_H
#define OCTET_DRAWS_H

#include <stddef.h>
#include <stdint.h>

enum { DRAWS_WORDS = 624, DRAWS_TEXT_MAX = 100 };

struct draws {   /* a Mersenne Twister, MT19937 */
    uint32_t words[DRAWS_WORDS];
    uint32_t used;   /* of the words, since they were made */
};

void draws_seed(struct draws *draws, const char *text);
        /* Seeds the generator with a text of at most DRAWS_TEXT_MAX characters; further ones are ignored. */

double draws_next(struct draws *draws);
        /* A number from 0 up to, but not including, 1. */

double draws_between(struct draws *draws, double low, double high);
        /* A uniform number from low to high. */

/* SHA-512 (FIPS 180-4), fed piece by piece. */

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
