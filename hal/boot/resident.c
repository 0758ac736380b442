/* What an image has to do with the boot loader that started it: its number, a word that it runs, and the way back. */
#include <string.h>

#include "hal/boot/handover.h"
#include "hal/boot/image.h"
#include "hal/boot/server.h"
#include "hal/boot/uds_parts.h"
#include "hal/port/cortex_m/leave.h"
#include "hal/port/cortex_m/loader.h"
#include "hal/port/cortex_m/systick.h"

enum {
    CONFIRM_MS = 5000,            /* without a crash */
    PROGRAMMING = 2, QUIET = 0x80,
    DID_VERSION = 0xFD02, DID_RUNNING = 0xFD03,
    SINGLE_MAX = 7
};

static struct {
    struct choices choices;
    uint16_t id;
    uint8_t node;
    bool trial;          /* until it is confirmed, or could not be */
    bool heard;          /* a tester */
    bool leaving;
    uint32_t leaving_ms;
} resident;              /* there is one, and those who ask have nowhere to keep it */

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

/* Senses come, or a tester has had an answer: so the bus works. */
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

static uint8_t refuse(uint8_t service, enum nrc why, uint8_t *out)
{
    out[0] = NEGATIVE;
    out[1] = service;
    out[2] = (uint8_t)why;
    return 3;
}

/* The boot loader answers once it runs. */
static uint8_t control_session(uint8_t session, bool at_rest, uint8_t *out)
{
    static const uint8_t usual[] = {SESSION_CONTROL | POSITIVE, 1, 0, 50, 1, 0xF4};

    if (session == PROGRAMMING) {
        resident.leaving = at_rest;
        resident.leaving_ms = machine_ms();
        return refuse(SESSION_CONTROL, at_rest ? NRC_PENDING : NRC_CONDITIONS, out);
    }
    memcpy(out, usual, sizeof usual);
    return sizeof usual;
}

static uint8_t read(unsigned id, uint8_t *out)
{
    const struct choice *now = &resident.choices.now;
    uint32_t value = id == DID_VERSION ? image_version(now->slot) : (uint32_t)now->slot << 24 | (now->trial ? 1u : 0u) << 16;

    if (id != DID_VERSION && id != DID_RUNNING)
        return refuse(READ, NRC_SESSION, out);
    out[0] = READ | POSITIVE;
    out[1] = (uint8_t)(id >> 8);
    out[2] = (uint8_t)id;
    for (unsigned i = 0; i < 4; i++)
        out[3 + i] = (uint8_t)(value >> (24 - 8 * i));
    return SINGLE_MAX;
}

static uint8_t serve(const uint8_t *request, uint8_t len, bool at_rest, uint8_t *out)
{
    if (request[0] == SESSION_CONTROL && len == 2)
        return control_session(request[1] & (uint8_t)~QUIET, at_rest, out);
    if (request[0] == READ && len == 3)
        return read((unsigned)request[1] << 8 | request[2], out);
    if (request[0] == TESTER_PRESENT && len == 2) {
        out[0] = TESTER_PRESENT | POSITIVE;
        out[1] = 0;
        return request[1] & QUIET ? 0 : 2;
    }
    return refuse(request[0], NRC_SESSION, out);
}

bool loader_frame(const struct frame *frame, bool at_rest, struct frame *answer)
{
    uint8_t len = frame->data[0];
    uint8_t size;

    if (len == 0 || len > SINGLE_MAX || len >= frame->len)
        return false;
    resident.heard = true;
    *answer = (struct frame){.id = (uint16_t)(UPDATE_ANSWER_ID + resident.node), .len = 8};
    size = serve(&frame->data[1], len, at_rest, &answer->data[1]);
    answer->data[0] = size;
    return size > 0;
}
