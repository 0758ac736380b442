#include "hal/pins_body/calibration_values.h"

#include "hal/can_body/port.h"

#define RANGE(parameter, minimum, maximum, initial) {minimum, maximum, initial},

static const struct {
    uint8_t min, max, initial;
} ranges[] = {BODY_PARAMETERS(RANGE)};

/* Values measured together are stored together: light and track, then motors. */
enum { EACH = 6, RECORDS = (CALIBRATION_VALUES + EACH - 1) / EACH };

bool calibration_fit(uint8_t number, uint32_t value)
{
    return value >= ranges[number - BODY_MEASURE].min && value <= ranges[number - BODY_MEASURE].max;
}

void calibration_load(struct calibration_values *values)
{
    uint8_t bytes[CELL_COUNT];

    for (unsigned i = 0; i < CALIBRATION_VALUES; i++) {
        uint8_t number = (uint8_t)(CALIBRATION_FIRST + i);
        unsigned at = i % EACH;

        if (at == 0 && port_load_more(i / EACH, bytes) != 1)
            for (unsigned byte = 0; byte < CELL_COUNT; byte++)
                bytes[byte] = 0;
        values->value[i] = calibration_fit(number, bytes[at]) ? bytes[at] : ranges[number - BODY_MEASURE].initial;
    }
}

int calibration_store(const struct calibration_values *values)
{
    int result = 0;

    for (unsigned record = 0; record < RECORDS && result == 0; record++) {
        uint8_t bytes[CELL_COUNT] = {0};

        for (unsigned i = 0; i < EACH && record * EACH + i < CALIBRATION_VALUES; i++)
            bytes[i] = values->value[record * EACH + i];
        result = port_store_more(record, bytes);
    }
    return result;
}
