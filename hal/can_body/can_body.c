/* The body at the far end of a CAN link: hal.h on link.h. */
#include "hal/can_body/port.h"
#include "hal/protocol/wire.h"

enum {
    DRAIN_MAX = 4096,     /* frames looked at to find the newest senses: more than any queue holds */
    LAPSE_SILENCES = 10   /* a lockstep's owner may pause; after this many silences another may take over */
};

struct hal {
    struct link *link;
    struct wire wire;
    uint32_t heard_ms;   /* when senses last came, or silence was last reported */
    uint32_t silent_ms;  /* time since then, updated after each wait */
    unsigned silences;   /* consecutive; stays at LAPSE_SILENCES */
    bool outage;         /* the senses have stopped arriving */
    bool announced;      /* boot has been sent */
    struct frame boot;
    struct frame frames[WIRE_FRAMES_MAX];   /* to be sent */
    bool unstored;       /* storing memory was put off */
    uint8_t memory[CELL_COUNT];
};

static int receive_frame(struct hal *hal, struct frame *frame, uint32_t wait_ms)
{
    int result = link_receive(hal->link, frame, wait_ms);

    if (result == LINK_E_GARBLED)
        wire_count(&hal->wire, FAULT_DAMAGED);
    return result;
}

/* Failures to send are not faults here: a bus takes a while to come up, and may have no other node yet. */
static void announce(struct hal *hal)
{
    if (!hal->announced)
        hal->announced = link_send(hal->link, &hal->boot) == 0;
}

int hal_open(struct hal **hal, int argc, char *const argv[])
{
    static struct hal body;   /* one per program: main does not know its size */
    struct port port;
    uint16_t ids[WIRE_LISTEN_COUNT];
    int result = port_open(&port, argc, argv);

    if (result < 0)
        return result;
    wire_init(&body.wire, port.node);
    body.wire.health.reset_cause = port.reset_cause;
    body.wire.health.crash = port.crash;
    body.wire.health.clock_exact = port.clock_exact;
    wire_ids(&body.wire, ids);
    result = link_open(&body.link, port.link, ids, WIRE_LISTEN_COUNT);
    if (result < 0)
        return result == LINK_E_NAME ? HAL_E_USAGE : HAL_E_BODY;
    body.heard_ms = port_clock_ms();
    body.silent_ms = 0;
    body.silences = 0;
    body.outage = false;
    wire_boot(&body.wire, &body.boot);
    body.announced = false;
    port_ready(&port);
    *hal = &body;
    return 0;
}

static int counted(struct hal *hal, int result)
{
    if (result == HAL_E_STORE)
        wire_count(&hal->wire, FAULT_UNSAVED);
    return result;
}

/* Counts a failure to store; a postponed store remains pending. */
static int stored(struct hal *hal, int result)
{
    hal->unstored = hal->wire.health.unstored = result == PORT_LATER;
    return counted(hal, hal->unstored ? 0 : result);
}

/* In lockstep, silence is not a fault, and nothing is skipped: the sender may pause. */
static void note_silence(struct hal *hal)
{
    if (hal->silences < LAPSE_SILENCES)
        hal->silences++;
    if (!hal->wire.session.lockstep)
        hal->outage = true;
    if (hal->outage || hal->silences == LAPSE_SILENCES)
        wire_outage(&hal->wire);
}

/* The wheels are at rest and no answer is awaited, so slow work is done here. */
static int report_silence(struct hal *hal)
{
    note_silence(hal);
    if (hal->unstored)
        (void)stored(hal, port_store(hal->memory, PORT_AT_REST));
    hal->heard_ms = port_clock_ms();
    hal->silent_ms = 0;
    return INPUT_SILENCE;
}

/* A repeated command is answered as before; it is not a new input. */
static enum input_kind read_frame(struct hal *hal, const struct frame *frame, struct input *in)
{
    enum input_kind kind = wire_read(&hal->wire, frame, in);

    if (hal->wire.again && link_send(hal->link, hal->wire.again) < 0)
        wire_count(&hal->wire, FAULT_UNSENT);
    return kind;
}

/* After an outage the queue holds stale senses, of which only the newest count. A command among them takes priority;
 * senses before it are discarded. */
static int take_newest(struct hal *hal, struct input *in)
{
    struct frame frame;
    int result = LINK_E_GARBLED;

    for (unsigned i = 0; i < DRAIN_MAX && (result == 1 || result == LINK_E_GARBLED); i++) {
        enum input_kind kind = INPUT_SILENCE;

        hal->wire.session.knows_tick = false;   /* the sender may have restarted its count meanwhile */
        result = receive_frame(hal, &frame, 0);
        if (result == 1)
            kind = read_frame(hal, &frame, in);
        if (kind == INPUT_SENSES || kind == INPUT_COMMAND)
            wire_count(&hal->wire, FAULT_STALE);   /* the discarded senses */
        if (kind == INPUT_COMMAND)
            return INPUT_COMMAND;
    }
    return INPUT_SENSES;
}

static int take_senses(struct hal *hal, struct input *in)
{
    int result = INPUT_SENSES;

    /* If the robot itself stalled, senses are queued and no silence was reported yet. */
    if (hal->silent_ms >= HAL_SILENCE_MS && !hal->outage)
        note_silence(hal);
    if (hal->outage && !hal->wire.session.lockstep)
        result = take_newest(hal, in);
    if (result == INPUT_SENSES) {
        hal->outage = false;
        hal->silences = 0;
        hal->heard_ms += hal->silent_ms;
        hal->silent_ms = 0;
    }
    return result;
}

/* Waits for one frame. Returns the robot's input in it, or INPUT_SILENCE. */
static int receive_input(struct hal *hal, struct input *in, uint32_t wait_ms)
{
    struct frame frame;
    int result = receive_frame(hal, &frame, wait_ms);
    enum input_kind kind;

    hal->silent_ms = port_clock_ms() - hal->heard_ms;
    if (result != 1)
        return result == LINK_E_CLOSED ? (int)HAL_E_CLOSED : (int)INPUT_SILENCE;
    announce(hal);   /* before the answer */
    kind = read_frame(hal, &frame, in);
    return kind == INPUT_SENSES ? take_senses(hal, in) : (int)kind;
}

int hal_receive(struct hal *hal, struct input *in)
{
    int result = INPUT_SILENCE;

    while (result == INPUT_SILENCE) {
        if (hal->silent_ms >= HAL_SILENCE_MS)
            return report_silence(hal);
        port_alive(hal->outage);
        announce(hal);
        result = receive_input(hal, in, HAL_SILENCE_MS - hal->silent_ms);
    }
    return result;
}

int hal_send(struct hal *hal, const struct output *out)
{
    size_t count;

    if (out->has_report)
        link_health(hal->link, &hal->wire.health.bus);
    count = wire_write(&hal->wire, out, hal->frames);
    for (size_t i = 0; i < count; i++) {
        int result = link_send(hal->link, &hal->frames[i]);

        if (result == LINK_E_CLOSED)
            return HAL_E_CLOSED;
        if (result < 0)
            wire_count(&hal->wire, FAULT_UNSENT);
    }
    return 0;
}

int hal_load(struct hal *hal, uint8_t memory[CELL_COUNT])
{
    return counted(hal, port_load(memory));
}

int hal_store(struct hal *hal, const uint8_t memory[CELL_COUNT], bool at_rest)
{
    for (unsigned p = 0; p < CELL_COUNT; p++)
        hal->memory[p] = memory[p];
    return stored(hal, port_store(memory, at_rest ? PORT_AT_REST : PORT_QUICKLY));
}

uint32_t hal_entropy(struct hal *hal)
{
    (void)hal;
    return port_entropy();
}
