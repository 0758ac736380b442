#include "hal/boot/uds_parts.h"

uint32_t uds_number(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

void uds_put(struct exchange *exchange, uint32_t number, unsigned bytes)
{
    while (bytes-- > 0 && exchange->size < UDS_ANSWER_MAX)
        exchange->answer[exchange->size++] = (uint8_t)(number >> 8 * bytes);
}
