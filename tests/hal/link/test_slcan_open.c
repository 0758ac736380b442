/* Opening a serial line: a terminal, whose settings go to fakes that can refuse them. */
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <termios.h>
#include <unistd.h>

#include "tests/test.h"
#include "open_listening.h"

enum call { NONE, TCGETATTR, CFSETSPEED, TCSETATTR, CALLOC };

static struct termios before, after;   /* as the line was, and as it was set */
static enum call refused;
static struct link *link_opened;

int __wrap_tcgetattr(int fd, struct termios *out);
int __real_cfsetspeed(struct termios *line, speed_t speed);
int __wrap_cfsetspeed(struct termios *line, speed_t speed);
int __wrap_tcsetattr(int fd, int when, const struct termios *line);
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
int __real_close(int fd);
int __wrap_close(int fd);

static bool should_fail(enum call call)
{
    if (call == refused) errno = EIO;
    return call == refused;
}

int __wrap_tcgetattr(int fd, struct termios *out)
{
    (void)fd;
    *out = before;
    return should_fail(TCGETATTR) ? -1 : 0;
}

int __wrap_cfsetspeed(struct termios *line, speed_t speed)
{
    return should_fail(CFSETSPEED) ? -1 : __real_cfsetspeed(line, speed);
}

int __wrap_tcsetattr(int fd, int when, const struct termios *line)
{
    (void)fd;
    TEST_ASSERT_EQUAL(TCSANOW, when);
    after = *line;
    return should_fail(TCSETATTR) ? -1 : 0;
}

void *__wrap_calloc(size_t count, size_t size)
{
    return should_fail(CALLOC) ? NULL : __real_calloc(count, size);
}

/* A close that changes errno. */
int __wrap_close(int fd)
{
    int result = __real_close(fd);
    errno = EINTR;
    return result;
}

void setUp(void)
{
    memset(&before, 0, sizeof before);
    refused = NONE;
    link_opened = NULL;
}

void tearDown(void)
{
    link_close(link_opened);
}

static int open_line(const char *name)
{
    return open_listening(&link_opened, name, 1);
}

/* The descriptor that the next open will return. */
static int free_descriptor(void)
{
    int fd = dup(STDERR_FILENO);
    close(fd);
    return fd;
}

static void assert_raw(void)
{
    TEST_ASSERT_EQUAL_HEX(0, after.c_iflag & (ISTRIP | INLCR | IGNCR | ICRNL | IXON));
    TEST_ASSERT_EQUAL_HEX(0, after.c_oflag & OPOST);
    TEST_ASSERT_EQUAL_HEX(0, after.c_lflag & (ECHO | ICANON | ISIG));
    TEST_ASSERT_EQUAL_HEX(CS8, after.c_cflag & (CSIZE | PARENB | CSTOPB));
}

TEST(serial_line_is_set_to_raw_mode)
{
    TEST_ASSERT_EQUAL_INT(0, open_line("slcan:/dev/ptmx"));
    assert_raw();
    link_close(link_opened);
    before.c_iflag = before.c_oflag = before.c_cflag = before.c_lflag = (tcflag_t)~0u;
    TEST_ASSERT_EQUAL_INT(0, open_line("slcan:/dev/ptmx"));
    assert_raw();
}

TEST(serial_line_ignores_modem_control_lines)
{
    TEST_ASSERT_EQUAL_INT(0, open_line("slcan:/dev/ptmx"));
    TEST_ASSERT_EQUAL_HEX(CLOCAL | CREAD, after.c_cflag & (CLOCAL | CREAD | CRTSCTS));
    link_close(link_opened);
    before.c_cflag = (tcflag_t)~0u;
    TEST_ASSERT_EQUAL_INT(0, open_line("slcan:/dev/ptmx"));
    TEST_ASSERT_EQUAL_HEX(CLOCAL | CREAD, after.c_cflag & (CLOCAL | CREAD | CRTSCTS));
}

TEST(link_name_selects_every_baud_rate)
{
    static const struct {
        const char *name;
        speed_t speed;
    } cases[] = {{"", B115200},        {"@9600", B9600},       {"@19200", B19200},     {"@38400", B38400},
                 {"@57600", B57600},   {"@115200", B115200},   {"@230400", B230400},   {"@460800", B460800},
                 {"@500000", B500000}, {"@921600", B921600},   {"@1000000", B1000000}, {"@2000000", B2000000},
                 {"@3000000", B3000000}};
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char name[40];
        snprintf(name, sizeof name, "slcan:/dev/ptmx%s", cases[i].name);
        TEST_ASSERT_EQUAL_INT(0, open_line(name));
        TEST_ASSERT_EQUAL_UINT(cases[i].speed, cfgetospeed(&after));
        TEST_ASSERT_EQUAL_UINT(cases[i].speed, cfgetispeed(&after));
        link_close(link_opened);
        link_opened = NULL;
    }
}

TEST(serial_line_is_non_blocking_and_close_on_exec)
{
    int fd = free_descriptor();
    TEST_ASSERT_EQUAL_INT(0, link_open(&link_opened, "slcan:/dev/ptmx", NULL, 0));
    TEST_ASSERT_EQUAL_HEX(O_RDWR | O_NONBLOCK, fcntl(fd, F_GETFL) & (O_ACCMODE | O_NONBLOCK));
    TEST_ASSERT_EQUAL_HEX(FD_CLOEXEC, fcntl(fd, F_GETFD));
}

TEST(serial_line_opens_as_descriptor_0)
{
    int input = dup(STDIN_FILENO);
    close(STDIN_FILENO);
    TEST_ASSERT_EQUAL_INT(0, link_open(&link_opened, "slcan:/dev/ptmx", NULL, 0));
    link_close(link_opened);
    link_opened = NULL;
    TEST_ASSERT_EQUAL_INT(STDIN_FILENO, dup2(input, STDIN_FILENO));
    close(input);
}

TEST(failed_open_prints_the_error_and_leaks_nothing)
{
    int count = open_descriptors();
    for (refused = TCGETATTR; refused <= CALLOC; refused++) {
        TEST_ASSERT_EQUAL_INT(LINK_E_OPEN, open_line("slcan:/dev/ptmx"));
        TEST_ASSERT_NULL(link_opened);
        TEST_ASSERT_EQUAL_STRING("link slcan:/dev/ptmx: Input/output error\n", printed);
        TEST_ASSERT_EQUAL_INT(count, open_descriptors());
    }
}

TEST(missing_line_is_refused_with_the_reason)
{
    TEST_ASSERT_EQUAL_INT(LINK_E_OPEN, open_line("slcan:/no/such/line"));
    TEST_ASSERT_EQUAL_STRING("link slcan:/no/such/line: No such file or directory\n", printed);
}

/* Repeated slashes count as one. */
TEST(path_length_is_limited_by_path_max)
{
    static const char end[] = "/dev/ptmx";
    char name[sizeof "slcan:" + PATH_MAX] = "slcan:";
    char *path = name + strlen(name);
    memset(path, '/', PATH_MAX);
    strcpy(path + PATH_MAX - sizeof end, end);
    TEST_ASSERT_EQUAL_size_t(PATH_MAX - 1, strlen(path));
    TEST_ASSERT_EQUAL_INT(0, open_line(name));
    memset(path, '/', PATH_MAX);
    strcpy(path + PATH_MAX - sizeof end + 1, end);
    TEST_ASSERT_EQUAL_INT(LINK_E_NAME, open_line(name));
}
