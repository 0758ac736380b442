/* Opening sockets, the identifier filters of a CAN interface, and errors of both. Interface and kernel are fakes. */
#include <errno.h>
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/test.h"
#include "open_listening.h"

enum call { NONE, SOCKET, IF_NAMETOINDEX, SETSOCKOPT, BIND, CALLOC, FCNTL };
enum { INTERFACE = 7 };

static struct can_filter filters[LINK_IDS_MAX];
static size_t filter_count;
static struct sockaddr_can bound;
static enum call refused;
static int type_of_socket;   /* for getsockopt */
static struct link *link_opened;

int __wrap_socket(int domain, int type, int protocol);
unsigned __wrap_if_nametoindex(const char *name);
int __wrap_setsockopt(int fd, int level, int name, const void *value, socklen_t size);
int __wrap_bind(int fd, const struct sockaddr *address, socklen_t size);
void *__real_calloc(size_t count, size_t size);
void *__wrap_calloc(size_t count, size_t size);
int __wrap_getsockopt(int fd, int level, int name, void *value, socklen_t *size);
int __real_fcntl(int fd, int command, ...);
int __wrap_fcntl(int fd, int command, int flags);
int __real_close(int fd);
int __wrap_close(int fd);

static bool should_fail(enum call call)
{
    if (call == refused) errno = EIO;
    return call == refused;
}

int __wrap_socket(int domain, int type, int protocol)
{
    TEST_ASSERT_EQUAL(AF_CAN, domain);
    TEST_ASSERT_EQUAL_HEX(SOCK_RAW | SOCK_CLOEXEC, type);
    TEST_ASSERT_EQUAL(CAN_RAW, protocol);
    return should_fail(SOCKET) ? -1 : dup(STDERR_FILENO);
}

unsigned __wrap_if_nametoindex(const char *name)
{
    TEST_ASSERT_EQUAL_STRING("can7", name);
    return should_fail(IF_NAMETOINDEX) ? 0 : INTERFACE;
}

/* Before bind: no unwanted frame arrives in between. */
int __wrap_setsockopt(int fd, int level, int name, const void *value, socklen_t size)
{
    (void)fd;
    TEST_ASSERT_EQUAL(0, bound.can_ifindex);
    TEST_ASSERT_EQUAL(SOL_CAN_RAW, level);
    TEST_ASSERT_EQUAL(CAN_RAW_FILTER, name);
    TEST_ASSERT_LESS_OR_EQUAL(sizeof filters, size);
    memcpy(filters, value, size);
    filter_count = size / sizeof *filters;
    return should_fail(SETSOCKOPT) ? -1 : 0;
}

int __wrap_bind(int fd, const struct sockaddr *address, socklen_t size)
{
    (void)fd;
    TEST_ASSERT_EQUAL(sizeof bound, size);
    memcpy(&bound, address, size);
    return should_fail(BIND) ? -1 : 0;
}

void *__wrap_calloc(size_t count, size_t size)
{
    return should_fail(CALLOC) ? NULL : __real_calloc(count, size);
}

int __wrap_getsockopt(int fd, int level, int name, void *value, socklen_t *size)
{
    (void)fd;
    TEST_ASSERT_EQUAL(SOL_SOCKET, level);
    TEST_ASSERT_EQUAL(SO_TYPE, name);
    TEST_ASSERT_EQUAL(sizeof type_of_socket, *size);
    memcpy(value, &type_of_socket, *size);
    return 0;
}

int __wrap_fcntl(int fd, int command, int flags)
{
    return should_fail(FCNTL) ? -1 : __real_fcntl(fd, command, flags);
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
    memset(filters, 0, sizeof filters);
    memset(&bound, 0, sizeof bound);
    filter_count = 0;
    refused = NONE;
    link_opened = NULL;
}

void tearDown(void)
{
    link_close(link_opened);
}

/* By the rule of linux/can.h: any filter that matches. */
static bool passes(canid_t id)
{
    for (size_t i = 0; i < filter_count; i++)
        if ((id & filters[i].can_mask) == (filters[i].can_id & filters[i].can_mask)) return true;
    return false;
}

TEST(socket_is_bound_to_the_named_interface)
{
    TEST_ASSERT_EQUAL_INT(0, open_listening(&link_opened, "socketcan:can7", 1));
    TEST_ASSERT_EQUAL(AF_CAN, bound.can_family);
    TEST_ASSERT_EQUAL(INTERFACE, bound.can_ifindex);
}

TEST(filter_passes_exactly_the_wanted_identifiers)
{
    static const uint16_t wanted[] = {0x000, 0x101, 0x7FF, LINK_FAMILY | 0x680};
    TEST_ASSERT_EQUAL_INT(0, link_open(&link_opened, "socketcan:can7", wanted, 4));
    for (canid_t id = 0; id <= CAN_SFF_MASK; id++) {
        bool is_wanted = id == 0x000 || id == 0x101 || id == 0x7FF || (id >= 0x680 && id <= 0x69F);
        TEST_ASSERT_EQUAL(is_wanted, passes(id));
        TEST_ASSERT_FALSE(passes(id | CAN_EFF_FLAG));
        TEST_ASSERT_FALSE(passes(id | CAN_RTR_FLAG));
    }
}

TEST(socket_opens_as_descriptor_0)
{
    int input = dup(STDIN_FILENO);
    close(STDIN_FILENO);
    TEST_ASSERT_EQUAL_INT(0, link_open(&link_opened, "socketcan:can7", NULL, 0));
    link_close(link_opened);
    link_opened = NULL;
    TEST_ASSERT_EQUAL_INT(STDIN_FILENO, dup2(input, STDIN_FILENO));
    close(input);
}

TEST(failed_socket_open_prints_the_step_and_leaks_nothing)
{
    int before = open_descriptors();
    for (refused = SOCKET; refused <= CALLOC; refused++) {
        memset(&bound, 0, sizeof bound);
        TEST_ASSERT_EQUAL_INT(LINK_E_OPEN, open_listening(&link_opened, "socketcan:can7", 1));
        TEST_ASSERT_NULL(link_opened);
        TEST_ASSERT_EQUAL_STRING("link socketcan:can7: Input/output error\n", printed);
        TEST_ASSERT_EQUAL_INT(before, open_descriptors());
    }
}

/* A descriptor that came from elsewhere: a file stands for the socket. */
static int open_descriptor(void)
{
    char name[16];
    int fd = open("/dev/null", O_RDWR | O_NONBLOCK);
    snprintf(name, sizeof name, "fd:%d", fd);
    TEST_ASSERT_EQUAL_INT(refused == NONE ? 0 : LINK_E_OPEN, open_listening(&link_opened, name, 1));
    return fd;
}

TEST(inherited_packet_socket_is_set_to_blocking)
{
    static const int types[] = {SOCK_SEQPACKET, SOCK_RAW};
    for (size_t i = 0; i < 2; i++) {
        type_of_socket = types[i];
        int fd = open_descriptor();
        TEST_ASSERT_EQUAL_HEX(0, fcntl(fd, F_GETFL, 0) & O_NONBLOCK);
        link_close(link_opened);
        link_opened = NULL;
    }
}

TEST(unusable_descriptor_is_reported_and_left_open)
{
    type_of_socket = SOCK_RAW;
    for (refused = CALLOC; refused <= FCNTL; refused++) {
        int fd = open_descriptor();
        TEST_ASSERT_NULL(link_opened);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(printed, ": Input/output error\n"), printed);
        TEST_ASSERT_EQUAL_INT(0, close(fd));
    }
}

TEST(link_close_releases_the_descriptor)
{
    int before = open_descriptors();
    TEST_ASSERT_EQUAL_INT(0, open_listening(&link_opened, "socketcan:can7", 1));
    link_close(link_opened);
    link_opened = NULL;
    TEST_ASSERT_EQUAL_INT(before, open_descriptors());
}
