#include "hal/library/exchange.h"
#include "tests/test.h"
#include "tests/hal/protocol/wire_frames.h"

#include <string.h>

static const uint8_t STORED[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 1};

static struct octet *octet;
static const struct frame *out;

void setUp(void)
{
    octet = octet_open(1, STORED);
    TEST_ASSERT_NOT_NULL(octet);
    out = octet_answers(octet);
}

void tearDown(void)
{
    octet_close(octet);
}

static size_t exchange(struct frame in)
{
    return octet_exchange(octet, &in);
}

static struct frame command_of(uint8_t opcode)
{
    return command_frame((struct octet_command_t){.opcode = opcode, .counter = 1, .owner = 1, .lockstep = 1});
}

TEST(senses_are_answered_with_a_drive)
{
    TEST_ASSERT_EQUAL_size_t(1, exchange(senses_frame(1, 7)));
    TEST_ASSERT_EQUAL_UINT32(OCTET_DRIVE_FRAME_ID, out[0].id);
}

TEST(command_answer_precedes_its_report)
{
    TEST_ASSERT_EQUAL_size_t(9, exchange(command_of(OPCODE_STOP)));
    TEST_ASSERT_EQUAL_UINT32(OCTET_ANSWER_FRAME_ID, out[0].id);
    TEST_ASSERT_EQUAL_UINT32(OCTET_HEARTBEAT_FRAME_ID, out[1].id);
}

TEST(answers_stay_at_the_same_address)
{
    exchange(senses_frame(1, 1));
    TEST_ASSERT_EQUAL_PTR(out, octet_answers(octet));
    exchange(command_of(OPCODE_STOP));
    TEST_ASSERT_EQUAL_PTR(out, octet_answers(octet));
}

/* Clear of obstacles, as far as it can feel. */
static struct frame clear_way(unsigned ticks)
{
    struct frame frame = senses_frame(1, ticks);

    frame.data[2] &= 0x0F;
    frame.data[3] = 0;
    return protected_frame(frame);
}

TEST(started_robot_drives)
{
    struct octet_drive_t drive;

    exchange(command_of(OPCODE_START));
    exchange(clear_way(0));
    octet_drive_unpack(&drive, out[0].data, out[0].len);
    TEST_ASSERT_GREATER_THAN_INT16(0, drive.left);
}

TEST(lockstep_repeated_senses_get_the_same_answer)
{
    struct frame before;

    exchange(command_of(OPCODE_START));
    TEST_ASSERT_EQUAL_size_t(1, exchange(senses_frame(1, 0)));
    before = out[0];
    TEST_ASSERT_EQUAL_size_t(1, exchange(senses_frame(1, 0)));
    TEST_ASSERT_EQUAL_MEMORY(&before, &out[0], sizeof before);
    TEST_ASSERT_EQUAL_UINT16(20, octet->robot.part_ms);   /* one tick */
}

TEST(stale_senses_do_not_reach_the_robot)
{
    exchange(senses_frame(1, 0));
    TEST_ASSERT_EQUAL_size_t(0, exchange(senses_frame(1, 0)));
    TEST_ASSERT_EQUAL_UINT16(20, octet->robot.part_ms);   /* one tick */
}

TEST(robot_begins_stopped)
{
    TEST_ASSERT_FALSE(octet->robot.running);
}

TEST(robot_begins_with_stored_memory)
{
    TEST_ASSERT_EQUAL_UINT8_ARRAY(STORED, octet->robot.brain.memory.cell, CELL_COUNT);
}

TEST(library_ignores_stored_bytes_that_are_no_memory)
{
    static const uint8_t none[CELL_COUNT] = {0, 3}, nothing[CELL_COUNT] = {0};

    octet_close(octet);
    octet = octet_open(1, none);
    TEST_ASSERT_EQUAL_UINT8_ARRAY(nothing, octet->robot.brain.memory.cell, CELL_COUNT);
}

TEST(robots_in_one_process_share_no_state)
{
    struct octet *other = octet_open(2, STORED);

    exchange(command_of(OPCODE_START));
    TEST_ASSERT_FALSE(other->robot.running);
    octet_close(other);
}

TEST(octet_close_accepts_null)
{
    octet_close(NULL);
}

/* The data of the last frame with an identifier. */
static const uint8_t *data_of(uint32_t id, size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (out[i].id == id)
            return out[i].data;
    TEST_FAIL_MESSAGE("it was not answered");
    return NULL;
}

TEST(health_reports_an_exact_clock)
{
    struct octet_health_t health;
    size_t count = exchange(command_of(OPCODE_STOP));

    TEST_ASSERT_EQUAL(0, octet_health_unpack(&health, data_of(OCTET_HEALTH_FRAME_ID, count), OCTET_HEALTH_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(1, health.clock);
}

/* As behind a bus, where it says so when it comes up. */
TEST(first_boot_message_has_counter_1)
{
    struct octet_boot_t boot;
    size_t count = exchange(command_of(OPCODE_STOP));

    TEST_ASSERT_EQUAL(0, octet_boot_unpack(&boot, data_of(OCTET_BOOT_FRAME_ID, count), OCTET_BOOT_LENGTH));
    TEST_ASSERT_EQUAL_UINT8(1, boot.counter);
}

TEST(restored_copy_continues_identically)
{
    uint8_t copy[sizeof *octet];
    struct frame before;

    TEST_ASSERT_EQUAL_size_t(sizeof copy, octet_size(octet));
    exchange(command_of(OPCODE_START));
    memcpy(copy, octet, sizeof copy);
    exchange(senses_frame(1, 0));
    before = out[0];
    exchange(senses_frame(1, 1));
    memcpy(octet, copy, sizeof copy);
    TEST_ASSERT_EQUAL_size_t(1, exchange(senses_frame(1, 0)));
    TEST_ASSERT_EQUAL_MEMORY(&before, &out[0], sizeof before);
}

TEST(any_senses_are_fresh_after_an_outage)
{
    struct frame start = command_frame((struct octet_command_t){.opcode = OPCODE_START, .counter = 1, .owner = 1});

    exchange(start);
    TEST_ASSERT_EQUAL_size_t(1, exchange(senses_frame(1, 0)));
    TEST_ASSERT_EQUAL_size_t(0, exchange(senses_frame(1, 15)));
    octet_outage(octet);
    TEST_ASSERT_EQUAL_size_t(2, exchange(senses_frame(1, 15)));
    TEST_ASSERT_EQUAL_UINT32(OCTET_EMERGENCY_FRAME_ID, out[0].id);
}
