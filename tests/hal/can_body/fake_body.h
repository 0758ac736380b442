/* fake_body.h: the CAN body between a fake link, which plays a script and fails at a given call, and a fake port. The clock
 * moves only while the link waits. */
#ifndef OCTET_FAKE_BODY_H
#define OCTET_FAKE_BODY_H

#include <string.h>

#include "tests/test.h"
#include "hal/can_body/port.h"
#include "hal/protocol/wire.h"
#include "tests/hal/protocol/wire_frames.h"
#include "octet.h"

enum { NODE = 1, SCRIPT_MAX = 64, SENT_MAX = 256, NEVER = 0, FRAMES = WIRE_FRAMES_MAX - 2 /* no crash, no fault */ };

/* What the fake link does, in order: at a time, a result of link_receive, with a frame if that is 1. */
struct event {
    uint32_t at_ms;
    int result;
    struct frame frame;
};

/* The fake link and the fake port. Time begins at 0 and passes only while the link waits. */
struct fake {
    uint32_t clock_ms;
    struct event script[SCRIPT_MAX];
    unsigned events, next;
    unsigned receives, failing_receive;   /* link_receive fails at this call, counted from 1 */
    unsigned sends, failing_send;
    int failure;
    bool closed;
    struct frame sent[SENT_MAX];
    int open_result, port_result, store_result;
    int argc;                             /* what the port was opened with */
    char *const *argv;
    bool needs_rest;                      /* to store anything */
    unsigned stores;                      /* that were not put off */
    uint8_t stored[CELL_COUNT];           /* by the last of them */
    bool endless;                         /* the next event repeats without end */
    enum reset_cause reset_cause;
    const struct crash *crash;
    bool clock_exact;
    unsigned ready_calls;                 /* of port_ready */
    struct link_health bus;
    unsigned health_reads;
    uint32_t alive_ms, longest_wait_ms;   /* without a sign of life */
    uint16_t ids[WIRE_LISTEN_COUNT];
    size_t id_count;
};

static struct fake fake;
static struct hal *hal;   /* the body, open */
static struct input in;   /* what receive took */

/* ---- the fake port */

int port_open(struct port *port, int argc, char *const argv[])
{
    fake.argc = argc;
    fake.argv = argv;
    *port = (struct port){.link = "fake", .node = NODE, .reset_cause = fake.reset_cause, .crash = fake.crash,
                          .clock_exact = fake.clock_exact};
    return fake.port_result;
}

void port_ready(const struct port *port)
{
    TEST_ASSERT_EQUAL_UINT8(NODE, port->node);
    fake.ready_calls++;
}

uint32_t port_clock_ms(void)
{
    return UINT32_MAX - 50 + fake.clock_ms;   /* wraps within each test */
}

int port_load(uint8_t memory[CELL_COUNT])
{
    memory[1] = 2;
    return fake.store_result;
}

void port_alive(bool outage)
{
    const uint32_t waited_ms = fake.clock_ms - fake.alive_ms;

    (void)outage;
    if (waited_ms > fake.longest_wait_ms)
        fake.longest_wait_ms = waited_ms;
    fake.alive_ms = fake.clock_ms;
}

int port_store(const uint8_t memory[CELL_COUNT], enum port_effort effort)
{
    TEST_ASSERT_EQUAL_UINT8(2, memory[1]);
    if (fake.needs_rest && effort != PORT_AT_REST)
        return PORT_LATER;
    fake.stores++;
    memcpy(fake.stored, memory, sizeof fake.stored);
    return fake.store_result;
}

uint32_t port_entropy(void)
{
    return 0xC0FFEE;
}

/* ---- the fake link */

int link_open(struct link **link, const char *name, const uint16_t ids[], size_t id_count)
{
    TEST_ASSERT_EQUAL_STRING("fake", name);
    TEST_ASSERT_LESS_OR_EQUAL_size_t(WIRE_LISTEN_COUNT + 1, id_count);
    fake.id_count = id_count;
    memcpy(fake.ids, ids, id_count * sizeof *ids);
    *link = NULL;
    return fake.open_result;
}

static int failed(uint32_t wait_ms)
{
    fake.closed = fake.failure == LINK_E_CLOSED;
    if (fake.failure == LINK_E_DOWN)
        fake.clock_ms += wait_ms;
    return fake.failure;
}

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    const struct event *event = &fake.script[fake.next];

    (void)link;
    fake.receives++;
    if (fake.closed)
        return LINK_E_CLOSED;
    if (fake.receives == fake.failing_receive)
        return failed(wait_ms);
    if (fake.next == fake.events || (int32_t)(event->at_ms - fake.clock_ms) > (int32_t)wait_ms) {
        fake.clock_ms += wait_ms;
        return 0;
    }
    fake.next += !fake.endless;
    if ((int32_t)(event->at_ms - fake.clock_ms) > 0)
        fake.clock_ms = event->at_ms;
    *out = event->frame;
    return event->result;
}

int link_send(struct link *link, const struct frame *frame)
{
    (void)link;
    if (fake.closed)
        return LINK_E_CLOSED;
    if (fake.sends + 1 == fake.failing_send) {
        fake.sends++;
        return failed(0);
    }
    TEST_ASSERT_LESS_THAN_UINT(SENT_MAX, fake.sends);
    fake.sent[fake.sends++] = *frame;
    return 0;
}

void link_health(const struct link *link, struct link_health *out)
{
    (void)link;
    fake.health_reads++;
    *out = fake.bus;
}

/* Opens the body again; result of hal_open. */
static inline int open_body(void)
{
    return hal_open(&hal, 0, NULL);
}

void setUp(void)
{
    memset(&fake, 0, sizeof fake);
    fake.bus.state = BUS_ACTIVE;
    TEST_ASSERT_EQUAL(0, open_body());
}

/* Append an event to the script. */
static inline void script_event(uint32_t at_ms, int result, struct frame frame)
{
    TEST_ASSERT_LESS_THAN_UINT(SCRIPT_MAX, fake.events);
    fake.script[fake.events++] = (struct event){.at_ms = at_ms, .result = result, .frame = frame};
}

static inline void script_senses(uint32_t at_ms, unsigned ticks)
{
    script_event(at_ms, 1, senses_frame(NODE, ticks));
}

static inline void script_command(uint32_t at_ms, struct octet_command_t command)
{
    script_event(at_ms, 1, command_frame(command));
}

static inline void script_noise(uint32_t at_ms)
{
    script_event(at_ms, 1, (struct frame){.id = 0x7FF});
}

/* hal_receive into `in`. */
static inline int receive(void)
{
    return hal_receive(hal, &in);
}

static const struct frame *sent(uint32_t id, unsigned half)
{
    for (unsigned i = fake.sends; i-- > 0;)
        if (fake.sent[i].id == id && fake.sent[i].data[1] >> 4 == half)
            return &fake.sent[i];
    TEST_FAIL_MESSAGE("it was not sent");
    return NULL;
}

/* The fault counters that the robot reports; from here on no send fails. */
static inline struct octet_faults_t faults(void)
{
    const struct output out = {.has_report = true, .whole_report = true};
    struct octet_faults_t reported;

    fake.failing_send = NEVER;
    TEST_ASSERT_EQUAL(0, hal_send(hal, &out));
    for (unsigned page = 0; page < 2; page++)
        TEST_ASSERT_EQUAL(0, octet_faults_unpack(&reported, sent(OCTET_FAULTS_FRAME_ID, page)->data, OCTET_FAULTS_LENGTH));
    reported.crc = reported.counter = reported.page = 0;
    return reported;
}

/* The robot reports exactly these. */
static inline void assert_faults(struct octet_faults_t expected)
{
    const struct octet_faults_t actual = faults();

    TEST_ASSERT_EQUAL_MEMORY(&expected, &actual, sizeof actual);
}

#endif
