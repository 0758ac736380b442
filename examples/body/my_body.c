/* A whole simulated body: its wheels do what they are told, and now and then there is something in front of it. */
#include "hal/hal.h"

#include <stdio.h>
#include <string.h>

enum { TICKS = 500, EVERY = 250, BLOCKED = 100, TICKS_PER_S = 50, PER_MM = 10 };

struct hal {
    bool started;
    unsigned tick, left, right;   /* the wheels have rolled so far, in 0.1 mm */
    unsigned trial, remembered;   /* ticks of either reason */
    uint8_t memory[CELL_COUNT];
};

int hal_open(struct hal **hal, int argc, char *const argv[])
{
    static struct hal body;

    (void)argc;
    (void)argv;
    *hal = &body;
    return 0;
}

int hal_receive(struct hal *hal, struct input *in)
{
    if (!hal->started) {
        hal->started = true;
        in->command = (struct command){.opcode = OPCODE_START, .which = PROFILE_ARTICLE, .value = hal_entropy(hal)};
        return INPUT_COMMAND;
    }
    if (hal->tick == TICKS) {
        printf("%u ticks of trials, %u of remembered turns\n", hal->trial, hal->remembered);
        return HAL_E_CLOSED;
    }
    in->senses = (struct senses){
        .tick = (uint8_t)hal->tick,
        .feel = hal->tick % EVERY < BLOCKED ? FEEL_FRONT : 0,
        .odometer_left = (uint16_t)(hal->left % ODOMETER_SPAN),
        .odometer_right = (uint16_t)(hal->right % ODOMETER_SPAN),
    };
    memset(in->senses.range_mm, RANGE_NONE, sizeof in->senses.range_mm);
    hal->tick++;
    return INPUT_SENSES;
}

int hal_send(struct hal *hal, const struct output *out)
{
    if (!out->has_drive)
        return 0;
    hal->left += (unsigned)(out->drive.left_mm_s * PER_MM / TICKS_PER_S);
    hal->right += (unsigned)(out->drive.right_mm_s * PER_MM / TICKS_PER_S);
    hal->trial += out->drive.reason == REASON_TRIAL;
    hal->remembered += out->drive.reason == REASON_REMEMBERED;
    return 0;
}

int hal_load(struct hal *hal, uint8_t memory[CELL_COUNT])
{
    memcpy(memory, hal->memory, CELL_COUNT);
    return 1;
}

int hal_store(struct hal *hal, const uint8_t memory[CELL_COUNT], bool at_rest)
{
    (void)at_rest;
    memcpy(hal->memory, memory, CELL_COUNT);
    return 0;
}

uint32_t hal_entropy(struct hal *hal)
{
    (void)hal;
    return 7;   /* on a robot: the noise of an open analogue input, for example */
}
