/* What the host brings as a port. */
#include <limits.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <unistd.h>
#include <sys/prctl.h>
#include <signal.h>
#include <getopt.h>

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

/* What the command line of a robot on the host means. */

TEST(a_link_alone_is_node_1)
{
    TEST_ASSERT_EQUAL(0, open_with("socketcan:vcan0", NULL));
    TEST_ASSERT_EQUAL_STRING("socketcan:vcan0", port.link);
    TEST_ASSERT_EQUAL_UINT8(1, port.node);
    TEST_ASSERT_TRUE(port.clock_exact);
    TEST_ASSERT_EQUAL(RESET_POWER_ON, port.reset_cause);
    TEST_ASSERT_NULL(port.crash);
    TEST_ASSERT_EQUAL_STRING("", said);
}

TEST(every_node_of_a_bus_can_be_chosen)
{
    for (int node = 1; node <= NODE_MAX; node++) {
        char number[8];

        snprintf(number, sizeof number, "%d", node);
        TEST_ASSERT_EQUAL(0, open_with("--node", number, "fd:3", NULL));
        TEST_ASSERT_EQUAL_UINT8(node, port.node);
        TEST_ASSERT_EQUAL_STRING("fd:3", port.link);
    }
}

TEST(what_is_no_node_is_refused_and_said)
{
    static const char *const wrong[] = {"0", "-1", "32", "257", "", "x", "1x", "1 ", "1\xC3\xA4", "99999999999999999999"};

    TEST_ASSERT_EQUAL(31, NODE_MAX);
    for (unsigned i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        TEST_ASSERT_EQUAL_MESSAGE(HAL_E_USAGE, open_with("--node", wrong[i], "fd:3", NULL), wrong[i]);
        assert_says("--node is 1..31, not");
    }
}

TEST(without_a_link_or_with_two_it_tells_its_usage)
{
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with(NULL));
    assert_says("usage: octet-robot");
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with("fd:3", "fd:4", NULL));
    assert_says("usage: octet-robot");
}

TEST(the_usage_names_every_kind_of_link_and_every_node)
{
    char nodes[16];

    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with(NULL));
    assert_says("socketcan:IFACE, fd:N or slcan:PATH[@BAUD]");
    snprintf(nodes, sizeof nodes, "1..%d (1)", NODE_MAX);
    assert_says(nodes);
}

TEST(an_unknown_option_is_refused_with_the_usage)
{
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with("--nodes", "3", "fd:3", NULL));
    assert_says("usage: octet-robot");
}

TEST(help_is_its_usage_and_no_error)
{
    int status, file = open_scratch();
    pid_t child;

    fflush(stdout);   /* else the child says what waits there, too */
    child = fork();

    if (child == 0) {
        char *argv[] = {(char[]){"octet-robot"}, (char[]){"--help"}, NULL};

        (void)redirect(stdout, dup(file));
        optind = 0;
        (void)port_open(&port, 2, argv);
        _exit(99);
    }
    TEST_ASSERT_EQUAL(child, waitpid(child, &status, 0));
    TEST_ASSERT_EQUAL(0, status);
    read_said(file);
    TEST_ASSERT_EQUAL_PTR_MESSAGE(said, strstr(said, "usage: octet-robot"), said);
}

TEST(with_its_parent_it_ends)
{
    int sent = 0;

    TEST_ASSERT_EQUAL(0, open_with("--with-parent", "fd:3", NULL));
    TEST_ASSERT_EQUAL(0, __real_prctl(PR_GET_PDEATHSIG, (unsigned long)&sent));
    TEST_ASSERT_EQUAL(SIGKILL, sent);
    TEST_ASSERT_EQUAL(0, __real_prctl(PR_SET_PDEATHSIG, 0));
    prctl_fails = true;
    TEST_ASSERT_EQUAL(HAL_E_BODY, open_with("--with-parent", "fd:3", NULL));
}
