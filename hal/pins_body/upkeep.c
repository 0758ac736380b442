#include "hal/pins_body/upkeep.h"

uint8_t upkeep_trait(const struct upkeep *upkeep, unsigned number)
{
    return upkeep->traits.value[number - TRAIT_FIRST];
}

void upkeep_use(const struct upkeep *upkeep, struct proximity *proximity, struct wheel *wheels)
{
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        proximity->near[i] = (uint16_t)(upkeep_trait(upkeep, BODY_NEAR_RIGHT + i) * TRAIT_LIGHT);
    for (unsigned side = 0; side < PINS_SIDES; side++) {
        int32_t dead = (upkeep_trait(upkeep, BODY_DEAD_LEFT + side) * TRAIT_DEAD_OF + TRAIT_DEAD_BY / 2)
                     / TRAIT_DEAD_BY;

        wheels[side].dead_more = (int16_t)(dead - WHEEL_DEAD);
        wheels[side].forward_more = (int16_t)(upkeep_trait(upkeep, BODY_FORWARD_LEFT + side) - WHEEL_FORWARD);
        wheels[side].lag_more_ms = (int16_t)(upkeep_trait(upkeep, BODY_LAG_MS) - WHEEL_LAG_MS);
    }
}

void upkeep_store(struct upkeep *upkeep)
{
    if (upkeep->unkept && traits_store(&upkeep->traits) < 0)
        upkeep->calibration.refused = BODY_REFUSED;
    upkeep->unkept = false;
}

static uint32_t value_of(const struct upkeep *upkeep, uint8_t number)
{
    if (number == BODY_MEASURE)
        return upkeep->calibration.measures;
    if (number == BODY_REFUSED)
        return upkeep->calibration.refused | (uint32_t)upkeep->calibration.found << 8;
    return upkeep_trait(upkeep, number);
}

static enum result set(struct upkeep *upkeep, uint8_t number, uint32_t value)
{
    struct traits traits = upkeep->traits;

    if (number == BODY_MEASURE) {
        calibrate_begin(&upkeep->calibration, (uint8_t)value);
        return RESULT_DONE;
    }
    traits.value[number - TRAIT_FIRST] = (uint8_t)value;
    if (traits_store(&traits) < 0)
        return RESULT_UNSTORED;
    upkeep->traits = traits;
    return RESULT_DONE;
}

static enum result try_to_set(struct upkeep *upkeep, uint8_t number, uint32_t value, bool running)
{
    if (number == BODY_REFUSED || !traits_fit(number, value))
        return RESULT_OUT_OF_RANGE;
    if (running || (number != BODY_MEASURE && upkeep->calibration.measures != MEASURE_NOTHING))
        return RESULT_OWNED;
    return set(upkeep, number, value);
}

void upkeep_serve(struct upkeep *upkeep, const struct command *command, bool running)
{
    uint8_t number = command->which;
    bool sets = command->opcode == OPCODE_SET;

    upkeep->serves = (sets || command->opcode == OPCODE_GET) && number >= BODY_MEASURE && number < BODY_PARAMETER_END;
    if (!upkeep->serves)
        return;
    upkeep->served = sets ? try_to_set(upkeep, number, command->value, running) : RESULT_DONE;
    upkeep->value = sets ? 0 : value_of(upkeep, number);
}

void upkeep_answer(const struct upkeep *upkeep, struct output *out)
{
    if (!upkeep->serves || !out->has_answer)
        return;
    out->answer = upkeep->served;
    out->answer_value = upkeep->value;
}
