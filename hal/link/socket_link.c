/* Each datagram is one struct can_frame, from a CAN interface or from the far end of a socket pair. */
#include <errno.h>
#include <fcntl.h>
#include <linux/can.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <stdlib.h>
#include <string.h>
#include <sys/socket.h>
#include <sys/time.h>
#include <unistd.h>

#include "hal/link/link_kind.h"

/* Our flags equal the kernel's, so that identifiers need no conversion. */
typedef char flags_are_the_kernels
    [FRAME_EXTENDED == CAN_EFF_FLAG && FRAME_REMOTE == CAN_RTR_FLAG && FRAME_ERROR == CAN_ERR_FLAG ? 1 : -1];

struct socket_link {
    struct link link;   /* must be first: its address is that of the whole struct */
    int fd;
    uint32_t wait_ms;   /* timeout last set in the kernel; 0: none yet */
};

static int refuse(struct link_request *request, const char *why)
{
    request->why = why;
    return LINK_E_OPEN;
}

static int wrap(struct link **link, const struct link_kind *kind, int fd)
{
    struct socket_link *made = calloc(1, sizeof *made);
    if (made == NULL)
        return -1;
    *made = (struct socket_link){.link = {kind}, .fd = fd};
    *link = &made->link;
    return 0;
}

/* Accepts exactly the wanted 11-bit identifiers, without remote frames. */
static int filter(int fd, const struct link_request *request)
{
    struct can_filter wanted[LINK_IDS_MAX];
    for (size_t i = 0; i < request->id_count; i++) {
        canid_t any = request->ids[i] & LINK_FAMILY ? LINK_FAMILY_BITS : 0;
        wanted[i] = (struct can_filter){request->ids[i] & CAN_SFF_MASK,
                                        (CAN_SFF_MASK & ~any) | CAN_EFF_FLAG | CAN_RTR_FLAG};
    }
    return setsockopt(fd, SOL_CAN_RAW, CAN_RAW_FILTER, wanted, (socklen_t)(request->id_count * sizeof wanted[0]));
}

/* Filters before binding, so that no unwanted frame arrives in between. */
static int bind_filtered(int fd, const struct link_request *request)
{
    struct sockaddr_can address = {.can_family = AF_CAN, .can_ifindex = (int)if_nametoindex(request->place)};
    if (address.can_ifindex == 0)
        return -1;
    if (filter(fd, request) != 0)
        return -1;
    return bind(fd, (const struct sockaddr *)&address, sizeof address);
}

static int open_socketcan(struct link **link, struct link_request *request)
{
    int fd = socket(AF_CAN, SOCK_RAW | SOCK_CLOEXEC, CAN_RAW);
    if (fd < 0)
        return refuse(request, strerror(errno));
    if (bind_filtered(fd, request) == 0 && wrap(link, &LINK_KIND_SOCKETCAN, fd) == 0)
        return 0;
    refuse(request, strerror(errno));
    close(fd);
    return LINK_E_OPEN;
}

static int open_fd(struct link **link, struct link_request *request)
{
    char *end;
    errno = 0;
    long fd = strtol(request->place, &end, 10);
    if (*end != '\0' || request->place[0] < '0' || errno != 0 || fd > 0x7FFFFFFF) {
        request->why = "not the number of a file descriptor";
        return LINK_E_NAME;
    }
    int type = 0;
    if (getsockopt((int)fd, SOL_SOCKET, SO_TYPE, &type, &(socklen_t){sizeof type}) != 0)
        return refuse(request, strerror(errno));
    if (type != SOCK_SEQPACKET && type != SOCK_RAW)
        return refuse(request, "neither a SOCK_SEQPACKET socket nor a raw one");
    int blocking = fcntl((int)fd, F_SETFL, 0);   /* in any case, since receive lets the kernel wait */
    if (blocking != 0)
        return refuse(request, strerror(errno));
    return wrap(link, &LINK_KIND_FD, (int)fd) == 0 ? 0 : refuse(request, strerror(errno));
}

/* A read of 0 bytes means either an empty datagram or the end. */
static int closed_or_empty(int fd)
{
    struct pollfd watch = {.fd = fd, .events = POLLRDHUP};
    return poll(&watch, 1, 0) > 0 ? LINK_E_CLOSED : LINK_E_GARBLED;
}

static int unpack(struct frame *out, const struct can_frame *raw, size_t size)
{
    if (size != sizeof *raw || raw->len > sizeof out->data)
        return LINK_E_GARBLED;
    *out = (struct frame){.id = raw->can_id, .len = raw->len};
    memcpy(out->data, raw->data, out->len);
    return 1;
}

/* One call per frame: the kernel does the waiting; its timeout is set only when it changes. */
static ssize_t receive_within(struct socket_link *socket, struct can_frame *raw, uint32_t wait_ms)
{
    if (wait_ms != 0 && wait_ms != socket->wait_ms) {
        struct timeval wait = {wait_ms / 1000, (suseconds_t)(wait_ms % 1000) * 1000};
        if (setsockopt(socket->fd, SOL_SOCKET, SO_RCVTIMEO, &wait, sizeof wait) != 0)
            return -1;
        socket->wait_ms = wait_ms;
    }
    return recv(socket->fd, raw, sizeof *raw, MSG_TRUNC | (wait_ms == 0 ? MSG_DONTWAIT : 0));
}

static int receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    struct socket_link *socket = (struct socket_link *)link;
    int64_t deadline = deadline_in_ms(wait_ms);
    uint32_t left_ms = wait_ms;
    int silence = 0;
    do {
        struct can_frame raw;
        ssize_t size = receive_within(socket, &raw, left_ms);
        if (size > 0)
            return unpack(out, &raw, (size_t)size);
        if (size == 0)
            return closed_or_empty(socket->fd);
        if (errno == ENETDOWN)
            silence = LINK_E_DOWN;   /* returned once; the bus may be back before the deadline */
        else if (errno != EINTR && errno != EAGAIN)   /* the kernel counts in its own ticks: a wait may end early */
            return LINK_E_CLOSED;
        left_ms = deadline_left_ms(deadline);
    } while (left_ms > 0);
    return silence;
}

static int send_error(int error)
{
    return error == ENETDOWN ? LINK_E_DOWN : LINK_E_CLOSED;
}

/* A full queue is retried each millisecond: poll does not report when an interface has room. */
static int send_frame(struct link *link, const struct frame *frame)
{
    int fd = ((struct socket_link *)link)->fd;
    struct can_frame raw = {.can_id = frame->id, .len = frame->len};
    memcpy(raw.data, frame->data, frame->len);
    int64_t deadline = 0;
    while (send(fd, &raw, sizeof raw, MSG_DONTWAIT | MSG_NOSIGNAL) != (ssize_t)sizeof raw) {
        if (errno != EAGAIN && errno != ENOBUFS && errno != EINTR)
            return send_error(errno);
        if (deadline == 0)   /* usually there is room, and the time is not needed */
            deadline = deadline_in_ms(LINK_SEND_MS);
        if (!deadline_pause(deadline))
            return LINK_E_FULL;
    }
    return 0;
}

static void close_socket(struct link *link)
{
    close(((struct socket_link *)link)->fd);
    free(link);
}

const struct link_kind LINK_KIND_SOCKETCAN = {"socketcan:", open_socketcan, receive, send_frame, close_socket};
const struct link_kind LINK_KIND_FD = {"fd:", open_fd, receive, send_frame, close_socket};
