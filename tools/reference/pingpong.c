/* Frames there and back, and nothing else: the fastest that two processes can take turns on a link.
 *
 * octet-pingpong echo LINK         sends back what comes, until the link closes
 * octet-pingpong ping LINK COUNT   sends COUNT frames, waits for each to return, prints microseconds a round trip */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "hal/link/link.h"

enum { WAIT_MS = 5000 };

static const uint16_t PING_ID = 0x0C1, PONG_ID = 0x081;

static int echo(const char *name)
{
    struct link *link;
    struct frame frame;
    int result = link_open(&link, name, &PING_ID, 1);

    if (result < 0)
        return 1;
    puts("listens");
    fflush(stdout);
    while (result >= 0) {
        result = link_receive(link, &frame, WAIT_MS);
        frame.id = PONG_ID;
        if (result == 1)
            result = link_send(link, &frame);
    }
    link_close(link);
    return result == LINK_E_CLOSED ? 0 : 1;
}

static double now_s(void)
{
    struct timespec now;

    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

static int ping(const char *name, long count)
{
    struct link *link;
    struct frame frame = {.id = PING_ID, .len = 8};
    double began;

    if (link_open(&link, name, &PONG_ID, 1) < 0)
        return 1;
    began = now_s();
    for (long i = 0; i < count; i++) {
        frame.id = PING_ID;
        if (link_send(link, &frame) < 0 || link_receive(link, &frame, WAIT_MS) != 1) {
            fprintf(stderr, "octet-pingpong: frame %ld did not come back\n", i);
            return 1;
        }
    }
    printf("%.3f\n", (now_s() - began) * 1e6 / (double)count);
    link_close(link);
    return 0;
}

int main(int argc, char *argv[])
{
    if (argc == 3 && strcmp(argv[1], "echo") == 0)
        return echo(argv[2]);
    if (argc == 4 && strcmp(argv[1], "ping") == 0 && atol(argv[3]) > 0)
        return ping(argv[2], atol(argv[3]));
    fputs("usage: octet-pingpong echo LINK | octet-pingpong ping LINK COUNT\n", stderr);
    return 2;
}
