/* any.h: arbitrary values, for the analyser: each read of a volatile may bring any value of its type. */
#ifndef OCTET_PROOF_ANY_H
#define OCTET_PROOF_ANY_H

#include <stdbool.h>
#include <stdint.h>

static volatile uint8_t any_u8;
static volatile uint16_t any_u16;
static volatile uint32_t any_u32;

static inline bool any_bool(void)
{
    return any_u8 != 0;
}

static inline uint8_t any_between(uint8_t least, uint8_t most)
{
    uint8_t value = any_u8;

    return value < least || value > most ? least : value;
}

#endif
