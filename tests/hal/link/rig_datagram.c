/* The far ends that speak in datagrams of one struct can_frame. */
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <stdio.h>
#include <string.h>
#include <sys/socket.h>
#include <unistd.h>
#include <unity.h>

#include "rig.h"

static int far = -1;
static const char *can_interface = "vcan0";

void rig_socketcan_choose(const char *interface)
{
    can_interface = interface;
}

static void open_fd(char name[RIG_NAME_MAX])
{
    int ends[2];
    TEST_ASSERT_EQUAL_INT(0, socketpair(AF_UNIX, SOCK_SEQPACKET, 0, ends));
    far = ends[0];
    snprintf(name, RIG_NAME_MAX, "fd:%d", ends[1]);
}

static void open_socketcan(char name[RIG_NAME_MAX])
{
    struct sockaddr_can address = {.can_family = AF_CAN, .can_ifindex = (int)if_nametoindex(can_interface)};
    TEST_ASSERT_NOT_EQUAL_INT_MESSAGE(0, address.can_ifindex, "no such CAN interface");
    far = socket(AF_CAN, SOCK_RAW, CAN_RAW);
    TEST_ASSERT_TRUE(far >= 0);
    TEST_ASSERT_EQUAL_INT(0, bind(far, (const struct sockaddr *)&address, sizeof address));
    snprintf(name, RIG_NAME_MAX, "socketcan:%s", can_interface);
}

static void put(const struct frame *frame)
{
    struct can_frame raw = {.can_id = frame->id, .len = frame->len};
    memcpy(raw.data, frame->data, sizeof raw.data);
    TEST_ASSERT_EQUAL_INT(sizeof raw, write(far, &raw, sizeof raw));
}

static bool take(struct frame *frame)
{
    struct can_frame raw;
    if (poll(&(struct pollfd){.fd = far, .events = POLLIN}, 1, 200) != 1) return false;
    TEST_ASSERT_EQUAL_INT(sizeof raw, read(far, &raw, sizeof raw));
    *frame = (struct frame){.id = raw.can_id, .len = raw.len};
    memcpy(frame->data, raw.data, sizeof raw.data);
    return true;
}

static void put_garbage(void)
{
    TEST_ASSERT_EQUAL_INT(5, write(far, "stray", 5));
}

static void close_far(void)
{
    if (far >= 0) close(far);
    far = -1;
}

const struct rig RIG_FD = {"fd", false, open_fd, put, take, put_garbage, close_far};
/* A virtual bus takes all that is sent and garbles nothing; test_socket_errors.c does that to the same code. */
const struct rig RIG_SOCKETCAN = {"socketcan", true, open_socketcan, put, take, NULL, close_far};
