#include <stdio.h>
#include <string.h>

#include "host_sim/program/native/programmed.h"
#include "tests/test.h"

int program_main(int argc, char *argv[]);
int robot_main(int argc, char *argv[]);

static char node[] = "--node", one[] = "1", name[] = "octet-program", path[] = "program.bas.tmp";
static int calls;

/* In place of the firmware's. */
int robot_main(int argc, char *argv[])
{
    struct robot robot;
    struct input in = {.command = {.opcode = OPCODE_START, .which = PROFILE_ARTICLE}};
    struct output out;

    calls++;
    TEST_ASSERT_EQUAL(3, argc);
    TEST_ASSERT_EQUAL_STRING("--node", argv[1]);
    robot_init(&robot, 1);
    programmed_robot_respond(&robot, INPUT_COMMAND, &in, &out);
    programmed_robot_respond(&robot, INPUT_SENSES, &in, &out);
    return (int)out.drive.reason;
}

void setUp(void)
{
    calls = 0;
}

void tearDown(void)
{
    (void)remove(path);
}

static int run(const char *text)
{
    char *arguments[] = {name, path, node, one};
    FILE *file = fopen(path, "w");

    TEST_ASSERT_NOT_NULL(file);
    fputs(text, file);
    fclose(file);
    return program_main(4, arguments);
}

TEST(program_decides_the_actions_of_the_robot)
{
    TEST_ASSERT_EQUAL(REASON_WANDER, run("rForward 5"));
    TEST_ASSERT_EQUAL(1, calls);
}

TEST(program_that_fails_leaves_the_robot_running)
{
    TEST_ASSERT_EQUAL(REASON_PROGRAM, run("x = 1 / 0"));
    TEST_ASSERT_EQUAL(1, calls);
}

TEST(invalid_program_does_not_start)
{
    TEST_ASSERT_EQUAL(2, run("rTrun 5"));
    TEST_ASSERT_EQUAL(0, calls);
}

TEST(missing_program_does_not_start)
{
    char *arguments[] = {name, path};

    TEST_ASSERT_EQUAL(2, program_main(1, arguments));
    TEST_ASSERT_EQUAL(2, program_main(2, arguments));
    TEST_ASSERT_EQUAL(0, calls);
}
