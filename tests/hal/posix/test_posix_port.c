/* The port of the host. */
#include "tests/test.h"
#include "hal/can_body/port.h"

#include <errno.h>
#include <getopt.h>
#include <limits.h>
#include <signal.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <sys/types.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

/* The host's port, with a fake clock and fake system calls, and what it prints. */

int __real_prctl(int option, unsigned long value);

enum { WORDS_MAX = 8 };

static struct port port;
static char printed[512];   /* on the stream that was redirected */
static struct timespec now;
static bool prctl_fails;
static ssize_t getrandom_gives;   /* bytes, or -1; 0: as many as are asked for */

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

/* Redirects a stream into a file, which is closed, or back. Returns what it was before. */
static int redirect(FILE *stream, int to)
{
    int kept = dup(fileno(stream));

    fflush(stream);
    TEST_ASSERT_TRUE(dup2(to, fileno(stream)) >= 0);
    close(to);
    return kept;
}

/* Reads a file into `printed`, and closes it. */
static void read_printed(int fd)
{
    ssize_t got = pread(fd, printed, sizeof printed - 1, 0);

    printed[got > 0 ? got : 0] = '\0';
    close(fd);
}

/* An empty private file. */
static int open_scratch(void)
{
    char name[] = "/tmp/test_posix_port_XXXXXX";
    int fd = mkstemp(name);

    TEST_ASSERT_TRUE(fd >= 0);
    unlink(name);
    return fd;
}

/* port_open with these words, the last of them null; what it prints on stderr is in `printed`. */
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
    read_printed(file);
    return result;
}

static void assert_printed(const char *text)
{
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(printed, text), printed);
}

/* First: no file has been named yet. */
TEST(port_without_a_memory_file_stores_nothing)
{
    static const uint8_t memory[CELL_COUNT] = {0, 1};
    uint8_t loaded[CELL_COUNT];

    TEST_ASSERT_EQUAL(0, port_load(loaded));
    TEST_ASSERT_EQUAL(0, port_store(memory, PORT_QUICKLY));
    TEST_ASSERT_EQUAL(0, port_load(loaded));
}

/* Stdout is a pipe for a program that waits for it. */
TEST(port_prints_readiness_at_once)
{
    int file = open_scratch(), kept;

    TEST_ASSERT_EQUAL(0, open_with("--node", "7", "fd:3", NULL));
    kept = redirect(stdout, dup(file));
    port_ready(&port);
    read_printed(file);
    close(redirect(stdout, kept));
    TEST_ASSERT_EQUAL_STRING("octet-robot: node 7 listens on fd:3\n", printed);
}

TEST(memory_is_stored_in_the_named_file)
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

TEST(port_clock_counts_milliseconds_and_wraps)
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

TEST(entropy_differs_with_and_without_getrandom)
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

TEST(entropy_without_getrandom_differs_between_processes)
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

TEST(default_node_is_1)
{
    TEST_ASSERT_EQUAL(0, open_with("socketcan:vcan0", NULL));
    TEST_ASSERT_EQUAL_STRING("socketcan:vcan0", port.link);
    TEST_ASSERT_EQUAL_UINT8(1, port.node);
    TEST_ASSERT_TRUE(port.clock_exact);
    TEST_ASSERT_EQUAL(RESET_POWER_ON, port.reset_cause);
    TEST_ASSERT_NULL(port.crash);
    TEST_ASSERT_EQUAL_STRING("", printed);
}

TEST(every_node_can_be_selected)
{
    for (int node = 1; node <= NODE_MAX; node++) {
        char number[8];

        snprintf(number, sizeof number, "%d", node);
        TEST_ASSERT_EQUAL(0, open_with("--node", number, "fd:3", NULL));
        TEST_ASSERT_EQUAL_UINT8(node, port.node);
        TEST_ASSERT_EQUAL_STRING("fd:3", port.link);
    }
}

TEST(invalid_node_numbers_are_refused_with_a_message)
{
    static const char *const wrong[] = {"0", "-1", "32", "257", "", "x", "1x", "1 ", "1\xC3\xA4", "99999999999999999999"};

    TEST_ASSERT_EQUAL(31, NODE_MAX);
    for (unsigned i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
        TEST_ASSERT_EQUAL_MESSAGE(HAL_E_USAGE, open_with("--node", wrong[i], "fd:3", NULL), wrong[i]);
        assert_printed("--node is 1..31, not");
    }
}

TEST(missing_or_second_link_prints_the_usage)
{
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with(NULL));
    assert_printed("usage: octet-robot");
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with("fd:3", "fd:4", NULL));
    assert_printed("usage: octet-robot");
}

TEST(usage_names_every_link_kind_and_node)
{
    char nodes[16];

    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with(NULL));
    assert_printed("socketcan:IFACE, fd:N or slcan:PATH[@BAUD]");
    snprintf(nodes, sizeof nodes, "1..%d (1)", NODE_MAX);
    assert_printed(nodes);
}

TEST(unknown_option_prints_the_usage)
{
    TEST_ASSERT_EQUAL(HAL_E_USAGE, open_with("--nodes", "3", "fd:3", NULL));
    assert_printed("usage: octet-robot");
}

TEST(help_prints_the_usage_and_exits_0)
{
    int status, file = open_scratch();
    pid_t child;

    fflush(stdout);   /* else the child prints the buffer again */
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
    read_printed(file);
    TEST_ASSERT_EQUAL_PTR_MESSAGE(printed, strstr(printed, "usage: octet-robot"), printed);
}

TEST(with_parent_option_ends_the_robot_with_its_parent)
{
    int sent = 0;

    TEST_ASSERT_EQUAL(0, open_with("--with-parent", "fd:3", NULL));
    TEST_ASSERT_EQUAL(0, __real_prctl(PR_GET_PDEATHSIG, (unsigned long)&sent));
    TEST_ASSERT_EQUAL(SIGKILL, sent);
    TEST_ASSERT_EQUAL(0, __real_prctl(PR_SET_PDEATHSIG, 0));
    prctl_fails = true;
    TEST_ASSERT_EQUAL(HAL_E_BODY, open_with("--with-parent", "fd:3", NULL));
}
