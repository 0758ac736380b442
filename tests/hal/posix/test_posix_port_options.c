/* What the command line of a robot on the host means. */
#include <getopt.h>
#include <signal.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "posix_port_rig.h"

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
