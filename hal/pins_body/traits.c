#include "hal/pins_body/traits.h"

#include "hal/can_body/port.h"

#define RANGE(parameter, minimum, maximum, initial) {minimum, maximum, initial},

static const struct {
    uint8_t min, max, initial;
} ranges[] = {BODY_PARAMETERS(RANGE)};

/* Traits measured together are stored together: light and track, then motors. */
enum { EACH = 6, RECORDS = (TRAITS_KEPT + EACH - 1) / EACH };

bool traits_fit(uint8_t number, uint32_t value)
{
    return value >= ranges[number - BODY_MEASURE].min && value <= ranges[number - BODY_MEASURE].max;
}

void traits_load(struct traits *traits)
{
    uint8_t bytes[CELL_COUNT];

    for (unsigned i = 0; i < TRAITS_KEPT; i++) {
        uint8_t number = (uint8_t)(TRAIT_FIRST + i);
        unsigned at = i % EACH;

        if (at == 0 && port_load_more(i / EACH, bytes) != 1)
            for (unsigned byte = 0; byte < CELL_COUNT; byte++)
                bytes[byte] = 0;
        traits->value[i] = traits_fit(number, bytes[at]) ? bytes[at] : ranges[number - BODY_MEASURE].initial;
    }
}

int traits_store(const struct traits *traits)
{
    int result = 0;

    for (unsigned record = 0; record < RECORDS && result == 0; record++) {
        uint8_t bytes[CELL_COUNT] = {0};

        for (unsigned i = 0; i < EACH && record * EACH + i < TRAITS_KEPT; i++)
            bytes[i] = traits->value[record * EACH + i];
        result = port_store_more(record, bytes);
    }
    return result;
}
