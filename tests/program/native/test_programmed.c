#include "host_sim/program/native/programmed.h"

#include <string.h>

#include "tests/test.h"

static struct octet *octet;
static struct input in;
static struct output out;

static void open(const char *text)
{
    static const uint8_t nothing[CELL_COUNT];

    octet = programmed_open(3, nothing, text, strlen(text));
    TEST_ASSERT_NOT_NULL(octet);
    in = (struct input){.command = {.opcode = OPCODE_START, .which = PROFILE_ARTICLE, .value = 1}};
    octet->respond(&octet->robot, INPUT_COMMAND, &in, &out);
}

static void tick(uint8_t feel)
{
    in.senses.tick++;
    in.senses.feel = feel;
    octet->respond(&octet->robot, INPUT_SENSES, &in, &out);
}

void tearDown(void)
{
    octet_close(octet);
}

TEST(program_drives_the_wheels)
{
    open("rForward 100\n");
    tick(0);
    TEST_ASSERT_EQUAL(RESULT_DONE, out.answer);
    TEST_ASSERT_EQUAL(200, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL(REASON_WANDER, out.drive.reason);
}

TEST(mem_write_is_reported_and_stored)
{
    open("Mem[4] = 2\ndelay 100");
    tick(0);
    TEST_ASSERT_TRUE(out.has_memory);
    TEST_ASSERT_TRUE(out.store);
    TEST_ASSERT_EQUAL(SIDE_RIGHT, out.memory[4]);
}

TEST(start_restarts_the_program)
{
    open("x = x + 1\nrForward 100\nrTurn 5");
    tick(0);
    in.command = (struct command){.opcode = OPCODE_START, .which = PROFILE_ARTICLE, .value = 1};
    octet->respond(&octet->robot, INPUT_COMMAND, &in, &out);
    TEST_ASSERT_EQUAL(1, programmed_state(octet)->code_count > 0);
    TEST_ASSERT_EQUAL_DOUBLE(0, programmed_state(octet)->cells[0]);
}

TEST(start_of_another_profile_is_refused)
{
    open("rForward 1");
    in.command = (struct command){.opcode = OPCODE_START, .which = PROFILE_NEVER, .value = 1};
    octet->respond(&octet->robot, INPUT_COMMAND, &in, &out);
    TEST_ASSERT_EQUAL(RESULT_UNKNOWN_PROFILE, out.answer);
}

TEST(program_with_a_mistake_rests_and_reports_it)
{
    char told[PROGRAMMED_TOLD_MAX];

    open("x = 1\nrTrun 5");
    tick(0);
    TEST_ASSERT_EQUAL(0, out.drive.left_mm_s);
    TEST_ASSERT_EQUAL(REASON_PROGRAM, out.drive.reason);
    programmed_tell(programmed_state(octet), told);
    TEST_ASSERT_EQUAL_STRING("line 2: \"rTrun\": expected a command, a label, or a variable with = after it", told);
}

TEST(program_report_has_state_and_shown_texts)
{
    char told[PROGRAMMED_TOLD_MAX];

    open("xyString 1,1,\"a\"\nxyString 2,1,\"b\"\nend");
    tick(0);
    programmed_tell(programmed_state(octet), told);
    TEST_ASSERT_EQUAL_STRING("it has ended; it shows a | b", told);
}

TEST(program_report_names_an_incomplete_line)
{
    char told[PROGRAMMED_TOLD_MAX];

    open("x =");
    programmed_tell(programmed_state(octet), told);
    TEST_ASSERT_EQUAL_STRING("line 1: the line ends: expected a number such as 0.5, a variable or a function", told);
}
