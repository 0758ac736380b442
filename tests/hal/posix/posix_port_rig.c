#include "posix_port_rig.h"

#include <errno.h>
#include <getopt.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/prctl.h>
#include <sys/random.h>
#include <unistd.h>

enum { WORDS_MAX = 8 };

struct port port;
char said[512];
struct timespec now;
bool prctl_fails;
ssize_t getrandom_gives;

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

int redirect(FILE *stream, int to)
{
    int kept = dup(fileno(stream));

    fflush(stream);
    TEST_ASSERT_TRUE(dup2(to, fileno(stream)) >= 0);
    close(to);
    return kept;
}

void read_said(int fd)
{
    ssize_t got = pread(fd, said, sizeof said - 1, 0);

    said[got > 0 ? got : 0] = '\0';
    close(fd);
}

int open_scratch(void)
{
    char name[] = "/tmp/test_posix_port_XXXXXX";
    int fd = mkstemp(name);

    TEST_ASSERT_TRUE(fd >= 0);
    unlink(name);
    return fd;
}

int open_with(const char *first, ...)
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

void assert_says(const char *text)
{
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(said, text), said);
}
