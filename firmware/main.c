/* The robot, for ever: sense, step, drive, report, save. */
#include "firmware/robot.h"
#include "hal/hal.h"

static void wake(struct robot *robot, struct hal *hal)
{
    uint8_t cells[CELL_COUNT];

    robot_init(robot, hal_entropy(hal));
    /* Where no memory can be loaded, the robot starts with an empty one. */
    if (hal_load(hal, cells) == 1)
        (void)brain_adopt(&robot->brain, cells);
}

static int run_once(struct robot *robot, struct hal *hal)
{
    struct input in;
    struct output out;
    int result = hal_receive(hal, &in);

    if (result < 0)
        return result;
    robot_respond(robot, (enum input_kind)result, &in, &out);
    result = hal_send(hal, &out);
    /* After the drive has gone, since storing may take long. The body counts what it could not store. */
    if (out.store)
        (void)hal_store(hal, out.memory, !robot->running);
    return result;
}

int main(int argc, char *argv[])
{
    struct robot robot;
    struct hal *hal;
    int result = hal_open(&hal, argc, argv);

    if (result < 0)
        return -result;
    wake(&robot, hal);
    do
        result = run_once(&robot, hal);
    while (result >= 0);
    return result == HAL_E_CLOSED ? 0 : -result;
}
