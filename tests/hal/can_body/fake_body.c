#include "fake_body.h"

#include <string.h>

#include "tests/hal/protocol/wire_frames.h"

struct fake fake;
struct hal *hal;
struct input in;

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

int open_body(void)
{
    return hal_open(&hal, 0, NULL);
}

void setUp(void)
{
    memset(&fake, 0, sizeof fake);
    fake.bus.state = BUS_ACTIVE;
    TEST_ASSERT_EQUAL(0, open_body());
}

void script_event(uint32_t at_ms, int result, struct frame frame)
{
    TEST_ASSERT_LESS_THAN_UINT(SCRIPT_MAX, fake.events);
    fake.script[fake.events++] = (struct event){.at_ms = at_ms, .result = result, .frame = frame};
}

void script_senses(uint32_t at_ms, unsigned ticks)
{
    script_event(at_ms, 1, senses_frame(NODE, ticks));
}

void script_command(uint32_t at_ms, struct octet_command_t command)
{
    script_event(at_ms, 1, command_frame(command));
}

void script_noise(uint32_t at_ms)
{
    script_event(at_ms, 1, (struct frame){.id = 0x7FF});
}

int receive(void)
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

struct octet_faults_t faults(void)
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

void assert_faults(struct octet_faults_t expected)
{
    const struct octet_faults_t actual = faults();

    TEST_ASSERT_EQUAL_MEMORY(&expected, &actual, sizeof actual);
}
