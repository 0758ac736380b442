#include "firmware/random.h"

enum { TRIES_MAX = 64 };   /* the chance that so many draws in a row fail is below 2^-64 */

static uint32_t rotated(uint32_t x, unsigned bits)
{
    return (x << bits) | (x >> (32u - bits));
}

/* Steps of splitmix32: neighbouring seeds must not give neighbouring states. */
static uint32_t mixed(uint32_t x)
{
    x = (x ^ (x >> 16)) * 0x21f0aaadu;
    x = (x ^ (x >> 15)) * 0x735a2d97u;
    return x ^ (x >> 15);
}

void random_seed(struct random *random, uint32_t seed)
{
    /* The mixing is a bijection and the two arguments differ, so at most one word is 0. */
    for (unsigned i = 0; i < 2; i++) {
        seed += 0x9e3779b9u;
        random->state[i] = mixed(seed);
    }
}

uint32_t random_next(struct random *random)
{
    uint32_t s0 = random->state[0];
    uint32_t s1 = random->state[1] ^ s0;

    random->state[0] = rotated(s0, 26) ^ s1 ^ (s1 << 9);
    random->state[1] = rotated(s1, 13);
    return rotated(s0 * 0x9e3779bbu, 5) * 5u;
}

uint8_t random_below(struct random *random, uint8_t n)
{
    uint8_t mask = (uint8_t)(n - 1u);
    uint8_t drawn = 0;

    mask |= (uint8_t)(mask >> 1);
    mask |= (uint8_t)(mask >> 2);
    mask |= (uint8_t)(mask >> 4);
    /* Rejecting numbers that are too big keeps the rest uniform; a remainder would favour small numbers. */
    for (unsigned tries = 0; tries < TRIES_MAX; tries++) {
        drawn = (uint8_t)(random_next(random) >> 24) & mask;
        if (drawn < n)
            return drawn;
    }
    return 0;
}
