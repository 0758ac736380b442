/* crc32.h: the CRC-32 of Ethernet and zip: polynomial 0xEDB88320 reflected, start and final xor all ones. */
#ifndef OCTET_CRC32_H
#define OCTET_CRC32_H

#include <stddef.h>
#include <stdint.h>

uint32_t crc32(const uint8_t bytes[], size_t count);

uint32_t crc32_more(uint32_t before, const uint8_t bytes[], size_t count);
        /* Continues the CRC in before with these bytes; before is 0 at the start. */

#endif
