/* fake_body.h: the CAN body between a fake link, which plays a script and fails at a given call, and a fake port. The clock
 * moves only while the link waits. */
#ifndef OCTET_FAKE_BODY_H
#define OCTET_FAKE_BODY_H

#include "tests/test.h"
#include "hal/can_body/port.h"
#include "hal/protocol/wire.h"
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

extern struct fake fake;
extern struct hal *hal;     /* the body, open */
extern struct input in;     /* what receive took */

int open_body(void);
        /* Opens the body again; result of hal_open. */

void script_event(uint32_t at_ms, int result, struct frame frame);
void script_senses(uint32_t at_ms, unsigned ticks);
void script_command(uint32_t at_ms, struct octet_command_t command);
void script_noise(uint32_t at_ms);
        /* Append an event to the script. */

int receive(void);
        /* hal_receive into `in`. */

struct octet_faults_t faults(void);
        /* The fault counters that the robot reports; from here on no send fails. */

void assert_faults(struct octet_faults_t expected);
        /* The robot reports exactly these. */

#endif
