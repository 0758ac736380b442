#include "firmware/robot.h"

enum {
    SECOND_MS = 1000,      /* a report is due once a second of robot time, */
    REPORT_SILENCES = 10,  /* or, without ticks, with every tenth silence */
    FRONT = 4,             /* of feel */
    DENIALS_MAX = 2        /* denials tolerated: the next one stops the robot */
};

void robot_init(struct robot *robot, uint32_t seed)
{
    *robot = (struct robot){.running = false};
    config_reset(&robot->config);
    (void)brain_start(&robot->brain, PROFILE_ARTICLE, seed);
    motion_start(&robot->motion);
}

static void begin_next_action(struct robot *robot, struct senses *senses)
{
    struct action action = caution_next(&robot->caution, &robot->brain, &robot->config, senses);

    motion_begin(&robot->motion, &robot->config, &action);
    robot->reason = (uint8_t)action.reason;
    robot->action = (uint8_t)((robot->action + 1u) % ACTION_SPAN);
}

/* Nothing can be learned with wheels that do not obey, and driving on blindly is not safe. */
static void note_denial(struct robot *robot)
{
    if (robot->denials < DENIALS_MAX) {
        robot->denials++;
        return;
    }
    robot->running = false;
    motion_start(&robot->motion);   /* resumed, it begins with another action */
}

/* A step does not show how well the wheels turn. */
static void judge(struct robot *robot, bool denied)
{
    bool tells = motion_tells(&robot->motion);

    if (denied) {
        robot->turn_denied = tells;
        note_denial(robot);
        return;
    }
    if (robot->denials > 0 && (tells || !robot->turn_denied))
        robot->denials--;
}

static bool has_ended(struct robot *robot, const struct senses *senses)
{
    bool stops = caution_stops(&robot->caution, senses, robot->motion.kind == MOTION_STEP);

    return (stops || motion_ended(&robot->motion, &robot->config, senses))
        && (motion_gave_up(&robot->motion) || !motion_rest(&robot->motion, &robot->config));
}

/* True: the wheels did not do what they were told. */
static bool go_on(struct robot *robot, struct senses *senses)
{
    uint8_t feel = perception_filter(&robot->perception, &robot->config, senses->feel);
    bool denied;

    senses->feel = perception_believed(&robot->perception, &robot->config, feel);
    motion_track(&robot->motion, senses);
    if (!has_ended(robot, senses))
        return false;
    denied = motion_is_denied(&robot->motion, &robot->config);
    judge(robot, denied);
    if (robot->denials > 0)
        brain_doubt(&robot->brain, senses);
    perception_decide(&robot->perception, &robot->config, feel);
    senses->feel = perception_believed(&robot->perception, &robot->config, feel);
    caution_see(&robot->caution, senses->feel, (feel & ~senses->feel & FRONT) != 0);
    if (robot->running)
        begin_next_action(robot, senses);
    return denied;
}

/* A drive at rest. */
static void drive_init(struct drive *drive, const struct robot *robot, enum reason reason)
{
    *drive = (struct drive){
        .tick = robot->tick,
        .reason = reason,
        .repeat_count = robot->brain.repeat_count,
        .action = robot->action,
        .eat = reason == REASON_EAT,
    };
}

/* Food without a distance, or a distance without food, is not believed. Odometers jump if the robot was carried or
 * its body reset. */
static bool make_credible(struct robot *robot, struct senses *senses)
{
    unsigned ticks = robot->silences > 0 ? UINT8_MAX : (uint8_t)(senses->tick - robot->tick);
    bool food = senses->look == (senses->beacon_mm != 0);
    bool wheels = motion_is_credible(&robot->motion, &robot->config, senses, ticks);

    if (!food) {
        senses->look = false;
        senses->beacon_mm = 0;
    }
    if (!wheels)
        motion_lift(&robot->motion);
    return food && wheels;
}

static void step(struct robot *robot, const struct senses *sensed, struct output *out)
{
    struct senses senses = *sensed;

    if (robot->running) {
        out->contradiction = !make_credible(robot, &senses);
        out->denied = go_on(robot, &senses);
    }
    robot->tick = senses.tick;
    drive_init(&out->drive, robot, robot->running ? (enum reason)robot->reason : REASON_STOP);
    if (robot->running)
        motion_drive(&robot->motion, &robot->config, &out->drive);
}

void robot_step(struct robot *robot, const struct senses *senses, struct drive *drive)
{
    struct output out;

    step(robot, senses, &out);
    *drive = out.drive;
}

/* Counts a tick of robot time. True: it completes a second. */
static bool pass_time(struct robot *robot)
{
    unsigned part_ms = robot->part_ms + (unsigned)robot->config.value[TICK_MS];
    bool full = part_ms >= SECOND_MS;

    robot->part_ms = (uint16_t)(full ? part_ms - SECOND_MS : part_ms);
    robot->uptime_s = (uint16_t)(robot->uptime_s + full);
    return full;
}

/* Fills in the report whether it is due or not: sending it takes many ticks. */
static void describe(const struct robot *robot, struct output *out)
{
    for (unsigned p = 0; p < CELL_COUNT; p++)
        out->memory[p] = robot->brain.memory.cell[p];
    out->report.running = robot->running;
    out->report.frozen = robot->brain.frozen;
    out->report.profile = robot->brain.profile;
    out->report.uptime_s = robot->uptime_s;
}

/* Ends a second. What was learned from others is reported a tick later, so that it makes no difference which robot
 * was asked first in this tick. */
static bool take_votes(struct robot *robot)
{
    bool takes = robot->running && robot->sharing.whole && robot->config.value[SHARE] != 0;
    bool took = takes && brain_take_votes(&robot->brain, robot->sharing.votes);

    sharing_begin_second(&robot->sharing, &robot->config);
    return took;
}

static void respond_to_senses(struct robot *robot, const struct senses *senses, struct output *out)
{
    step(robot, senses, out);
    robot->silences = 0;
    out->has_drive = true;
    out->has_report = pass_time(robot);
    out->store = out->has_report && take_votes(robot);
}

static void respond_to_command(struct robot *robot, const struct command *command, struct output *out)
{
    out->answer = robot_execute(robot, command, &out->answer_value);
    out->has_answer = true;
    out->has_report = out->whole_report = command->opcode == OPCODE_STOP || command->opcode == OPCODE_REPORT;
    if (command->opcode != OPCODE_STOP)
        return;
    drive_init(&out->drive, robot, REASON_STOP);
    out->has_drive = true;
}

/* Leaves brain and motion untouched, so the next senses resume where they stopped. */
static void respond_to_silence(struct robot *robot, struct output *out)
{
    drive_init(&out->drive, robot, REASON_SILENCE);
    out->has_drive = out->silent = true;
    robot->silences = (uint8_t)(robot->silences % REPORT_SILENCES + 1u);   /* never 0 again before senses come */
    out->has_report = robot->silences == REPORT_SILENCES;
}

void robot_respond(struct robot *robot, enum input_kind kind, const struct input *in, struct output *out)
{
    *out = (struct output){.has_drive = false};
    if (kind == INPUT_SENSES)
        respond_to_senses(robot, &in->senses, out);
    else if (kind == INPUT_COMMAND)
        respond_to_command(robot, &in->command, out);
    else if (kind == INPUT_PEER)
        sharing_hear(&robot->sharing, &in->peer);
    else
        respond_to_silence(robot, out);
    out->store = out->store || (robot->brain.changed && robot->brain.learns);
    out->has_memory = robot->brain.changed;
    robot->brain.changed = false;
    describe(robot, out);
}
