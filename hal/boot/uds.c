#include "hal/boot/uds.h"

#include <string.h>

#include "hal/boot/uds_parts.h"
#include "hal/flash_store/flash.h"

enum {
    DEFAULT_SESSION = 1, PROGRAMMING_SESSION = 2,
    HARD_RESET = 1,
    SEED = 1, PROOF = 2,
    QUIET = 0x80,                 /* in a subfunction: only a refusal is answered */
    P2_MS = 50, P2_STAR_10_MS = 500,
    ID_LEN = 2,
    DID_BOOT = 0xF180, DID_SESSION = 0xF186, DID_BOARD = 0xF191, DID_STATUS = 0xFD00, DID_WRITTEN = 0xFD01, DID_WHO = 0xFD04,
    DID_BITRATE = 0xFD05,
    KEY_SHOWN = 4                 /* bytes of the public key, to tell one from another */
};

/* What a tester signs: this and the challenge. No image begins like that. */
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

/* Whatever a session had begun is forgotten with it, except for how often somebody has guessed. */
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
    uint8_t session = exchange->request[1] & (uint8_t)~QUIET;

    if (session != DEFAULT_SESSION && session != PROGRAMMING_SESSION)
        return NRC_FUNCTION;
    if (exchange->len != 2)
        return NRC_LENGTH;
    enter(uds, session == PROGRAMMING_SESSION);
    uds_put(exchange, session, 1);
    uds_put(exchange, P2_MS, 2);
    uds_put(exchange, P2_STAR_10_MS, 2);
    return NRC_NONE;
}

static enum nrc reset(struct uds *uds, struct exchange *exchange)
{
    if ((exchange->request[1] & ~QUIET) != HARD_RESET)
        return NRC_FUNCTION;
    if (exchange->len != 2)
        return NRC_LENGTH;
    uds->restart = true;
    uds_put(exchange, HARD_RESET, 1);
    return NRC_NONE;
}

static enum nrc tester_present(struct uds *uds, struct exchange *exchange)
{
    (void)uds;
    if ((exchange->request[1] & ~QUIET) != 0)
        return NRC_FUNCTION;
    if (exchange->len != 2)
        return NRC_LENGTH;
    uds_put(exchange, 0, 1);
    return NRC_NONE;
}

static enum nrc give_challenge(struct uds *uds, struct exchange *exchange)
{
    if (exchange->len != 2)
        return NRC_LENGTH;
    if (uds->wrong >= UDS_TRIES)
        return NRC_DELAY;
    boot_random(uds->challenge);
    uds->asked = true;
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

static enum nrc secure(struct uds *uds, struct exchange *exchange)
{
    uint8_t function = exchange->request[1];

    uds_put(exchange, function, 1);
    if (function == SEED)
        return give_challenge(uds, exchange);
    return function == PROOF ? take_proof(uds, exchange) : NRC_FUNCTION;
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

/* From where on an interrupted update goes on: whole pages that are written, and a check of them. */
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
    unsigned id;

    if (exchange->len != 1 + ID_LEN)
        return NRC_LENGTH;
    id = (unsigned)exchange->request[1] << 8 | exchange->request[2];
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

/* The robot's number, and the bit rate of the bus: they hold from the next start on. */
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

struct entry {
    uint8_t service;
    uint8_t shortest;             /* request, bytes */
    bool programming, unlocked;   /* what it takes */
    enum nrc (*serve)(struct uds *uds, struct exchange *exchange);
};

static const struct entry ENTRIES[] = {
    {SESSION_CONTROL, 2, false, false, control_session},
    {RESET, 2, false, false, reset},
    {READ, 3, false, false, read},
    {SECURITY, 2, true, false, secure},
    {WRITE, 4, true, false, write},
    {ROUTINE, 4, true, true, uds_routine},
    {DOWNLOAD, 3, true, true, uds_download},
    {TRANSFER, 2, true, true, uds_transfer},
    {TRANSFER_EXIT, 1, true, true, uds_transfer_exit},
    {TESTER_PRESENT, 2, false, false, tester_present},
};

static enum nrc dispatch(struct uds *uds, struct exchange *exchange)
{
    const struct entry *entry = ENTRIES;
    const struct entry *end = &ENTRIES[sizeof ENTRIES / sizeof ENTRIES[0]];

    while (entry < end && entry->service != exchange->request[0])
        entry++;
    if (entry == end)
        return NRC_SERVICE;
    if (entry->programming && !uds->programming)
        return NRC_SESSION;
    if (exchange->len < entry->shortest)
        return NRC_LENGTH;
    if (entry->unlocked && !uds->unlocked)
        return NRC_LOCKED;
    return entry->serve(uds, exchange);
}

static uint16_t refuse(uint8_t service, enum nrc why, uint8_t answer[UDS_ANSWER_MAX])
{
    answer[0] = NEGATIVE;
    answer[1] = service;
    answer[2] = (uint8_t)why;
    return 3;
}

/* Of a request that was served: those that have a function are long enough for it. */
static bool is_quiet(const uint8_t request[])
{
    bool has_function = request[0] == SESSION_CONTROL || request[0] == RESET || request[0] == TESTER_PRESENT;

    return has_function && request[1] & QUIET;
}

uint16_t uds_serve(struct uds *uds, const uint8_t request[], uint16_t len, uint8_t answer[UDS_ANSWER_MAX])
{
    struct exchange exchange = {request, len, answer, 1};
    enum nrc why;

    if (uds->work != WORK_NONE)
        return request[0] == TESTER_PRESENT ? 0 : refuse(request[0], NRC_BUSY, answer);
    answer[0] = (uint8_t)(request[0] | POSITIVE);
    why = dispatch(uds, &exchange);
    if (why != NRC_NONE)
        return refuse(request[0], why, answer);
    return is_quiet(request) ? 0 : exchange.size;
}

uint16_t uds_do(struct uds *uds, uint8_t answer[UDS_ANSWER_MAX])
{
    static const uint8_t done[WORK_KINDS][5] = {{0}, {ROUTINE | POSITIVE, 1, 0xFF, 0, 0}, {ROUTINE | POSITIVE, 1, 0xFF, 1, 0}};
    enum uds_work work = uds->work;
    enum nrc why = uds_step(uds);

    if (why == NRC_PENDING)
        return 0;
    uds->work = WORK_NONE;
    if (why != NRC_NONE)
        return refuse(ROUTINE, why, answer);
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
