/* Which parts of a report are sent, and when. */
#include "tests/test.h"
#include "writing_rig.h"

TEST(the_parts_of_a_report_wait_for_drives_in_answer_to_senses)
{
    out.has_report = true;
    TEST_ASSERT_EQUAL_size_t(0, write_out());
    out.has_report = false;
    out.has_drive = out.silent = true;
    TEST_ASSERT_EQUAL_size_t(1, write_out());
    out.silent = false;
    TEST_ASSERT_EQUAL_size_t(2, write_out());
}

TEST(a_report_is_spread_over_the_drives_of_many_ticks)
{
    static const uint32_t ids[] = {0x6A1, 0x681, 0x781, 0x781, 0, 0x7C1, 0};

    for (unsigned i = 0; i < sizeof ids / sizeof ids[0]; i++) {
        out = (struct output){.has_report = i == 0, .has_drive = true};
        TEST_ASSERT_EQUAL_size_t(ids[i] == 0 ? 1 : ids[i] == 0x681 ? 3 : 2, write_out());
        TEST_ASSERT_EQUAL_HEX32(ids[i] == 0 ? 0x041 : ids[i], frames[0].id);
        if (frames[0].id == OCTET_HEALTH_FRAME_ID)
            TEST_ASSERT_EQUAL_UINT8(0, wire.part);   /* it has ended */
    }
}

TEST(a_whole_report_ends_one_that_is_under_way)
{
    static const uint32_t drive = 0x041;

    out = (struct output){.has_report = true, .has_drive = true};
    write_out();
    whole_report();
    out = (struct output){.has_drive = true};
    assert_ids(&drive, 1);
}

TEST(a_start_ends_a_report_that_is_under_way)
{
    static const uint32_t drive = 0x041;

    out = (struct output){.has_report = true, .has_drive = true};
    write_out();
    out = (struct output){.has_answer = true};
    (void)answer_to((struct octet_command_t){.counter = 1, .opcode = OPCODE_START}, RESULT_DONE);
    out = (struct output){.has_drive = true};
    assert_ids(&drive, 1);
}

TEST(a_start_of_a_robot_that_has_an_owner_ends_no_report)
{
    static const uint32_t ids[] = {0x681, 0x681, 0x041};

    (void)answer_to((struct octet_command_t){.counter = 1, .opcode = OPCODE_START, .owner = 1}, RESULT_DONE);
    out = (struct output){.has_report = true, .has_drive = true};
    write_out();
    out = (struct output){.has_answer = true};
    (void)answer_to((struct octet_command_t){.counter = 2, .opcode = OPCODE_START, .owner = 1}, RESULT_DONE);
    out = (struct output){.has_drive = true};
    assert_ids(ids, 3);
}

TEST(what_is_whole_is_sent_only_if_there_is_a_report)
{
    out = (struct output){.whole_report = true};
    TEST_ASSERT_EQUAL_size_t(0, write_out());
}

TEST(a_new_memory_holds_the_report_up)
{
    static const uint32_t ids[] = {0x681, 0x681, 0x041}, next[] = {0x6A1, 0x041};

    out = (struct output){.has_report = true, .has_memory = true, .has_drive = true};
    assert_ids(ids, 3);
    out = (struct output){.has_drive = true};
    assert_ids(next, 2);
}

TEST(in_silence_there_is_a_heartbeat_and_nothing_else)
{
    static const uint32_t ids[] = {0x6A1, 0x041};

    out = (struct output){.has_report = true, .silent = true, .has_drive = true};
    assert_ids(ids, 2);
    out.has_report = false;
    assert_ids(ids + 1, 1);
    out.silent = false;
    assert_ids(ids + 1, 1);
    out = (struct output){.has_report = true, .whole_report = true, .silent = true};
    assert_ids(ids, 1);
}
