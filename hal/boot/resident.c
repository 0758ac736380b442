/* An image's side of the boot loader that started it: node number, confirmation that it works, and the way back. */
#include "hal/boot/handover.h"
#include "hal/boot/image.h"
#include "hal/boot/server.h"
#include "hal/boot/uds_parts.h"
#include "hal/port/cortex_m/leave.h"
#include "hal/port/cortex_m/loader.h"
#include "hal/port/cortex_m/systick.h"

enum {
    CONFIRM_MS = 5000,            /* without a crash */
    DID_VERSION = 0xFD02, DID_RUNNING = 0xFD03,
    SINGLE_MAX = 7
};

static struct {
    struct choices choices;
    uint16_t id;
    uint8_t node;
    bool trial;          /* until it is confirmed, or confirmation has failed */
    bool heard;          /* a tester was heard */
    bool leaving;
    uint32_t leaving_ms;
} resident;              /* static, since the callers have no place for it */

uint8_t loader_node(uint8_t built)
{
    (void)choices_open(&resident.choices, LAYOUT.choice_page);
    resident.trial = resident.choices.now.trial;
    resident.heard = resident.leaving = false;
    resident.node = resident.choices.now.node != 0 ? resident.choices.now.node : built;
    resident.id = (uint16_t)(UPDATE_REQUEST_ID + resident.node);
    return resident.node;
}

const char *loader_link(void)
{
    return choice_link(&resident.choices.now);
}

uint16_t loader_id(void)
{
    return resident.id;
}

static void confirm(void)
{
    const struct choice *now = &resident.choices.now;
    struct choice next = choice_confirmed(now, image_version(now->slot));

    resident.trial = choices_save(&resident.choices, &next, false) == FLASH_STORE_LATER;
}

/* The bus works: senses arrive, or a tester was answered. */
void loader_alive(bool outage)
{
    uint32_t now_ms = machine_ms();

    if (resident.trial && now_ms >= CONFIRM_MS && (!outage || resident.heard))
        confirm();
    if (resident.leaving && now_ms - resident.leaving_ms >= SERVER_LAST_MS) {
        handover_ask();
        leave_by_reset();
    }
}

/* The services of a programming session are in the boot loader. */
static const struct entry ENTRIES[] = {
    {SESSION_CONTROL, 2, FUNCTION_1 | FUNCTION_2, EXACT}, {READ, 3, 0, EXACT}, {TESTER_PRESENT, 2, FUNCTION_0, EXACT},
    {RESET, 0, 0, PROGRAMMING}, {SECURITY, 0, 0, PROGRAMMING}, {WRITE, 0, 0, PROGRAMMING},
    {ROUTINE, 0, 0, PROGRAMMING}, {DOWNLOAD, 0, 0, PROGRAMMING}, {TRANSFER, 0, 0, PROGRAMMING},
    {TRANSFER_EXIT, 0, 0, PROGRAMMING},
};

/* A request for a programming session is answered by the boot loader once it runs. */
static enum nrc control_session(bool at_rest, struct exchange *exchange)
{
    if (exchange->function == PROGRAMMING_SESSION) {
        resident.leaving = at_rest;
        resident.leaving_ms = machine_ms();
        return at_rest ? NRC_PENDING : NRC_CONDITIONS;
    }
    uds_put_times(exchange);
    return NRC_NONE;
}

static enum nrc read(struct exchange *exchange)
{
    const struct choice *now = &resident.choices.now;
    unsigned id = (unsigned)exchange->request[1] << 8 | exchange->request[2];

    uds_put(exchange, id, ID_LEN);
    switch (id) {
    case DID_SESSION: uds_put(exchange, DEFAULT_SESSION, 1); return NRC_NONE;
    case DID_VERSION: uds_put(exchange, image_version(now->slot), 4); return NRC_NONE;
    case DID_RUNNING: uds_put(exchange, (uint32_t)now->slot << 24 | (now->trial ? 1u : 0u) << 16, 4); return NRC_NONE;
    default: return NRC_RANGE;
    }
}

static enum nrc serve(bool at_rest, struct exchange *exchange)
{
    switch (exchange->request[0]) {
    case SESSION_CONTROL: return control_session(at_rest, exchange);
    case READ: return read(exchange);
    default: return NRC_NONE;   /* tester present */
    }
}

bool loader_frame(const struct frame *frame, bool at_rest, struct frame *answer)
{
    uint8_t len = frame->data[0];
    enum nrc why;
    struct exchange exchange = {.request = &frame->data[1], .len = len, .answer = &answer->data[1]};

    if (len == 0 || len > SINGLE_MAX || len >= frame->len)
        return false;
    resident.heard = true;
    *answer = (struct frame){.id = (uint16_t)(UPDATE_ANSWER_ID + resident.node), .len = 8};
    why = uds_admit(ENTRIES, &ENTRIES[sizeof ENTRIES / sizeof ENTRIES[0]], 0, &exchange);
    answer->data[0] = (uint8_t)uds_answer(&exchange, why == NRC_NONE ? serve(at_rest, &exchange) : why);
    return answer->data[0] > 0;
}
