/* random.h: random numbers by xoroshiro64** of Blackman and Vigna: 8 bytes of state, 32-bit arithmetic only. */
#ifndef OCTET_RANDOM_H
#define OCTET_RANDOM_H

#include <stdint.h>

struct random {
    uint32_t state[2];   /* never both 0 */
};

void random_seed(struct random *random, uint32_t seed);
        /* Any seed is good; different seeds give different sequences. */

uint32_t random_next(struct random *random);
        /* The next 32 bits. */

uint8_t random_below(struct random *random, uint8_t n);
        /* Uniform in 0..n-1; n is 1..255. */

#endif
