#include "hal/protocol/wire.h"
#include "tests/test.h"
#include "wire_frames.h"

#include "reading_rig.h"

TEST(ranges_that_nobody_asked_for_are_foreign)
{
    refuse(ranges_frame(0));
    expect(FAULT_FOREIGN, 1);
}

TEST(ranges_go_with_the_senses_of_their_tick)
{
    static const uint8_t expected[FEEL_COUNT] = {11, 22, 33, 44, 55};

    start(1, ANSWER_WANTS_RANGES);
    refuse(ranges_frame(7));
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(7));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(expected, in.senses.range_mm, FEEL_COUNT);
}

TEST(in_lockstep_senses_wait_for_their_ranges)
{
    start(1, ANSWER_WANTS_RANGES);
    refuse(ranges_frame(6));
    refuse(senses_frame(NODE, 7));
    refuse(ranges_frame(8));
    refuse(senses_frame(NODE, 7));
    expect(FAULT_MISSED, 2);
    refuse(ranges_frame(7));
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(7));
}

TEST(the_first_senses_of_a_run_wait_for_ranges_of_that_run)
{
    start(1, ANSWER_WANTS_RANGES);
    refuse(senses_frame(NODE, 0));
    refuse(ranges_frame(0));
    hear(command_frame((struct octet_command_t){.opcode = OPCODE_START, .counter = 2, .owner = OWNER, .lockstep = 1}));
    respond((struct output){.has_answer = true, .answer_value = ANSWER_WANTS_RANGES});
    refuse(senses_frame(NODE, 0));
    expect(FAULT_MISSED, 2);
}

TEST(damaged_ranges_are_counted_and_not_taken)
{
    struct frame damaged = ranges_frame(7);

    start(1, ANSWER_WANTS_RANGES);
    damaged.data[7] ^= 1;
    refuse(damaged);
    expect(FAULT_DAMAGED, 1);
    refuse(senses_frame(NODE, 7));
    expect(FAULT_MISSED, 1);
}

TEST(on_its_own_clock_senses_do_without_their_ranges)
{
    start(0, ANSWER_WANTS_RANGES);
    refuse(ranges_frame(6));
    TEST_ASSERT_EQUAL(INPUT_SENSES, read_tick(7));
    TEST_ASSERT_EACH_EQUAL_UINT8(RANGE_NONE, in.senses.range_mm, FEEL_COUNT);
}

static struct frame of_a_twin(uint32_t id, uint8_t len)
{
    return protected_frame((struct frame){.id = id, .len = len});
}

TEST(a_twin_stops_the_robot)
{
    const struct frame heard = of_a_twin(OCTET_DRIVE_FRAME_ID, OCTET_DRIVE_LENGTH);

    start(1, 0);
    refuse(heard);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(heard));
    TEST_ASSERT_EQUAL(OPCODE_STOP, in.command.opcode);
    expect(FAULT_TWIN, 2);
}

/* Of 10,000 frames of noise a second, now and then one has our identifier and a right CRC. */
TEST(one_frame_a_second_makes_no_twin)
{
    start(1, 0);
    for (unsigned second = 0; second < 10; second++) {
        refuse(of_a_twin(OCTET_DRIVE_FRAME_ID, OCTET_DRIVE_LENGTH));
        respond((struct output){.has_report = true, .has_drive = true});
    }
    expect(FAULT_TWIN, 10);
}

TEST(a_stop_for_a_twin_has_no_answer_and_no_owner)
{
    struct output out = {.has_answer = true, .has_drive = true};
    struct frame frames[WIRE_FRAMES_MAX];

    start(1, 0);
    for (unsigned i = 0; i < 2; i++)
        hear(of_a_twin(OCTET_HEARTBEAT_FRAME_ID, OCTET_HEARTBEAT_LENGTH));
    TEST_ASSERT_EQUAL_size_t(2, wire_write(&wire, &out, frames));
    TEST_ASSERT_EQUAL_UINT32(OCTET_EMERGENCY_FRAME_ID, frames[0].id);
    TEST_ASSERT_EQUAL_UINT8(0, wire.session.owner);
    expect(FAULT_TWIN, 2);
}

TEST(a_twin_stops_the_robot_once_for_each_start)
{
    const struct frame heard = of_a_twin(OCTET_HEARTBEAT_FRAME_ID, OCTET_HEARTBEAT_LENGTH);

    refuse(heard);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(heard));
    respond((struct output){.has_answer = true, .has_drive = true});
    refuse(heard);
    start(1, 0);
    refuse(heard);
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(heard));
    expect(FAULT_TWIN, 5);
}

TEST(a_twin_is_known_by_its_memory_too)
{
    refuse(memory_frame(NODE, 0, 0));
    TEST_ASSERT_EQUAL(INPUT_COMMAND, hear(memory_frame(NODE, 1, 0)));
    expect(FAULT_TWIN, 2);
}

TEST(a_damaged_frame_of_a_twin_is_damaged)
{
    refuse((struct frame){.id = OCTET_DRIVE_FRAME_ID, .len = 8, .data = {1}});
    expect(FAULT_DAMAGED, 1);
}
