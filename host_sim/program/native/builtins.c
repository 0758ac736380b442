/* The commands of a program to its robot. A pixel is 5 mm, as in the article. */
#include "host_sim/program/native/machine.h"

#include "firmware/motion/wheels.h"
#include "firmware/pattern.h"
#include "host_sim/world/native/trig.h"

enum {
    PIXEL_MM = 5,
    STEP_MAX_MM = 150,      /* per action: odometers wrap */
    WAY_MAX = 800,          /* per command, pixels */
    DEGREES_MAX = 720,
    DELAY_MAX_MS = 60000,
    RESTS_MAX = 250,        /* per action, ticks */
    CHOICES_MAX = 1000000,
    ROUND = 360,
    SENSOR_AHEAD = 2,       /* of the five sensors, right to left, */
    SENSOR_DEG = 45,        /* which are this far apart */
    ANGLE_MAX = 90
};

static const double RAD_PER_DEG = 3.14159265358979323846 / 180;

/* A random number, drawn as the firmware draws; for more choices than that allows, 32 bits modulo their number. */
static double draw(struct machine *machine, double choices)
{
    if (!(choices >= 1 && choices <= CHOICES_MAX)) {
        machine_fail(machine, EXPECTED_CHOICES);
        return 0;
    }
    if (choices <= UINT8_MAX)
        return random_below(&machine->brain->random, (uint8_t)choices);
    return random_next(&machine->brain->random) % (uint32_t)choices;
}

static double look(struct machine *machine, double angle)
{
    if (angle != 0)
        machine_fail(machine, EXPECTED_AHEAD);
    return machine->senses->look ? COLOUR_GREEN : 0;
}

static double beacon(const struct machine *machine, double colour)
{
    unsigned mm = machine->senses->beacon_mm;

    if (colour != COLOUR_GREEN || mm == 0)
        return 0;
    return mm < PIXEL_MM ? 1 : mm / PIXEL_MM;
}

/* By the sensor in this direction, right of ahead; the screen's width if it sees nothing. */
static double range(struct machine *machine, double angle)
{
    int32_t places = machine_whole(angle < 0 ? angle / SENSOR_DEG - 0.5 : angle / SENSOR_DEG + 0.5);
    unsigned mm;

    if (!(angle >= -ANGLE_MAX && angle <= ANGLE_MAX)) {
        machine_fail(machine, EXPECTED_ANGLE);
        return 0;
    }
    mm = machine->senses->range_mm[SENSOR_AHEAD - places];
    return mm == RANGE_NONE ? WAY_MAX : (double)mm / PIXEL_MM;
}

static double sensed(const struct machine *machine, enum function function)
{
    const struct program *program = machine->program;

    switch (function) {
    case DO_FEEL:
        return machine->senses->feel;
    case DO_BUMPER:
        return machine->senses->bump;
    case DO_GPS_X:
        return program->x_mm / PIXEL_MM;
    case DO_GPS_Y:
        return program->y_mm / PIXEL_MM;
    default:
        return program->heading_deg;
    }
}

void machine_function(struct machine *machine, enum function function, unsigned count)
{
    double argument = count > 0 ? machine_pop(machine) : 0, value;

    machine->program->felt = machine->program->felt || function == DO_FEEL;
    if (function == DO_RANDOM)
        value = draw(machine, argument);
    else if (function == DO_LOOK)
        value = look(machine, argument);
    else if (function == DO_BEACON)
        value = beacon(machine, argument);
    else if (function == DO_RANGE)
        value = range(machine, argument);
    else if (function == DO_ABS)
        value = argument < 0 ? -argument : argument;
    else if (function == DO_INT)
        value = machine_whole(argument);
    else
        value = sensed(machine, function);
    machine_push(machine, value, -1);
}

/* Rounds to a whole number. One out of range is an error, and becomes 0. */
static int32_t limited(struct machine *machine, double number, double most, enum program_expected expected)
{
    if (number >= -most && number <= most)
        return machine_whole(number < 0 ? number - 0.5 : number + 0.5);
    machine_fail(machine, expected);
    return 0;
}

/* The reason that the firmware would give: a program that keeps Mem learns as the article's does. A turn avoids
 * something only if rFeel was asked before it. */
static enum reason reason_to_turn(const struct machine *machine, int32_t degrees)
{
    uint8_t pattern = pattern_of(machine->senses->feel);
    int32_t trial_deg = machine->config->value[TRIAL_DEG];

    if (!machine->program->learns)
        return REASON_PROGRAM;
    if (degrees > trial_deg || degrees < -trial_deg)
        return REASON_BOREDOM;
    if (pattern == 0 || !machine->program->felt)
        return REASON_LOOK_AROUND;
    return machine->brain->memory.cell[pattern] == SIDE_NOTHING ? REASON_TRIAL : REASON_REMEMBERED;
}

/* Remembered turns since the way was last clear, as the firmware's own behaviours count them. */
static void count_turns(struct brain *brain, const struct action *action)
{
    if (action->forward_mm > 0)
        brain->repeat_count = 0;
    if (action->reason == REASON_REMEMBERED && brain->repeat_count < UINT8_MAX)
        brain->repeat_count++;
}

static void act(struct machine *machine, struct action action)
{
    count_turns(machine->brain, &action);
    machine->action = action;
    machine->acts = true;
    machine->program->felt = false;
}

static void turn(struct machine *machine, double argument)
{
    int32_t degrees = limited(machine, argument, DEGREES_MAX, EXPECTED_DEGREES);

    if (degrees == 0)
        return;
    machine->program->turned_deg = degrees;
    act(machine, (struct action){.reason = reason_to_turn(machine, degrees), .turn_deg = (int16_t)degrees});
}

static void go(struct machine *machine)
{
    int32_t way = machine->program->way_left_mm;
    int32_t now = way > STEP_MAX_MM ? STEP_MAX_MM : way < -STEP_MAX_MM ? -STEP_MAX_MM : way;

    machine->program->way_left_mm = way - now;
    act(machine, (struct action){
        .reason = machine->senses->look ? REASON_TOWARD_FOOD : REASON_WANDER,
        .forward_mm = (int16_t)now,
    });
}

static void rest(struct machine *machine)
{
    int32_t left = machine->program->rest_left;
    int32_t now = left > RESTS_MAX ? RESTS_MAX : left;

    machine->program->rest_left = left - now;
    act(machine, (struct action){.reason = REASON_PROGRAM, .rest_ticks = (uint8_t)(now - 1)});
}

static void forward(struct machine *machine, double argument)
{
    machine->program->way_left_mm =
        limited(machine, argument * PIXEL_MM, WAY_MAX * PIXEL_MM, EXPECTED_WAY);
    if (machine->program->way_left_mm != 0)
        go(machine);
}

static void delay(struct machine *machine, double argument)
{
    int32_t tick_ms = machine->config->value[TICK_MS];
    int32_t ms = argument < 0 ? -1 : limited(machine, argument, DELAY_MAX_MS, EXPECTED_DELAY);

    if (ms < 0)
        machine_fail(machine, EXPECTED_DELAY);
    machine->program->rest_left = ms > 0 ? (ms + tick_ms - 1) / tick_ms : 0;
    if (machine->program->rest_left > 0)
        rest(machine);
}

/* The heading is 0..359 degrees; 0, which is up, by default. */
static void locate(struct machine *machine, unsigned count)
{
    struct program *program = machine->program;
    int32_t heading = count > 2 ? machine_whole(machine_pop(machine)) : 0;

    program->y_mm = machine_pop(machine) * PIXEL_MM;
    program->x_mm = machine_pop(machine) * PIXEL_MM;
    program->heading_deg = (heading % ROUND + ROUND) % ROUND;
}

void machine_command(struct machine *machine, enum deed deed, unsigned count)
{
    double y;

    switch (deed) {
    case DO_FORWARD:
        forward(machine, machine_pop(machine));
        break;
    case DO_TURN:
        turn(machine, machine_pop(machine));
        break;
    case DO_DELAY:
        delay(machine, machine_pop(machine));
        break;
    case DO_LOCATE:
        locate(machine, count);
        break;
    case DO_EAT:
        act(machine, (struct action){.reason = REASON_EAT});
        break;
    default:
        y = machine_pop(machine);
        machine_show_at(machine, machine_pop(machine), y);
        break;
    }
}

bool machine_continue(struct machine *machine)
{
    struct program *program = machine->program;

    if (program->way_left_mm > 0 && pattern_of(machine->senses->feel) != 0)
        program->way_left_mm = 0;   /* do not drive into an obstacle */
    if (program->state != PROGRAM_RUNS || (program->way_left_mm == 0 && program->rest_left == 0))
        return false;
    if (program->way_left_mm != 0)
        go(machine);
    else
        rest(machine);
    return true;
}

void machine_reckon(struct machine *machine)
{
    struct program *program = machine->program;
    const struct senses *senses = machine->senses;
    double way = wheels_counts_between(program->odometer_left, senses->odometer_left)
               + wheels_counts_between(program->odometer_right, senses->odometer_right);
    double mm = way / WHEELS_COUNTS_PER_MM, heading = program->heading_deg * RAD_PER_DEG;

    if (program->reckons && program->turned_deg == 0) {
        program->x_mm += mm * trig_sin(heading);
        program->y_mm -= mm * trig_cos(heading);
    }
    program->heading_deg = ((program->heading_deg + program->turned_deg) % ROUND + ROUND) % ROUND;
    program->turned_deg = 0;
    program->odometer_left = senses->odometer_left;
    program->odometer_right = senses->odometer_right;
    program->reckons = true;
}
