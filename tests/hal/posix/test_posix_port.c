/* What the host brings as a port. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>

#include "posix_port_rig.h"

/* First: none has been named yet. */
TEST(without_a_file_there_is_no_memory_to_load_and_none_is_kept)
{
    static const uint8_t memory[CELL_COUNT] = {0, 1};
    uint8_t loaded[CELL_COUNT];

    TEST_ASSERT_EQUAL(0, port_load(loaded));
    TEST_ASSERT_EQUAL(0, port_store(memory, PORT_QUICKLY));
    TEST_ASSERT_EQUAL(0, port_load(loaded));
}

/* Whoever waits for it reads from a pipe. */
TEST(it_says_at_once_that_it_is_ready)
{
    int file = open_scratch(), kept;

    TEST_ASSERT_EQUAL(0, open_with("--node", "7", "fd:3", NULL));
    kept = redirect(stdout, dup(file));
    port_ready(&port);
    read_said(file);
    close(redirect(stdout, kept));
    TEST_ASSERT_EQUAL_STRING("octet-robot: node 7 listens on fd:3\n", said);
}

TEST(the_memory_goes_to_the_file_that_was_named)
{
    static const uint8_t memory[CELL_COUNT] = {0, 1, 2, 1, 2, 1, 2, 2};
    char folder[] = "/tmp/test_posix_port_XXXXXX", path[64];
    uint8_t loaded[CELL_COUNT];

    TEST_ASSERT_NOT_NULL(mkdtemp(folder));
    snprintf(path, sizeof path, "%s/robot.mem", folder);
    TEST_ASSERT_EQUAL(0, open_with("--memory", path, "fd:3", NULL));
    TEST_ASSERT_EQUAL(0, port_load(loaded));
    TEST_ASSERT_EQUAL(0, port_store(memory, PORT_QUICKLY));
    TEST_ASSERT_EQUAL(1, port_load(loaded));
    TEST_ASSERT_EQUAL_UINT8_ARRAY(memory, loaded, CELL_COUNT);
    unlink(path);
    rmdir(folder);
    TEST_ASSERT_EQUAL(HAL_E_STORE, port_store(memory, PORT_AT_REST));
}

TEST(time_is_in_milliseconds_and_wraps)
{
    now = (struct timespec){.tv_sec = 5, .tv_nsec = 1999999};
    TEST_ASSERT_EQUAL_UINT32(5001, port_clock_ms());
    now = (struct timespec){.tv_sec = 5, .tv_nsec = 999999999};
    TEST_ASSERT_EQUAL_UINT32(5999, port_clock_ms());
    now = (struct timespec){.tv_sec = 4294967, .tv_nsec = 297000000};
    TEST_ASSERT_EQUAL_UINT32(1, port_clock_ms());
    now = (struct timespec){.tv_sec = LONG_MAX, .tv_nsec = 999999999};   /* a clock that no multiplication may overflow */
    TEST_ASSERT_EQUAL_UINT32((uint32_t)LONG_MAX * 1000u + 999u, port_clock_ms());
    port_alive(true);   /* nobody watches a process on the host */
}

TEST(entropy_differs_and_does_without_the_system)
{
    uint32_t first = port_entropy(), second = port_entropy();

    TEST_ASSERT_TRUE(first != second || port_entropy() != second);
    now = (struct timespec){.tv_sec = 1};
    for (unsigned ms = 1; ms < 1000; ms++) {
        getrandom_gives = ms < 500 ? -1 : 2;
        uint32_t before = port_entropy();

        now.tv_nsec = ms * 1000000l;
        TEST_ASSERT_TRUE(port_entropy() != before);
    }
}

TEST(entropy_without_the_system_differs_from_process_to_process)
{
    int status;
    uint32_t ours;
    pid_t child;

    getrandom_gives = -1;
    ours = port_entropy();
    child = fork();
    if (child == 0)
        _exit(port_entropy() != ours ? 0 : 1);
    TEST_ASSERT_EQUAL(child, waitpid(child, &status, 0));
    TEST_ASSERT_EQUAL(0, status);
}
