/* The body's main loop: sends senses to the brain at the other end of the bus, and follows its drives. */
#include "hal/hal.h"
#include "hal/pins_body/body_node.h"

int main(int argc, char *argv[])
{
    struct hal *hal;
    int result = hal_open(&hal, argc, argv);

    if (result < 0)
        return -result;
    while (result >= 0) {
        struct input in;
        struct output out;

        result = hal_receive(hal, &in);
        if (result == INPUT_COMMAND)
            body_node_order(&in.command);
        body_node_drive(&out);
        if (result >= 0)
            result = hal_send(hal, &out);
    }
    return -result;
}
