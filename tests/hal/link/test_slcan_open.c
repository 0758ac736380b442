/* How a serial line is opened: a terminal, whose settings are kept by fakes that can refuse them. */
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

static bool strikes(enum call call)
{
    if (call == refused) errno = EIO;
    return call == refused;
}

int __wrap_tcgetattr(int fd, struct termios *out)
{
    (void)fd;
    *out = before;
    return strikes(TCGETATTR) ? -1 : 0;
}

int __wrap_cfsetspeed(struct termios *line, speed_t speed)
{
    return strikes(CFSETSPEED) ? -1 : __real_cfsetspeed(line, speed);
}

int __wrap_tcsetattr(int fd, int when, const struct termios *line)
{
    (void)fd;
    TEST_ASSERT_EQUAL(TCSANOW, when);
    after = *line;
    return strikes(TCSETATTR) ? -1 : 0;
}

void *__wrap_calloc(size_t count, size_t size)
{
    return strikes(CALLOC) ? NULL : __real_calloc(count, size);
}

/* Which may have trouble of its own. */
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

/* What the next thing that is opened will have. */
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

TEST(bytes_pass_as_they_are_however_the_line_was_set)
{
    TEST_ASSERT_EQUAL_INT(0, open_line("slcan:/dev/ptmx"));
    assert_raw();
    link_close(link_opened);
    before.c_iflag = before.c_oflag = before.c_cflag = before.c_lflag = (tcflag_t)~0u;
    TEST_ASSERT_EQUAL_INT(0, open_line("slcan:/dev/ptmx"));
    assert_raw();
}

TEST(no_modem_is_asked_for_its_consent)
{
    TEST_ASSERT_EQUAL_INT(0, open_line("slcan:/dev/ptmx"));
    TEST_ASSERT_EQUAL_HEX(CLOCAL | CREAD, after.c_cflag & (CLOCAL | CREAD | CRTSCTS));
    link_close(link_opened);
    before.c_cflag = (tcflag_t)~0u;
    TEST_ASSERT_EQUAL_INT(0, open_line("slcan:/dev/ptmx"));
    TEST_ASSERT_EQUAL_HEX(CLOCAL | CREAD, after.c_cflag & (CLOCAL | CREAD | CRTSCTS));
}

TEST(each_speed_can_be_named)
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

TEST(the_line_is_read_and_written_without_waiting_and_not_inherited)
{
    int fd = free_descriptor();
    TEST_ASSERT_EQUAL_INT(0, link_open(&link_opened, "slcan:/dev/ptmx", NULL, 0));
    TEST_ASSERT_EQUAL_HEX(O_RDWR | O_NONBLOCK, fcntl(fd, F_GETFL) & (O_ACCMODE | O_NONBLOCK));
    TEST_ASSERT_EQUAL_HEX(FD_CLOEXEC, fcntl(fd, F_GETFD));
}

TEST(without_standard_input_it_opens_as_well)
{
    int input = dup(STDIN_FILENO);
    close(STDIN_FILENO);
    TEST_ASSERT_EQUAL_INT(0, link_open(&link_opened, "slcan:/dev/ptmx", NULL, 0));
    link_close(link_opened);
    link_opened = NULL;
    TEST_ASSERT_EQUAL_INT(STDIN_FILENO, dup2(input, STDIN_FILENO));
    close(input);
}

TEST(what_refuses_the_line_is_said_and_nothing_stays_open)
{
    int count = open_descriptors();
    for (refused = TCGETATTR; refused <= CALLOC; refused++) {
        TEST_ASSERT_EQUAL_INT(LINK_E_OPEN, open_line("slcan:/dev/ptmx"));
        TEST_ASSERT_NULL(link_opened);
        TEST_ASSERT_EQUAL_STRING("link slcan:/dev/ptmx: Input/output error\n", said);
        TEST_ASSERT_EQUAL_INT(count, open_descriptors());
    }
}

TEST(a_line_that_is_not_there_is_refused_with_the_reason)
{
    TEST_ASSERT_EQUAL_INT(LINK_E_OPEN, open_line("slcan:/no/such/line"));
    TEST_ASSERT_EQUAL_STRING("link slcan:/no/such/line: No such file or directory\n", said);
}

/* Slashes beside each other are as one. */
TEST(a_path_may_have_any_length_that_the_system_knows)
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
