#include "hal/flash_store/crc32.h"

enum { BITS_OF_BYTE = 8 };

static const uint32_t POLYNOMIAL = 0xEDB88320u;

uint32_t crc32_more(uint32_t before, const uint8_t bytes[], size_t count)
{
    uint32_t crc = ~before;

    for (size_t i = 0; i < count; i++) {
        crc ^= bytes[i];
        for (unsigned bit = 0; bit < BITS_OF_BYTE; bit++)
            crc = crc >> 1 ^ (crc & 1u ? POLYNOMIAL : 0u);
    }
    return ~crc;
}

uint32_t crc32(const uint8_t bytes[], size_t count)
{
    return crc32_more(0, bytes, count);
}
