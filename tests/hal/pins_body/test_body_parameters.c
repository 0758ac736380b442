#include "hal/pins_body/body_parameters.h"

#include <string.h>

#include "hal/can_body/port.h"
#include "host_sim/world/native/kit/kit.h"
#include "tests/test.h"

static uint8_t records[PORT_MORE][CELL_COUNT];
static bool is_blank[PORT_MORE];
static unsigned loads, stores, failing;   /* a store that fails, counted from 1; 0: none */

int port_load_more(unsigned which, uint8_t bytes[CELL_COUNT])
{
    loads++;
    memcpy(bytes, records[which], CELL_COUNT);
    return is_blank[which] ? 0 : 1;
}

int port_store_more(unsigned which, const uint8_t bytes[CELL_COUNT])
{
    if (++stores == failing)
        return HAL_E_STORE;
    memcpy(records[which], bytes, CELL_COUNT);
    is_blank[which] = false;
    return 0;
}

static struct body_parameters parameters;

void setUp(void)
{
    memset(records, 255, sizeof records);
    is_blank[0] = is_blank[1] = true;
    loads = stores = failing = 0;
    parameters = (struct body_parameters){.unstored = false};
    calibration_load(&parameters.values);
}

static enum result asked(enum opcode opcode, uint8_t which, uint32_t value, bool running)
{
    struct output out = {.has_answer = true, .answer = RESULT_UNKNOWN_PARAMETER};

    parameters_serve(&parameters, &(struct command){opcode, which, value}, running);
    parameters_answer(&parameters, &out);
    parameters.value = out.answer_value;
    return out.answer;
}

static uint32_t got(uint8_t which)
{
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_GET, which, 0, true));
    return parameters.value;
}

TEST(set_is_refused_while_measuring)
{
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_MEASURE, MEASURE_MOTORS, false));
    TEST_ASSERT_EQUAL_INT(RESULT_OWNED, asked(OPCODE_SET, BODY_LAG_MS, 61, false));
    TEST_ASSERT_EQUAL_UINT(0, stores);
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_MEASURE, MEASURE_NOTHING, false));
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_LAG_MS, 61, false));
}

TEST(uncalibrated_body_has_nominal_values)
{
    struct proximity proximity;
    struct wheel wheels[PINS_SIDES] = {{.known = false}};

    parameters_apply(&parameters, &proximity, wheels);
    for (unsigned i = 0; i < FEEL_COUNT; i++)
        TEST_ASSERT_EQUAL_UINT16(KIT_LIGHT_NEAR, proximity.near[i]);
    for (unsigned side = 0; side < PINS_SIDES; side++) {
        TEST_ASSERT_EQUAL_INT16(0, wheels[side].dead_more);
        TEST_ASSERT_EQUAL_INT16(0, wheels[side].forward_more);
        TEST_ASSERT_EQUAL_INT16(0, wheels[side].lag_more_ms);
    }
    TEST_ASSERT_EQUAL_UINT8(160, parameters_value(&parameters, BODY_TRACK_MM));
}

TEST(parameters_apply_to_sensors_and_wheels)
{
    struct proximity proximity;
    struct wheel wheels[PINS_SIDES] = {{.known = false}};

    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_NEAR_FRONT, 100, false));
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_DEAD_RIGHT, 125, false));
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_FORWARD_RIGHT, 107, false));
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_LAG_MS, 50, false));
    parameters_apply(&parameters, &proximity, wheels);
    TEST_ASSERT_EQUAL_UINT16(1600, proximity.near[2]);
    TEST_ASSERT_EQUAL_UINT16(KIT_LIGHT_NEAR, proximity.near[1]);
    TEST_ASSERT_EQUAL_INT16(8192 - WHEEL_DEAD, wheels[1].dead_more);
    TEST_ASSERT_EQUAL_INT16(0, wheels[0].dead_more);
    TEST_ASSERT_EQUAL_INT16(10, wheels[1].forward_more);
    TEST_ASSERT_EQUAL_INT16(0, wheels[0].forward_more);
    TEST_ASSERT_EQUAL_INT16(-10, wheels[0].lag_more_ms);
    TEST_ASSERT_EQUAL_INT16(-10, wheels[1].lag_more_ms);
}

TEST(dead_band_is_rounded_to_nearest)
{
    struct proximity proximity;
    struct wheel wheels[PINS_SIDES] = {{.known = false}};

    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_DEAD_LEFT, 85, false));
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_DEAD_RIGHT, 111, false));
    parameters_apply(&parameters, &proximity, wheels);
    TEST_ASSERT_EQUAL_INT16(5571 - WHEEL_DEAD, wheels[0].dead_more);   /* 5570.56 */
    TEST_ASSERT_EQUAL_INT16(7274 - WHEEL_DEAD, wheels[1].dead_more);   /* 7274.496 */
}

TEST(records_are_read_once_and_padded_with_zeros)
{
    TEST_ASSERT_EQUAL_UINT(PORT_MORE, loads);
    TEST_ASSERT_EQUAL_INT(0, calibration_store(&parameters.values));
    TEST_ASSERT_EQUAL_HEX8(0, records[0][6] | records[0][7] | records[1][5] | records[1][6] | records[1][7]);
}

TEST(set_values_survive_a_reset_unless_out_of_range)
{
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_NEAR_RIGHT, 76, false));
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_TRACK_MM, 163, false));
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_LAG_MS, 200, false));
    memset(&parameters.values, 0, sizeof parameters.values);
    calibration_load(&parameters.values);
    TEST_ASSERT_EQUAL_UINT32(76, got(BODY_NEAR_RIGHT));
    TEST_ASSERT_EQUAL_UINT32(163, got(BODY_TRACK_MM));
    TEST_ASSERT_EQUAL_UINT32(200, got(BODY_LAG_MS));
    TEST_ASSERT_EQUAL_UINT32(97, got(BODY_FORWARD_LEFT));
    records[1][4] = 201;
    records[0][5] = 89;
    calibration_load(&parameters.values);
    TEST_ASSERT_EQUAL_UINT32(160, got(BODY_TRACK_MM));
    TEST_ASSERT_EQUAL_UINT32(60, got(BODY_LAG_MS));
}

TEST(out_of_range_values_are_refused_and_not_stored)
{
    TEST_ASSERT_EQUAL_INT(RESULT_OUT_OF_RANGE, asked(OPCODE_SET, BODY_TRACK_MM, 89, false));
    TEST_ASSERT_EQUAL_INT(RESULT_OUT_OF_RANGE, asked(OPCODE_SET, BODY_TRACK_MM, 251, false));
    TEST_ASSERT_EQUAL_INT(RESULT_OUT_OF_RANGE, asked(OPCODE_SET, BODY_MEASURE, MEASURE_ENDS, false));
    TEST_ASSERT_EQUAL_INT(RESULT_OUT_OF_RANGE, asked(OPCODE_SET, BODY_REFUSED, 0, false));
    TEST_ASSERT_EQUAL_UINT(0, stores);
    TEST_ASSERT_EQUAL_UINT32(160, got(BODY_TRACK_MM));
}

TEST(running_robot_refuses_set)
{
    TEST_ASSERT_EQUAL_INT(RESULT_OWNED, asked(OPCODE_SET, BODY_TRACK_MM, 163, true));
    TEST_ASSERT_EQUAL_INT(RESULT_OWNED, asked(OPCODE_SET, BODY_MEASURE, MEASURE_MOTORS, true));
    TEST_ASSERT_EQUAL_UINT(0, stores);
    TEST_ASSERT_EQUAL_UINT32(0, got(BODY_MEASURE));
}

TEST(unstored_values_are_not_used)
{
    failing = 2;
    TEST_ASSERT_EQUAL_INT(RESULT_UNSTORED, asked(OPCODE_SET, BODY_LAG_MS, 50, false));
    TEST_ASSERT_EQUAL_UINT32(60, got(BODY_LAG_MS));
    failing = 3;
    TEST_ASSERT_EQUAL_INT(RESULT_UNSTORED, asked(OPCODE_SET, BODY_TRACK_MM, 163, false));
    TEST_ASSERT_EQUAL_UINT(3, stores);
    TEST_ASSERT_EQUAL_UINT32(160, got(BODY_TRACK_MM));
}

TEST(measure_parameter_starts_a_measurement_and_reads_as_it)
{
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_MEASURE, MEASURE_TRACK, false));
    TEST_ASSERT_EQUAL_UINT32(0, parameters.value);
    TEST_ASSERT_EQUAL_UINT32(MEASURE_TRACK, got(BODY_MEASURE));
    parameters.calibration.refused = BODY_DEAD_LEFT;
    parameters.calibration.found = -3;
    TEST_ASSERT_EQUAL_HEX32(0xFFFFFD00u | BODY_DEAD_LEFT, got(BODY_REFUSED));
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_SET, BODY_MEASURE, MEASURE_NOTHING, false));
    TEST_ASSERT_EQUAL_UINT32(0, got(BODY_REFUSED));
}

TEST(measured_values_are_stored_once_and_failure_is_reported)
{
    parameters_store(&parameters);
    TEST_ASSERT_EQUAL_UINT(0, stores);
    parameters.unstored = true;
    parameters_store(&parameters);
    parameters_store(&parameters);
    TEST_ASSERT_EQUAL_UINT(2, stores);
    TEST_ASSERT_EQUAL_UINT32(0, got(BODY_REFUSED));
    parameters.unstored = true;
    failing = 3;
    parameters_store(&parameters);
    TEST_ASSERT_EQUAL_UINT32(BODY_REFUSED, got(BODY_REFUSED));
}

TEST(body_passes_other_commands_to_the_robot)
{
    struct output none = {.answer = RESULT_UNKNOWN_PARAMETER};

    TEST_ASSERT_EQUAL_INT(RESULT_UNKNOWN_PARAMETER, asked(OPCODE_GET, BODY_PARAMETER_END, 0, false));
    TEST_ASSERT_EQUAL_INT(RESULT_UNKNOWN_PARAMETER, asked(OPCODE_GET, BODY_PARAMETER_END + 1, 0, false));
    TEST_ASSERT_EQUAL_INT(RESULT_UNKNOWN_PARAMETER, asked(OPCODE_SET, BODY_MEASURE - 1, 1, false));
    TEST_ASSERT_EQUAL_INT(RESULT_UNKNOWN_PARAMETER, asked(OPCODE_FREEZE, BODY_TRACK_MM, 1, false));
    TEST_ASSERT_EQUAL_INT(RESULT_DONE, asked(OPCODE_GET, BODY_PARAMETER_END - 1, 0, false));
    parameters_answer(&parameters, &none);
    TEST_ASSERT_EQUAL_INT(RESULT_UNKNOWN_PARAMETER, none.answer);
}
