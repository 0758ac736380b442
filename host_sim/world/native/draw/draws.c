#include "host_sim/world/native/draw/draws.h"

#include <string.h>

enum { MIDDLE = 397, KEY_WORDS = (DRAWS_TEXT_MAX + SHA512_BYTES) / 4 };

static const uint32_t TWIST = 0x9908b0df, HIGH = 0x80000000;

/* The key of Python's random.seed(): text and digest as one number, lowest word first. Returns how many words. */
static unsigned make_key(uint32_t key[KEY_WORDS], const char *text)
{
    uint8_t bytes[DRAWS_TEXT_MAX + SHA512_BYTES];
    size_t len = 0, size;

    for (; len < DRAWS_TEXT_MAX && text[len]; len++)
        bytes[len] = (uint8_t)text[len];
    size = len + SHA512_BYTES;
    sha512(bytes, len, bytes + len);
    memset(key, 0, KEY_WORDS * sizeof *key);
    for (size_t i = 0; i < size; i++)
        key[i / 4] |= (uint32_t)bytes[size - 1 - i] << 8 * (i % 4);
    return (unsigned)(size + 3) / 4;
}

static uint32_t mixed(uint32_t word)
{
    return word ^ word >> 30;
}

/* The next index, cyclic. */
static unsigned after(struct draws *draws, unsigned i)
{
    if (i + 1 < DRAWS_WORDS)
        return i + 1;
    draws->words[0] = draws->words[DRAWS_WORDS - 1];
    return 1;
}

void draws_seed(struct draws *draws, const char *text)
{
    uint32_t key[KEY_WORDS], *words = draws->words;
    unsigned len = make_key(key, text), at = 1;

    words[0] = 19650218;
    for (uint32_t i = 1; i < DRAWS_WORDS; i++)
        words[i] = 1812433253 * mixed(words[i - 1]) + i;
    for (unsigned i = 0; i < DRAWS_WORDS; i++) {
        words[at] = (words[at] ^ mixed(words[at - 1]) * 1664525) + key[i % len] + i % len;
        at = after(draws, at);
    }
    for (unsigned i = 1; i < DRAWS_WORDS; i++) {
        words[at] = (words[at] ^ mixed(words[at - 1]) * 1566083941) - at;
        at = after(draws, at);
    }
    words[0] = HIGH;
    draws->used = DRAWS_WORDS;
}

static void twist(struct draws *draws)
{
    uint32_t *words = draws->words;

    for (unsigned i = 0; i < DRAWS_WORDS; i++) {
        uint32_t joined = (words[i] & HIGH) | (words[(i + 1) % DRAWS_WORDS] & ~HIGH);

        words[i] = words[(i + MIDDLE) % DRAWS_WORDS] ^ joined >> 1 ^ (joined & 1 ? TWIST : 0);
    }
    draws->used = 0;
}

static uint32_t next_word(struct draws *draws)
{
    uint32_t word;

    if (draws->used == DRAWS_WORDS)
        twist(draws);
    word = draws->words[draws->used++];
    word ^= word >> 11;
    word ^= word << 7 & 0x9d2c5680;
    word ^= word << 15 & 0xefc60000;
    return word ^ word >> 18;
}

double draws_next(struct draws *draws)
{
    uint32_t high = next_word(draws) >> 5, low = next_word(draws) >> 6;

    return (high * 67108864.0 + low) / 9007199254740992.0;   /* 2^26 and 2^53 */
}

double draws_between(struct draws *draws, double low, double high)
{
    return low + (high - low) * draws_next(draws);
}
