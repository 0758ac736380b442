/* contract.h: what link.h promises, asked of the kind of link that the first argument names: fd, slcan, or socketcan [IFACE].
 * A part of the contract is a test program of its own. */
#ifndef OCTET_CONTRACT_H
#define OCTET_CONTRACT_H

#include <stdio.h>
#include <string.h>
#include <time.h>

#include "tests/test.h"
#include "rig.h"

enum { SOON_MS = 5000, WAIT_MS = 60, LATE_MS = 5000 };

static const struct frame HELLO = {0x123, 3, {0xAA, 0xBB, 0xCC}};
static const uint16_t WANTED[] = {0x123, 0x100, 0x101, 0x102, 0x103, 0x104};   /* what the near end listens for */
static const struct rig *rig;
static struct link *near;

static const char *interface = "vcan0";

static inline void open_near(void)
{
    char name[RIG_NAME_MAX];
    rig->open(name);
    TEST_ASSERT_EQUAL_INT(0, link_open(&near, name, WANTED, sizeof WANTED / sizeof WANTED[0]));
}

static inline void close_near(void)
{
    link_close(near);
    near = NULL;
}

/* It has one far end, which a bus has not, and a queue of its own. */
static inline bool is_pair(void)
{
    return rig != &RIG_SOCKETCAN;
}

/* Of the network: it comes and goes. */
static inline bool is_interface(void)
{
    return rig == &RIG_SOCKETCAN;
}

void setUp(void)
{
    rig_socketcan_choose(interface);
    open_near();
}

void tearDown(void)
{
    close_near();
    rig->close();
}

static inline int64_t now_ms(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (int64_t)now.tv_sec * 1000 + now.tv_nsec / 1000000;
}

static inline void assert_equal(const struct frame *expected, const struct frame *frame)
{
    TEST_ASSERT_EQUAL_HEX32(expected->id, frame->id);
    TEST_ASSERT_EQUAL_UINT8(expected->len, frame->len);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected->data, frame->data, 8);
}

/* The near end, soon. */
static inline void assert_receives(const struct frame *expected)
{
    struct frame frame;
    memset(&frame, 0xEE, sizeof frame);
    TEST_ASSERT_EQUAL_INT(1, link_receive(near, &frame, SOON_MS));
    assert_equal(expected, &frame);
}

static inline void assert_far_takes(const struct frame *expected)
{
    struct frame frame;
    TEST_ASSERT_TRUE(rig->take(&frame));
    assert_equal(expected, &frame);
}

/* The near end receives nothing for that long. */
static inline void assert_silent_for(uint32_t wait_ms)
{
    struct frame frame;
    int64_t start = now_ms();
    TEST_ASSERT_EQUAL_INT(0, link_receive(near, &frame, wait_ms));
    int64_t took = now_ms() - start;
    TEST_ASSERT_TRUE(took >= (int64_t)wait_ms);
    TEST_ASSERT_TRUE(took < (int64_t)wait_ms + LATE_MS);
}

static const struct rig *find_rig(const char *kind)
{
    const struct rig *const rigs[] = {&RIG_FD, &RIG_SLCAN, &RIG_SOCKETCAN};
    for (int i = 0; i < 3; i++)
        if (strcmp(kind, rigs[i]->kind) == 0) return rigs[i];
    return NULL;
}

int main(int argc, char *argv[])
{
    rig = find_rig(argc > 1 ? argv[1] : "");
    if (rig == NULL) {
        fprintf(stderr, "usage: %s fd|slcan|socketcan [IFACE]\n", argv[0]);
        return 2;
    }
    if (argc > 2) interface = argv[2];
    return tests_run();
}

#endif
