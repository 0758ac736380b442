#include "hal/boot/uds_parts.h"

enum { QUIET = 0x80 /* in a subfunction: no positive answer */, FUNCTIONS = 8, P2_MS = 50, P2_STAR_10_MS = 500 };

uint32_t uds_number(const uint8_t *bytes)
{
    return (uint32_t)bytes[0] << 24 | (uint32_t)bytes[1] << 16 | (uint32_t)bytes[2] << 8 | bytes[3];
}

void uds_put(struct exchange *exchange, uint32_t number, unsigned bytes)
{
    while (bytes-- > 0 && exchange->size < UDS_ANSWER_MAX)
        exchange->answer[exchange->size++] = (uint8_t)(number >> 8 * bytes);
}

void uds_put_times(struct exchange *exchange)
{
    uds_put(exchange, P2_MS, 2);
    uds_put(exchange, P2_STAR_10_MS, 2);
}

static bool has_function(const struct entry *entry, unsigned function)
{
    return function < FUNCTIONS && (entry->functions & 1u << function) != 0;
}

static enum nrc check(const struct entry *entry, unsigned given, struct exchange *exchange)
{
    unsigned missing = entry->takes & ~given;

    if ((missing & PROGRAMMING) != 0)
        return NRC_SESSION;
    if ((missing & UNLOCKED) != 0)
        return NRC_LOCKED;
    if (exchange->len < entry->shortest)
        return NRC_LENGTH;
    if (entry->functions != 0) {
        exchange->function = exchange->request[1] & (uint8_t)~QUIET;
        exchange->quiet = (exchange->request[1] & QUIET) != 0;
        if (!has_function(entry, exchange->function))
            return NRC_FUNCTION;
        uds_put(exchange, exchange->function, 1);
    }
    return (entry->takes & EXACT) != 0 && exchange->len != entry->shortest ? NRC_LENGTH : NRC_NONE;
}

enum nrc uds_admit(const struct entry *entry, const struct entry *end, unsigned given, struct exchange *exchange)
{
    uds_put(exchange, exchange->request[0] | (uint32_t)POSITIVE, 1);
    while (entry < end && entry->service != exchange->request[0])
        entry++;
    return entry < end ? check(entry, given, exchange) : NRC_SERVICE;
}

uint16_t uds_refuse(uint8_t service, enum nrc why, uint8_t answer[])
{
    answer[0] = NEGATIVE;
    answer[1] = service;
    answer[2] = (uint8_t)why;
    return 3;
}

uint16_t uds_answer(struct exchange *exchange, enum nrc why)
{
    if (why != NRC_NONE)
        return uds_refuse(exchange->request[0], why, exchange->answer);
    return exchange->quiet ? 0 : exchange->size;
}
