/* The boot loader on its bus: whatever frames come, however long they take, whatever the flash held before and whichever of
 * its operations fail. A signature may fit or not. The slot of a confirmed image does not change, and no image is
 * installed that is not signed. */
#include <string.h>

#include <monocypher.h>

#include "hal/boot/server.h"
#include "hal/boot/start.h"
#include "hal/flash_store/crc32.h"
#include "tests/proof/any/any.h"

enum { PAGE = 256, PAGES = 14, CHOICE_PAGE = 2, SLOT_PAGES = 5, BLANK = 0xFF, KNOWN = 3, STEPS = 16, SIZE = IMAGE_VECTORS + 64 };

const struct layout LAYOUT = {
    .chip = "chip", .board = "board", .number = 1,
    .choice_page = CHOICE_PAGE, .slot_page = {CHOICE_PAGE + 2, CHOICE_PAGE + 2 + SLOT_PAGES}, .slot_pages = SLOT_PAGES,
    .at_once = 1,
};
const uint8_t IMAGE_SIGNER[IMAGE_KEY] = {1};

struct link {
    uint8_t unused;
};

static uint8_t flash[PAGES][PAGE];
static struct choices choices;
static unsigned planned;
static bool fits;   /* the last signature */

uint32_t flash_page_size(void)
{
    return PAGE;
}

uint32_t flash_unit(void)
{
    return sizeof(uint32_t);
}

int flash_read(unsigned page, uint32_t offset, uint32_t words[], uint32_t count)
{
    must(page < PAGES && offset + count <= PAGE);
    memcpy(words, &flash[page][offset], count);
    return any_u8() == 1 ? -1 : 0;
}

static void assert_may_change(unsigned page)
{
    const struct choice *now = &choices.now;
    bool confirmed = (now->installed >> now->slot & 1u) != 0 && !now->trial;
    unsigned first = LAYOUT.slot_page[now->slot];

    must(page >= CHOICE_PAGE && page < PAGES);
    must(!confirmed || page < first || page >= first + SLOT_PAGES);
}

int flash_write(unsigned page, uint32_t offset, const uint32_t words[], uint32_t count)
{
    assert_may_change(page);
    must(offset + count <= PAGE);
    if (any_u8() == 1)
        return -1;
    memcpy(&flash[page][offset], words, count);
    return 0;
}

int flash_erase(unsigned page)
{
    assert_may_change(page);
    if (any_u8() == 1)
        return -1;
    memset(flash[page], BLANK, PAGE);
    return 0;
}

void crypto_eddsa_reduce(uint8_t reduced[32], const uint8_t expanded[64])
{
    memcpy(reduced, expanded, 32);
}

int crypto_eddsa_check_equation(const uint8_t signature[64], const uint8_t public_key[32], const uint8_t h[32])
{
    (void)signature;
    (void)public_key;
    (void)h;
    fits = !any_bool();
    return fits ? 0 : -1;
}

void boot_random(uint8_t out[UDS_CHALLENGE])
{
    memset(out, any_u8(), UDS_CHALLENGE);
}

int link_send(struct link *link, const struct frame *frame)
{
    (void)link;
    must(frame->len <= sizeof frame->data);
    return any_u8() == 1 ? LINK_E_FULL : 0;
}

static struct frame any_frame(void)
{
    struct frame frame = {.id = UPDATE_REQUEST_ID + 1, .len = any_u8() % 9};

    for (unsigned i = 0; i < frame.len; i++)
        frame.data[i] = any_u8();
    return frame;
}

/* Header of an image of zeros that fits, so that not all of an update has to be guessed. */
static void put_header(uint8_t header[IMAGE_HEADER], unsigned slot)
{
    static const uint8_t zeros[SIZE];
    uint32_t crc;
    static const uint8_t fits[IMAGE_HEADER] = {
        'O', 'C', 'T', 'E', 'T', 'I', 'M', 'G', SIZE & 0xFF, SIZE >> 8, [16] = 9, [20] = 1,
        [22] = 1, [24] = 'c', 'h', 'i', 'p', [36] = 'b', 'o', 'a', 'r', 'd',
    };

    memcpy(header, fits, IMAGE_HEADER);
    header[21] = (uint8_t)slot;
    crc = crc32_more(crc32_more(0, &header[16], IMAGE_HEADER - 16), zeros, SIZE - IMAGE_HEADER);
    for (unsigned i = 0; i < sizeof crc; i++)
        header[12 + i] = (uint8_t)(crc >> 8 * i);
}

/* Which request is next: that of an update, or any. */
static unsigned any_step(void)
{
    static const uint8_t plan[] = {0, 1, 2, 3, 4, 5, 5, 5, 6, 7};
    uint8_t which = any_u8();

    if (which > 0)
        return which % 16;
    return plan[planned++ % sizeof plan];
}

/* One of those that an update is made of, or bytes; one may be wrong. */
static uint16_t any_request(const struct uds *uds, uint8_t request[UDS_BLOCK_MAX])
{
    static const uint8_t plain[][11] = {
        {0x10, 2}, {0x27, 1}, {0x27, 2}, {0x31, 1, 0xFF, 0}, {0x34, 0, 0x44, 0, 0, 0, 0, 0, 0, 1, 0x80}, {0x36, 1}, {0x37},
        {0x31, 1, 0xFF, 1}, {0x22, 0xFD, 0}, {0x22, 0xFD, 1}, {0x2E, 0xFD, 4, 9}, {0x31, 1, 0xF0, 0, 0, 0, 0, 1},
    };
    static const uint16_t lens[] = {2, 2, 2 + IMAGE_SIGNATURE, 8 + IMAGE_HEADER, 11, 2 + 128, 1, 4, 3, 3, 4, 8};
    unsigned which = any_step();
    uint16_t len = which < 12 ? lens[which] : any_u8();

    memset(request, 0, UDS_BLOCK_MAX);
    if (which < 12)
        memcpy(request, plain[which], sizeof plain[which]);
    if (which == 3)
        put_header(&request[8], choice_free_slot(&choices.now));
    if (which == 5)
        request[1] = uds->number;
    if (which == 5 && uds->at == 0)
        put_header(&request[2], uds->slot);
    if (which >= 12 || any_u8() == 1)
        request[any_u8() % (len + 1u)] = any_u8();
    return len > 0 ? len : 1;
}

static void fill(void)
{
    unsigned known = any_u8() % (KNOWN + 1);

    memset(flash, BLANK, sizeof flash);
    for (unsigned i = 0; i < known; i++)
        flash[CHOICE_PAGE + any_u8() % (PAGES - CHOICE_PAGE)][any_u8()] = any_u8();
}

static void take_frame(struct server *server, uint32_t now_ms)
{
    struct frame frame = any_frame();

    server_take(server, &frame, now_ms);
}

static void take_request(struct server *server)
{
    uint8_t request[UDS_BLOCK_MAX];
    uint16_t len = any_request(&server->uds, request);

    must(uds_serve(&server->uds, request, len, server->isotp.tx) <= UDS_ANSWER_MAX);
}

void exercise(void)
{
    static struct server server;
    struct link link = {0};
    uint32_t now_ms = 0;

    planned = 0;
    fill();
    (void)choices_open(&choices, CHOICE_PAGE);
    (void)start_pick(&choices);
    if (any_bool()) {
        struct choice used = {.installed = any_u8() % 4, .slot = any_u8() % 2, .trial = any_bool()};

        (void)choices_save(&choices, &used, true);
    }
    server_begin(&server, &choices, 1, now_ms);
    for (unsigned step = 0; any_more() || step < STEPS; step++) {
        unsigned before = choices.now.installed;

        fits = false;
        now_ms += any_u8();
        if (any_bool())
            take_frame(&server, now_ms);
        else
            take_request(&server);
        server_send(&server, &link, now_ms);
        for (unsigned i = 0; i <= SLOT_PAGES + 1 && !any_bool(); i++)
            if (!server_work(&server, now_ms))
                server_begin(&server, &choices, 1, now_ms);
        must((choices.now.installed & ~before) == 0 || fits);
    }
}
