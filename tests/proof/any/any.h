/* any.h: arbitrary values, for the harnesses here. To the analyser each may be any value of its type (any.c); the fuzzer
 * takes them from its input (fuzzed.c). */
#ifndef OCTET_PROOF_ANY_H
#define OCTET_PROOF_ANY_H

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>

uint8_t any_u8(void);

bool any_more(void);
        /* Whether to go on. */

void exercise(void);
        /* What a harness does: it calls one part with any values, in any order. */

/* What has to hold: the fuzzer takes an abort for harm. */
static inline void must(bool holds)
{
    if (!holds)
        abort();
}

static inline bool any_bool(void)
{
    return any_u8() % 2 != 0;
}

static inline uint16_t any_u16(void)
{
    uint8_t high = any_u8();

    return (uint16_t)(high << 8 | any_u8());
}

static inline uint32_t any_u32(void)
{
    uint32_t high = any_u16();

    return high << 16 | any_u16();
}

static inline uint8_t any_between(uint8_t least, uint8_t most)
{
    uint8_t value = any_u8();

    return value < least || value > most ? least : value;
}

#endif
