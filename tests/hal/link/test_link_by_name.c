#include <fcntl.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>

#include "tests/test.h"
#include "open_listening.h"

static void assert_refused(int expected, const char *name, size_t id_count)
{
    struct link *untouched = (struct link *)printed;
    struct link *link = untouched;
    TEST_ASSERT_EQUAL_INT_MESSAGE(expected, open_listening(&link, name, id_count), name);
    TEST_ASSERT_EQUAL_PTR(untouched, link);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(printed, name), printed);
    TEST_ASSERT_EQUAL_PTR_MESSAGE(printed + strlen(printed) - 1, strchr(printed, '\n'), printed);
}

TEST(unknown_link_kind_is_refused)
{
    const char *const names[] = {"", "can0", "fd", "fd:", "slcan:", "socketcan:", "udp:1", ":"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) assert_refused(LINK_E_NAME, names[i], 1);
}

TEST(unknown_link_name_prints_the_known_ones)
{
    assert_refused(LINK_E_NAME, "can0", 1);

    TEST_ASSERT_EQUAL_STRING(
        "link can0: no such kind of link; the links are socketcan:IFACE, fd:N, slcan:PATH[@BAUD]\n", printed);
}

TEST(descriptor_must_be_a_number)
{
    const char *const names[] = {"fd:x", "fd:-1", "fd:+3", "fd: 3", "fd:3x", "fd:3a", "fd:3\xC3",
                                 "fd:2147483648", "fd:99999999999999999999"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        assert_refused(LINK_E_NAME, names[i], 1);
        TEST_ASSERT_NOT_NULL_MESSAGE(strstr(printed, "not the number of a file descriptor"), printed);
    }
}

TEST(descriptor_must_be_open)
{
    assert_refused(LINK_E_OPEN, "fd:987", 1);

    TEST_ASSERT_EQUAL_STRING("link fd:987: Bad file descriptor\n", printed);
    assert_refused(LINK_E_OPEN, "fd:2147483647", 1);
}

static void assert_descriptor_refused(int fd)
{
    char name[16];
    snprintf(name, sizeof name, "fd:%d", fd);
    assert_refused(LINK_E_OPEN, name, 1);
    TEST_ASSERT_EQUAL_INT(0, close(fd));   /* still ours */
}

TEST(descriptor_0_is_a_number)
{
    assert_refused(LINK_E_OPEN, "fd:0", 1);   /* standard input is no socket of whole frames */
}

TEST(descriptor_must_be_a_packet_socket)
{
    assert_descriptor_refused(open("/dev/null", O_RDWR));
    assert_descriptor_refused(socket(AF_UNIX, SOCK_STREAM, 0));
    assert_descriptor_refused(socket(AF_UNIX, SOCK_DGRAM, 0));
}

TEST(path_must_be_a_terminal)
{
    assert_refused(LINK_E_OPEN, "slcan:/no/such/line", 1);
    assert_refused(LINK_E_OPEN, "slcan:/dev/null", 1);
    assert_refused(LINK_E_OPEN, "slcan:@115200", 1);
}

TEST(baud_rate_must_be_a_standard_one)
{
    assert_refused(LINK_E_NAME, "slcan:/dev/ptmx@115201", 1);
    assert_refused(LINK_E_NAME, "slcan:/dev/ptmx@", 1);
    TEST_ASSERT_NOT_NULL_MESSAGE(strstr(printed, "no such speed of a serial line"), printed);
}

TEST(terminal_opens_with_a_baud_rate)
{
    struct link *link = NULL;

    TEST_ASSERT_EQUAL_INT(0, open_listening(&link, "slcan:/dev/ptmx@9600", 1));
    TEST_ASSERT_EQUAL_STRING("", printed);
    link_close(link);
}

TEST(overlong_path_is_refused)
{
    char name[PATH_MAX + 10] = "slcan:";
    memset(name + strlen(name), 'x', PATH_MAX + 3);

    assert_refused(LINK_E_NAME, name, 1);
}

TEST(interface_must_exist)
{
    assert_refused(LINK_E_OPEN, "socketcan:nosuch0", 1);
}

TEST(too_many_identifiers_are_refused)
{
    assert_refused(LINK_E_OPEN, "fd:987", LINK_IDS_MAX + 1);

    TEST_ASSERT_EQUAL_STRING("link fd:987: too many identifiers to listen for\n", printed);
}

TEST(path_may_begin_with_any_byte)
{
    assert_refused(LINK_E_OPEN, "slcan:\xC3\xA4", 1);
}

TEST(link_name_without_a_channel_is_refused)
{
    assert_refused(LINK_E_NAME, "slcan:", 1);
    TEST_ASSERT_NOT_NULL(strstr(printed, "nothing after the colon"));
}

TEST(maximum_number_of_identifiers_is_accepted)
{
    struct link *link = NULL;

    TEST_ASSERT_EQUAL_INT(0, open_listening(&link, "slcan:/dev/ptmx@9600", LINK_IDS_MAX));
    link_close(link);
}
