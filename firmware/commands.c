#include "firmware/robot.h"

static enum result stop(struct robot *robot)
{
    robot->running = false;
    motion_lift(&robot->motion);
    return RESULT_DONE;
}

static enum result start(struct robot *robot, const struct command *command, uint32_t *value)
{
    if (!brain_start(&robot->brain, command->which, command->value))
        return RESULT_UNKNOWN_PROFILE;
    config_reset(&robot->config);
    robot->brain.frozen = false;
    robot->action = 0;
    robot->denials = 0;
    robot->turn_denied = false;
    if (!robot->running)   /* observers of a running robot need not wait for its report */
        robot->part_ms = 0;
    motion_start(&robot->motion);
    perception_start(&robot->perception);
    robot->caution = (struct caution){.doing = 0};
    sharing_start(&robot->sharing);
    robot->running = true;
    *value = robot->brain.wants_ranges ? ANSWER_WANTS_RANGES : 0;
    return RESULT_DONE;
}

static enum result resume(struct robot *robot)
{
    robot->running = true;
    return RESULT_DONE;
}

static enum result set(struct robot *robot, const struct command *command)
{
    if (!config_fits(command->which, command->value))
        return RESULT_OUT_OF_RANGE;
    robot->config.value[command->which] = (uint8_t)command->value;
    return RESULT_DONE;
}

static enum result use_parameter(struct robot *robot, const struct command *command, uint32_t *value)
{
    if (command->which >= PARAMETER_COUNT)
        return RESULT_UNKNOWN_PARAMETER;
    if (command->opcode == OPCODE_SET)
        return set(robot, command);
    *value = robot->config.value[command->which];
    return RESULT_DONE;
}

static enum result write_memory(struct robot *robot, const struct command *command)
{
    if (!brain_write(&robot->brain, command->which, command->value))
        return RESULT_OUT_OF_RANGE;
    return RESULT_DONE;
}

static enum result erase_memory(struct robot *robot)
{
    memory_erase(&robot->brain.memory);
    robot->brain.changed = true;
    return RESULT_DONE;
}

static enum result freeze(struct robot *robot, const struct command *command)
{
    robot->brain.frozen = command->which != 0;
    return RESULT_DONE;
}

enum result robot_execute(struct robot *robot, const struct command *command, uint32_t *value)
{
    switch (command->opcode) {
    case OPCODE_STOP:
        return stop(robot);
    case OPCODE_START:
        return start(robot, command, value);
    case OPCODE_RESUME:
        return resume(robot);
    case OPCODE_WRITE:
        return write_memory(robot, command);
    case OPCODE_ERASE:
        return erase_memory(robot);
    case OPCODE_FREEZE:
        return freeze(robot, command);
    case OPCODE_SET:
    case OPCODE_GET:
        return use_parameter(robot, command, value);
    case OPCODE_REPORT:
        return RESULT_DONE;
    default:
        return RESULT_UNKNOWN_COMMAND;
    }
}
