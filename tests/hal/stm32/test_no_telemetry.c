/* A robot without a bus. */
#include "hal/can_body/port.h"
#include "hal/pins_body/telemetry.h"
#include "hal/port/cortex_m/uart.h"
#include "tests/test.h"

void setUp(void)
{
}

TEST(telemetry_without_a_bus_does_nothing)
{
    const struct port port = {.node = 1};
    const struct senses senses = {.tick = 1};
    const struct output out = {.has_drive = true};
    struct input in;

    TEST_ASSERT_EQUAL_INT(0, telemetry_open(&port));
    telemetry_senses(&senses);
    telemetry_output(&out, true);
    telemetry_stored(0);
    line_pump();
    TEST_ASSERT_EQUAL_INT(INPUT_SILENCE, telemetry_receive(&in));
}
