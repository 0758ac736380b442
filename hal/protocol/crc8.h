/* crc8.h: CRC-8 SAE J1850: polynomial 0x1D, start 0xFF, final xor 0xFF. Finds every error of one or two bits here. */
#ifndef OCTET_CRC8_H
#define OCTET_CRC8_H

#include "hal/link/link.h"

uint8_t crc8_of_frame(const struct frame *frame);
        /* Over the identifier, low byte first, and all data but byte 0, where the result is kept. */

#endif
