/* No telemetry: a robot with a body on pins, without bus or serial line. */
#include "hal/pins_body/telemetry.h"
#include "hal/port/cortex_m/uart.h"

int telemetry_open(const struct port *port)
{
    (void)port;
    return 0;
}

enum input_kind telemetry_receive(struct input *in)
{
    (void)in;
    return INPUT_SILENCE;
}

void telemetry_senses(const struct senses *senses)
{
    (void)senses;
}

bool telemetry_wants_ranges(void)
{
    return false;
}

void telemetry_stored(int result)
{
    (void)result;
}

void telemetry_output(const struct output *out, bool asked)
{
    (void)out;
    (void)asked;
}

void line_pump(void)
{
}
