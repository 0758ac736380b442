#include "hal/protocol/e2e.h"

/* Works by half-bytes: a quarter of the work of a bitwise CRC, for a table of 16 bytes. */
static uint8_t fed(uint8_t crc, uint8_t byte)
{
    static const uint8_t table[16] = {
        0x00, 0x1D, 0x3A, 0x27, 0x74, 0x69, 0x4E, 0x53, 0xE8, 0xF5, 0xD2, 0xCF, 0x9C, 0x81, 0xA6, 0xBB,
    };

    crc ^= byte;
    crc = (uint8_t)(crc << 4) ^ table[crc >> 4];
    return (uint8_t)(crc << 4) ^ table[crc >> 4];
}

static uint8_t crc_of(const struct frame *frame)
{
    uint8_t crc = fed(0, (uint8_t)(frame->id & 0xFFu));

    crc = fed(crc, (uint8_t)((frame->id >> 8) & 0xFFu));
    for (unsigned i = 1; i < frame->len; i++)
        crc = fed(crc, frame->data[i]);
    return crc;
}

void e2e_protect(struct frame *frame)
{
    frame->data[0] = crc_of(frame);
}

bool e2e_is_whole(const struct frame *frame, uint8_t len)
{
    return frame->len == len && e2e_counter(frame) < E2E_COUNTERS && frame->data[0] == crc_of(frame);
}

uint8_t e2e_counter(const struct frame *frame)
{
    return frame->data[1] & 15u;
}

uint8_t e2e_next(uint8_t counter)
{
    return counter + 1u < E2E_COUNTERS ? (uint8_t)(counter + 1u) : 0;
}

unsigned e2e_ahead(uint8_t from, uint8_t to)
{
    return to >= from ? (unsigned)(to - from) : (unsigned)(to + E2E_COUNTERS - from);
}
