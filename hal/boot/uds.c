#include "hal/boot/uds.h"

#include <string.h>

#include "hal/boot/uds_parts.h"
#include "hal/flash_store/flash.h"

enum {
    SEED = 1,
    DID_BOOT = 0xF180, DID_BOARD = 0xF191, DID_STATUS = 0xFD00, DID_WRITTEN = 0xFD01, DID_WHO = 0xFD04,
    DID_BITRATE = 0xFD05,
    KEY_SHOWN = 4                 /* bytes of the public key shown to identify it */
};

/* A tester signs this text and the challenge. No image begins with it. */
static const uint8_t PURPOSE[16] = "octet challenge";

static void put_text(struct exchange *exchange, const char *text)
{
    while (*text != '\0')
        uds_put(exchange, (uint8_t)*text++, 1);
}

void uds_begin(struct uds *uds, struct choices *choices, uint32_t now_ms)
{
    *uds = (struct uds){.choices = choices, .asked_ms = now_ms};
}

/* Resets all state of the session, except for the count of failed attempts. */
static void enter(struct uds *uds, bool programming)
{
    struct uds fresh = {
        .choices = uds->choices, .asked_ms = uds->asked_ms, .wrong_ms = uds->wrong_ms, .wrong = uds->wrong,
        .programming = programming, .why = uds->why,
    };

    *uds = fresh;
}

static enum nrc control_session(struct uds *uds, struct exchange *exchange)
{
    enter(uds, exchange->function == PROGRAMMING_SESSION);
    uds_put_times(exchange);
    return NRC_NONE;
}

/* A challenge of zeros means already unlocked. */
static enum nrc give_challenge(struct uds *uds, struct exchange *exchange)
{
    if (exchange->len != 2)
        return NRC_LENGTH;
    if (uds->wrong >= UDS_TRIES)
        return NRC_DELAY;
    memset(uds->challenge, 0, UDS_CHALLENGE);
    uds->asked = !uds->unlocked;
    if (uds->asked)
        boot_random(uds->challenge);
    for (unsigned i = 0; i < UDS_CHALLENGE; i++)
        uds_put(exchange, uds->challenge[i], 1);
    return NRC_NONE;
}

static enum nrc take_proof(struct uds *uds, const struct exchange *exchange)
{
    uint8_t text[sizeof PURPOSE + UDS_CHALLENGE];

    if (exchange->len != 2 + IMAGE_SIGNATURE)
        return NRC_LENGTH;
    if (!uds->asked)
        return NRC_SEQUENCE;
    uds->asked = false;
    memcpy(text, PURPOSE, sizeof PURPOSE);
    memcpy(&text[sizeof PURPOSE], uds->challenge, UDS_CHALLENGE);
    uds->unlocked = image_proves(&exchange->request[2], text, sizeof text);
    if (uds->unlocked) {
        uds->wrong = 0;
        return NRC_NONE;
    }
    uds->wrong_ms = uds->asked_ms;
    return ++uds->wrong < UDS_TRIES ? NRC_KEY : NRC_TRIES;
}

static uint32_t version_in(unsigned slot)
{
    struct image image;

    return image_check(slot, &image) == REFUSAL_NONE ? image.version : 0;
}

static void put_status(const struct uds *uds, struct exchange *exchange)
{
    const struct choice *now = &uds->choices->now;

    uds_put(exchange, now->installed, 1);
    uds_put(exchange, now->slot, 1);
    uds_put(exchange, now->trial ? 1u + now->starts : 0u, 1);
    uds_put(exchange, choice_free_slot(now), 1);
    uds_put(exchange, now->floor, 4);
    for (unsigned slot = 0; slot < SLOTS; slot++)
        uds_put(exchange, version_in(slot), 4);
    uds_put(exchange, LAYOUT.number, 1);
    uds_put(exchange, LAYOUT.slot_pages * flash_page_size(), 4);
    uds_put(exchange, uds->why, 1);
    uds_put(exchange, uds_number(IMAGE_SIGNER), KEY_SHOWN);
}

/* Where an interrupted update resumes: the length of the whole pages written, and their checksum. */
static void put_written(const struct uds *uds, struct exchange *exchange)
{
    uint8_t slot = choice_free_slot(&uds->choices->now);
    uint32_t end = image_written(slot);
    bool readable;
    uint32_t crc = image_crc(slot, end, &readable);

    uds_put(exchange, readable ? end : 0, 4);
    uds_put(exchange, crc, 4);
}

static enum nrc read(struct uds *uds, struct exchange *exchange)
{
    unsigned id = (unsigned)exchange->request[1] << 8 | exchange->request[2];

    uds_put(exchange, id, ID_LEN);
    switch (id) {
    case DID_BOOT: put_text(exchange, "octet boot 1"); return NRC_NONE;
    case DID_SESSION: uds_put(exchange, uds->programming ? PROGRAMMING_SESSION : DEFAULT_SESSION, 1); return NRC_NONE;
    case DID_BOARD: put_text(exchange, LAYOUT.board); return NRC_NONE;
    case DID_STATUS: put_status(uds, exchange); return NRC_NONE;
    case DID_WRITTEN: put_written(uds, exchange); return NRC_NONE;
    case DID_WHO: uds_put(exchange, uds->choices->now.node, 1); return NRC_NONE;
    case DID_BITRATE: uds_put(exchange, choice_bitrate(&uds->choices->now), 4); return NRC_NONE;
    default: return NRC_RANGE;
    }
}

/* Writes the robot's number or the bit rate of the bus, effective from the next start. */
static enum nrc write(struct uds *uds, struct exchange *exchange)
{
    struct choice next = uds->choices->now;
    const uint8_t *request = exchange->request;
    unsigned id = (unsigned)request[1] << 8 | request[2];

    if (id != DID_WHO && id != DID_BITRATE)
        return NRC_RANGE;
    if (exchange->len != 1 + ID_LEN + (id == DID_WHO ? 1 : 4))
        return NRC_LENGTH;
    if (!uds->unlocked)
        return NRC_LOCKED;
    if (id == DID_WHO)
        next.node = request[3];
    else
        next.bitrate = choice_bitrate_place(uds_number(&request[3]));
    if (next.node > NODE_MAX || next.bitrate == BITRATES)
        return NRC_RANGE;
    uds_put(exchange, id, ID_LEN);
    return choices_save(uds->choices, &next, true) == 0 ? NRC_NONE : NRC_FAILURE;
}

static const struct entry ENTRIES[] = {
    {SESSION_CONTROL, 2, FUNCTION_1 | FUNCTION_2, EXACT},
    {RESET, 2, FUNCTION_1, EXACT},
    {READ, 3, 0, EXACT},
    {SECURITY, 2, FUNCTION_1 | FUNCTION_2, PROGRAMMING},
    {WRITE, 4, 0, PROGRAMMING},
    {ROUTINE, 4, FUNCTION_1, PROGRAMMING | UNLOCKED},
    {DOWNLOAD, 11, 0, EXACT | PROGRAMMING | UNLOCKED},
    {TRANSFER, 2, 0, PROGRAMMING | UNLOCKED},
    {TRANSFER_EXIT, 1, 0, EXACT | PROGRAMMING | UNLOCKED},
    {TESTER_PRESENT, 2, FUNCTION_0, EXACT},
};

static enum nrc serve(struct uds *uds, struct exchange *exchange)
{
    switch (exchange->request[0]) {
    case SESSION_CONTROL: return control_session(uds, exchange);
    case RESET: uds->restart = true; return NRC_NONE;
    case READ: return read(uds, exchange);
    case SECURITY: return exchange->function == SEED ? give_challenge(uds, exchange) : take_proof(uds, exchange);
    case WRITE: return write(uds, exchange);
    case ROUTINE: return uds_routine(uds, exchange);
    case DOWNLOAD: return uds_download(uds, exchange);
    case TRANSFER: return uds_transfer(uds, exchange);
    case TRANSFER_EXIT: return uds_transfer_exit(uds);
    default: return NRC_NONE;   /* tester present */
    }
}

uint16_t uds_serve(struct uds *uds, const uint8_t request[], uint16_t len, uint8_t answer[UDS_ANSWER_MAX])
{
    struct exchange exchange = {.request = request, .len = len, .answer = answer};
    unsigned given = (uds->programming ? PROGRAMMING : 0u) | (uds->unlocked ? UNLOCKED : 0u);
    enum nrc why;

    if (uds->work != WORK_NONE)
        return request[0] == TESTER_PRESENT ? 0 : uds_refuse(request[0], NRC_BUSY, answer);
    why = uds_admit(ENTRIES, &ENTRIES[sizeof ENTRIES / sizeof ENTRIES[0]], given, &exchange);
    return uds_answer(&exchange, why == NRC_NONE ? serve(uds, &exchange) : why);
}

uint16_t uds_do(struct uds *uds, uint8_t answer[UDS_ANSWER_MAX])
{
    static const uint8_t done[WORK_KINDS][5] = {
        {0}, {ROUTINE | POSITIVE, 1, 0xFF, 0, 0}, {ROUTINE | POSITIVE, 1, 0xFF, 1, 0}
    };
    enum uds_work work = uds->work;
    enum nrc why = uds_step(uds);

    if (why == NRC_PENDING)
        return 0;
    uds->work = WORK_NONE;
    if (why != NRC_NONE)
        return uds_refuse(ROUTINE, why, answer);
    memcpy(answer, done[work], sizeof done[work]);
    return sizeof done[work];
}

void uds_pass(struct uds *uds, uint32_t now_ms, bool asked)
{
    if (asked || uds->work != WORK_NONE)
        uds->asked_ms = now_ms;
    if (uds->wrong >= UDS_TRIES && now_ms - uds->wrong_ms >= UDS_DELAY_MS)
        uds->wrong = 0;
    if (uds->programming && now_ms - uds->asked_ms >= UDS_SESSION_MS)
        enter(uds, false);
}
