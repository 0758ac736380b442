#include "hal/pins_body/body_parameters.h"

uint8_t parameters_value(const struct body_parameters *parameters, unsigned number)
{
    return parameters->values.value[number - CALIBRATION_FIRST];
}

void parameters_apply(const struct body_parameters *parameters, struct proximity *proximity, struct wheel *wheels)
{
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        proximity->near[i] = (uint16_t)(parameters_value(parameters, BODY_NEAR_RIGHT + i) * CALIBRATION_LIGHT);
    for (unsigned side = 0; side < PINS_SIDES; side++) {
        uint8_t units = parameters_value(parameters, BODY_DEAD_LEFT + side);
        int32_t dead = (units * CALIBRATION_DEAD_OF + CALIBRATION_DEAD_BY / 2) / CALIBRATION_DEAD_BY;

        wheels[side].dead_more = (int16_t)(dead - WHEEL_DEAD);
        wheels[side].forward_more = (int16_t)(parameters_value(parameters, BODY_FORWARD_LEFT + side) - WHEEL_FORWARD);
        wheels[side].lag_more_ms = (int16_t)(parameters_value(parameters, BODY_LAG_MS) - WHEEL_LAG_MS);
    }
}

void parameters_store(struct body_parameters *parameters)
{
    if (parameters->unstored && calibration_store(&parameters->values) < 0)
        parameters->calibration.refused = BODY_REFUSED;
    parameters->unstored = false;
}

static uint32_t value_of(const struct body_parameters *parameters, uint8_t number)
{
    if (number == BODY_MEASURE)
        return parameters->calibration.measures;
    if (number == BODY_REFUSED)
        return parameters->calibration.refused | (uint32_t)parameters->calibration.found << 8;
    return parameters_value(parameters, number);
}

static enum result set(struct body_parameters *parameters, uint8_t number, uint32_t value)
{
    struct calibration_values values = parameters->values;

    if (number == BODY_MEASURE) {
        calibrate_begin(&parameters->calibration, (uint8_t)value);
        return RESULT_DONE;
    }
    values.value[number - CALIBRATION_FIRST] = (uint8_t)value;
    if (calibration_store(&values) < 0)
        return RESULT_UNSTORED;
    parameters->values = values;
    return RESULT_DONE;
}

static enum result try_to_set(struct body_parameters *parameters, uint8_t number, uint32_t value, bool running)
{
    if (number == BODY_REFUSED || !calibration_fit(number, value))
        return RESULT_OUT_OF_RANGE;
    if (running || (number != BODY_MEASURE && parameters->calibration.measures != MEASURE_NOTHING))
        return RESULT_OWNED;
    return set(parameters, number, value);
}

void parameters_serve(struct body_parameters *parameters, const struct command *command, bool running)
{
    uint8_t number = command->which;
    bool sets = command->opcode == OPCODE_SET;

    parameters->serves = (sets || command->opcode == OPCODE_GET)
        && number >= BODY_MEASURE && number < BODY_PARAMETER_END;
    if (!parameters->serves)
        return;
    parameters->served = sets ? try_to_set(parameters, number, command->value, running) : RESULT_DONE;
    parameters->value = sets ? 0 : value_of(parameters, number);
}

void parameters_answer(const struct body_parameters *parameters, struct output *out)
{
    if (!parameters->serves || !out->has_answer)
        return;
    out->answer = parameters->served;
    out->answer_value = parameters->value;
}
