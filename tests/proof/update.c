/* The boot loader's ISO-TP, its check of an image and its choice of one, and what an image answers: whatever frames come,
 * whenever, whatever the flash holds, and whichever of its operations fail. */
#include <monocypher.h>

#include "hal/boot/handover.h"
#include "hal/boot/image.h"
#include "hal/boot/isotp.h"
#include "hal/boot/start.h"
#include "hal/port/cortex_m/leave.h"
#include "hal/port/cortex_m/loader.h"
#include "hal/port/cortex_m/systick.h"
#include "tests/proof/any/any.h"
#include "tests/proof/any/flash.h"

enum { CHOICE = 2, SLOT_PAGES = 4, SLOT_A = 4, SLOT_B = SLOT_A + SLOT_PAGES };

const unsigned ANY_FLASH_PAGES = SLOT_B + SLOT_PAGES;

const struct layout LAYOUT = {
    .chip = "stm32f103", .board = "blue_pill", .number = 1,
    .choice_page = CHOICE, .slot_page = {SLOT_A, SLOT_B}, .slot_pages = SLOT_PAGES, .at_once = 1,
};
const uint8_t IMAGE_SIGNER[IMAGE_KEY] = {1};

void crypto_eddsa_reduce(uint8_t reduced[32], const uint8_t expanded[64])
{
    for (unsigned i = 0; i < 32; i++)
        reduced[i] = expanded[i];
}

int crypto_eddsa_check_equation(const uint8_t signature[64], const uint8_t public_key[32], const uint8_t h[32])
{
    for (unsigned i = 0; i < 32; i++)
        (void)(signature[i] + signature[i + 32] + public_key[i] + h[i]);
    return any_bool() ? 0 : -1;
}

uint32_t machine_ms(void)
{
    return any_u32();
}

void handover_ask(void)
{
}

void leave_by_reset(void)
{
}

static void take(struct isotp *isotp, uint32_t now_ms)
{
    struct frame frame = {.id = any_u32(), .len = any_u8() % 9};
    struct frame answer;
    uint16_t len;

    for (unsigned i = 0; i < sizeof frame.data; i++)
        frame.data[i] = any_u8();
    len = isotp_take(isotp, &frame, now_ms);
    //@ assert within: len <= ISOTP_RX_MAX;
    (void)loader_frame(&frame, any_bool(), &answer);
    loader_alive(any_bool());
}

static void say(struct isotp *isotp, uint32_t now_ms)
{
    struct frame frame;

    if (any_bool())
        isotp_send(isotp, any_u16());
    if (isotp_next(isotp, &frame, now_ms) && any_bool())
        isotp_sent(isotp, now_ms);
}

static void look(struct choices *choices, unsigned slot)
{
    uint8_t header[IMAGE_HEADER];
    struct image image;
    bool readable;

    for (unsigned i = 0; i < IMAGE_HEADER; i++)
        header[i] = any_u8();
    (void)start_pick(choices);
    (void)image_judge(header, slot, any_u32(), &image);
    (void)image_has_header(slot, header);
    (void)image_crc(slot, image_written(slot), &readable);
    (void)image_verify(slot, &image);
}

void exercise(void)
{
    struct choices choices;
    struct isotp isotp = {.id = 0};

    (void)choices_open(&choices, CHOICE);
    (void)loader_node(any_u8());
    while (any_more()) {
        uint32_t now_ms = any_u32();

        take(&isotp, now_ms);
        say(&isotp, now_ms);
        (void)isotp_receives(&isotp, now_ms);
        (void)isotp_busy(&isotp);
        look(&choices, any_between(0, 1));
    }
}
