#include "hal/flash_store/crc32.h"

enum { TWO_BITS = 2, LOWER_TWO = 3 };

/* What two bits become that leave the register. Single bits take twice as long, four have a table of 64 bytes. */
static const uint32_t remainders[LOWER_TWO + 1] = {0x00000000u, 0x76DC4190u, 0xEDB88320u, 0x9B64C2B0u};

uint32_t crc32_more(uint32_t before, const uint8_t bytes[], size_t count)
{
    uint32_t crc = ~before;

    for (size_t i = 0; i < count; i++) {
        crc ^= bytes[i];
        crc = crc >> TWO_BITS ^ remainders[crc & LOWER_TWO];
        crc = crc >> TWO_BITS ^ remainders[crc & LOWER_TWO];
        crc = crc >> TWO_BITS ^ remainders[crc & LOWER_TWO];
        crc = crc >> TWO_BITS ^ remainders[crc & LOWER_TWO];
    }
    return ~crc;
}

uint32_t crc32(const uint8_t bytes[], size_t count)
{
    return crc32_more(0, bytes, count);
}
