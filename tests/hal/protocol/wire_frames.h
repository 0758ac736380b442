/* wire_frames.h: frames as a simulator sends them. */
#ifndef OCTET_WIRE_FRAMES_H
#define OCTET_WIRE_FRAMES_H

#include "tests/test.h"
#include "hal/protocol/e2e.h"
#include "octet.h"

static inline struct frame protected_frame(struct frame frame)
{
    e2e_protect(&frame);
    return frame;
}

/* The senses of a tick, counted from 0 without end. */
static inline struct frame senses_frame(unsigned node, unsigned ticks)
{
    const struct octet_senses_t senses = {
        .counter = (uint8_t)(ticks % E2E_COUNTERS),
        .tick = (uint8_t)ticks,
        .feel = 21,
        .bump = 1,
        .look = 1,
        .beacon = 8191,
        .odometer_left = 4095,
        .odometer_right = 1,
    };
    struct frame frame = {.id = OCTET_SENSES_FRAME_ID + node - 1u, .len = OCTET_SENSES_LENGTH};

    TEST_ASSERT_EQUAL(OCTET_SENSES_LENGTH, octet_senses_pack(frame.data, &senses, sizeof frame.data));
    return protected_frame(frame);
}

/* 11, 22, 33, 44 and 55 mm, for node 1. */
static inline struct frame ranges_frame(unsigned ticks)
{
    const struct octet_ranges_t ranges = {
        .counter = (uint8_t)(ticks % E2E_COUNTERS),
        .tick = (uint8_t)ticks,
        .range_right = 11,
        .range_front_right = 22,
        .range_front = 33,
        .range_front_left = 44,
        .range_left = 55,
    };
    struct frame frame = {.id = OCTET_RANGES_FRAME_ID, .len = OCTET_RANGES_LENGTH};

    TEST_ASSERT_EQUAL(OCTET_RANGES_LENGTH, octet_ranges_pack(frame.data, &ranges, sizeof frame.data));
    return protected_frame(frame);
}

/* Half of the memory of a robot, whose four cells are first, 1, 2 and 1. */
static inline struct frame memory_frame(unsigned node, unsigned half, uint8_t first)
{
    const struct octet_memory_t memory = {
        .half = (uint8_t)half,
        .cell_0 = first, .cell_1 = 1, .cell_2 = 2, .cell_3 = 1,
        .cell_4 = first, .cell_5 = 1, .cell_6 = 2, .cell_7 = 1,
    };
    struct frame frame = {.id = OCTET_MEMORY_FRAME_ID + node - 1u, .len = OCTET_MEMORY_LENGTH};

    TEST_ASSERT_EQUAL(OCTET_MEMORY_LENGTH, octet_memory_pack(frame.data, &memory, sizeof frame.data));
    return protected_frame(frame);
}

/* For node 1. */
static inline struct frame command_frame(struct octet_command_t command)
{
    struct frame frame = {.id = OCTET_COMMAND_FRAME_ID, .len = OCTET_COMMAND_LENGTH};

    TEST_ASSERT_EQUAL(OCTET_COMMAND_LENGTH, octet_command_pack(frame.data, &command, sizeof frame.data));
    return protected_frame(frame);
}

#endif
