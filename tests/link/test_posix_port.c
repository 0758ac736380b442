/* The host as a port: what its command line means, and what it brings. */
#include <errno.h>
#include <fcntl.h>
#include <getopt.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#include <unity.h>

#include "hal/can_body/port.h"

enum { WORDS_MAX = 8 };

static struct port port;
static char said[512];      /* on the stream that was redirected */
static struct timespec now;
static bool prctl_fails;
static ssize_t getrandom_gives;   /* bytes, or -1; 0: as many as are asked for */

int __real_prctl(int option, unsigned long value);
int __wrap_prctl(int option, unsigned long value);
ssize_t __real_getrandom(void *to, size_t size, unsigned flags);
ssize_t __wrap_getrandom(void *to, size_t size, unsigned flags);

int __wrap_clock_gettime(clockid_t clock, struct timespec *out);

int __wrap_clock_gettime(clockid_t clock, struct timespec *out)
{
    TEST_ASSERT_EQUAL(CLOCK_MONOTONIC, clock);
    *out = now;
    return 0;
}

int __wrap_prctl(int option, unsigned long value)
{
    return prctl_fails ? -1 : __real_prctl(option, value);
}

ssize_t __wrap_getrandom(void *to, size_t size, unsigned flags)
{
    TEST_ASSERT_EQUAL_HEX(0, flags);   /* it waits until the system has gathered some */
    return getrandom_gives ? getrandom_gives : __real_getrandom(to, size, flags);
}

void setUp(void)
{
    memset(&port, 0xA5, sizeof port);
    prctl_fails = false;
    getrandom_gives = 0;
}

void tearDown(void) {}

/* Redirects a stream into a file, or back. */
static int redirect(FILE *stream, int to)
{
    int kept = dup(fileno(stream));

    fflush(stream);
    TEST_ASSERT_TRUE(dup2(to, fileno(stream)) >= 0);
    close(to);
    return kept;
}

static void read_said(int fd)
{
    ssize_t got = pread(fd, said, sizeof said - 1, 0);

    said[got > 0 ? got : 0] = '\0';
    close(fd);
}

static int open_scratch(void)
{
    char name[] = "/tmp/test_posix_port_XXXXXX";
    int fd = mkstemp(name);

    TEST_ASSERT_TRUE(fd >= 0);
    unlink(name);
    return fd;
}

/* port_open with these words, the last of them null; what it says on stderr is kept. */
static int open_with(const char *first, ...)
{
    static char words[WORDS_MAX][64];
    char *argv[WORDS_MAX + 1];
    int argc = 0, file = open_scratch(), kept = redirect(stderr, dup(file)), result;
    va_list more;

    va_start(more, first);
    for (const char *word = "octet-robot"; word != NULL; word = argc == 1 ? first : va_arg(more, const char *)) {
        TEST_ASSERT_LESS_THAN(WORDS_MAX, argc);
        snprintf(words[argc], sizeof words[argc], "%s", word);
        argv[argc] = words[argc];
        argc++;
    }
    va_end(more);
    argv[argc] = NULL;
    optind = 0;   /* getopt begins anew */
    errno = ERANGE;   /* of something that failed before */
    result = port_open(&port, argc, argv);
    close(redirect(stderr, kept));
    read_said(file);
    return result;
}

static void assert_says(const char *text)
{
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(said, text), said);
}

/* ---- the command line */

static void test_a_link_alone_is_node_1(void)
{
    TEST_ASSERT_EQUAL(0, open_with("socketcan:vcan0", NULL));
    TEST_ASSERT_EQUAL_STRING("socketcan:vcan0", port.link);
    TEST_ASSERT_EQUAL_UINT8(1, port.node);
    TEST_ASSERT_TRUE(port.clock_exact);
    TEST_ASSERT_EQUAL(RESET_POWER_ON, port.reset_cause);
    TEST_ASSERT_NULL(port.crash);
    TEST_ASSERT_EQUAL_STRING("", said);
}

static void test_every_node_of_a_bus_can_be_chosen(void)
{
    for (int node = 1; node <= NODE_MAX; node++) {
        char number[8];

        snprintf(number, sizeof number, "%d", node);
        TEST_ASSERT_EQUAL(0, open_with("--node", number, "fd:3", NULL));
        TEST_ASSERT_EQUAL_UINT8(node, port.node);
        TEST_ASSERT_EQUAL_STRING("fd:3", port.link);
    }
}

static void test_what_is_no_node_is_refused_and_said(void)
{
    static const char *const wrong[] = {"0", "-1", "32", "257", "", "x", "1x", "1 ", "1\xC3\xA4", "99999999999999999999"};

    TEST_ASSERT_EQUAL(31, NODE_MAX);
    for (unsigned i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        TEST_ASSERT_EQUAL_MESSAGE(HAL_E_USAGE, open_with("--node", wrong[i], "fd:3", NULL), wrong[i]);
        assert_says("--node is 1..31, not");
    }
}

static void test_without_a_link_or_with_two_it_tells_its_usage(void)
{
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with(NULL));
    assert_says("usage: octet-robot");
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with("fd:3", "fd:4", NULL));
    assert_says("usage: octet-robot");
}

static void test_the_usage_names_every_kind_of_link_and_every_node(void)
{
    char nodes[16];

    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with(NULL));
    assert_says("socketcan:IFACE, fd:N or slcan:PATH[@BAUD]");
    snprintf(nodes, sizeof nodes, "1..%d (1)", NODE_MAX);
    assert_says(nodes);
}

static void test_an_unknown_option_is_refused_with_the_usage(void)
{
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with("--nodes", "3", "fd:3", NULL));
    assert_says("usage: octet-robot");
}

static void test_help_is_its_usage_and_no_error(void)
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

static void test_with_its_parent_it_ends(void)
{
    int sent = 0;

    TEST_ASSERT_EQUAL(0, open_with("--with-parent", "fd:3", NULL));
    TEST_ASSERT_EQUAL(0, __real_prctl(PR_GET_PDEATHSIG, (unsigned long)&sent));
    TEST_ASSERT_EQUAL(SIGKILL, sent);
    TEST_ASSERT_EQUAL(0, __real_prctl(PR_SET_PDEATHSIG, 0));
    prctl_fails = true;
    TEST_ASSERT_EQUAL(HAL_E_BODY, open_with("--with-parent", "fd:3", NULL));
}

/* ---- what it brings */

/* Whoever waits for it reads from a pipe. */
static void test_it_says_at_once_that_it_is_ready(void)
{
    int file = open_scratch(), kept;

    TEST_ASSERT_EQUAL(0, open_with("--node", "7", "fd:3", NULL));
    kept = redirect(stdout, dup(file));
    port_ready(&port);
    read_said(file);
    close(redirect(stdout, kept));
    TEST_ASSERT_EQUAL_STRING("octet-robot: node 7 listens on fd:3\n", said);
}

static void test_without_a_file_there_is_no_memory_to_load_and_none_is_kept(void)
{
    static const uint8_t memory[CELL_COUNT] = {0, 1};
    uint8_t loaded[CELL_COUNT];

    TEST_ASSERT_EQUAL(0, port_load(loaded));
    TEST_ASSERT_EQUAL(0, port_store(memory, PORT_QUICKLY));
    TEST_ASSERT_EQUAL(0, port_load(loaded));
}

static void test_the_memory_goes_to_the_file_that_was_named(void)
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

static void test_time_is_in_milliseconds_and_wraps(void)
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

static void test_entropy_differs_and_does_without_the_system(void)
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

static void test_entropy_without_the_system_differs_from_process_to_process(void)
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

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_without_a_file_there_is_no_memory_to_load_and_none_is_kept);   /* first: none has been named yet */
    RUN_TEST(test_a_link_alone_is_node_1);
    RUN_TEST(test_every_node_of_a_bus_can_be_chosen);
    RUN_TEST(test_what_is_no_node_is_refused_and_said);
    RUN_TEST(test_without_a_link_or_with_two_it_tells_its_usage);
    RUN_TEST(test_the_usage_names_every_kind_of_link_and_every_node);
    RUN_TEST(test_an_unknown_option_is_refused_with_the_usage);
    RUN_TEST(test_help_is_its_usage_and_no_error);
    RUN_TEST(test_with_its_parent_it_ends);
    RUN_TEST(test_it_says_at_once_that_it_is_ready);
    RUN_TEST(test_the_memory_goes_to_the_file_that_was_named);
    RUN_TEST(test_time_is_in_milliseconds_and_wraps);
    RUN_TEST(test_entropy_differs_and_does_without_the_system);
    RUN_TEST(test_entropy_without_the_system_differs_from_process_to_process);
    return UNITY_END();
}
