#include "tester.h"

#include <string.h>

#include <unity.h>

#include "hal/boot/start.h"

struct uds uds;
struct choices choices;
uint8_t answer[UDS_ANSWER_MAX];
uint16_t answered;

enum { BLOCK = 128, PENDING = 0x78, STEPS_MAX = 20 };

void boot_random(uint8_t out[UDS_CHALLENGE])
{
    static uint8_t number;

    memset(out, ++number, UDS_CHALLENGE);
}

void tester_power_on(void)
{
    (void)choices_open(&choices, CHOICE_PAGE);
    uds_begin(&uds, &choices, 0);
}

struct signed_image tester_begin(void)
{
    boot_flash_clear();
    signer_put(0, 5);
    tester_power_on();
    TEST_ASSERT_EQUAL(0, start_pick(&choices));
    return signer_image(1, 6);
}

static int code(uint8_t service)
{
    if (answered > 0 && answer[0] == 0x7F) {
        TEST_ASSERT_EQUAL_UINT16(3, answered);
        TEST_ASSERT_EQUAL_HEX8(service, answer[1]);
        return answer[2];
    }
    if (answered > 0)
        TEST_ASSERT_EQUAL_HEX8(service + 0x40, answer[0]);
    return 0;
}

int ask(const uint8_t request[], uint16_t len)
{
    uint8_t service = request[0];

    answered = uds_serve(&uds, request, len, answer);
    if (uds.work == WORK_NONE)
        return code(service);
    TEST_ASSERT_EQUAL_HEX8(PENDING, code(service));
    answered = 0;
    for (unsigned i = 0; i < STEPS_MAX && answered == 0; i++)
        answered = uds_do(&uds, answer);
    TEST_ASSERT_GREATER_THAN_UINT16(0, answered);
    return code(service);
}

int prove(void)
{
    uint8_t text[32] = "octet challenge";
    uint8_t request[2 + IMAGE_SIGNATURE] = {0x27, 2};
    int result = ASK(0x27, 1);

    if (result != 0)
        return result;
    memcpy(&text[16], &answer[2], UDS_CHALLENGE);
    signer_sign(text, sizeof text, &request[2]);
    return ask(request, sizeof request);
}

void unlock(void)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0, prove());
}

static void put(uint8_t *at, uint32_t number)
{
    for (unsigned i = 0; i < 4; i++)
        at[i] = (uint8_t)(number >> (24 - 8 * i));
}

int erase_for(const struct signed_image *image, uint32_t from)
{
    uint8_t request[8 + IMAGE_HEADER] = {0x31, 1, 0xFF, 0};

    put(&request[4], from);
    memcpy(&request[8], image->bytes, IMAGE_HEADER);
    return ask(request, sizeof request);
}

int announce(uint32_t from)
{
    uint8_t request[11] = {0x34, 0, 0x44};

    put(&request[3], from);
    put(&request[7], SIGNED_BYTES - from);
    return ask(request, sizeof request);
}

void begin_download(const struct signed_image *image)
{
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(image, 0));
    TEST_ASSERT_EQUAL_HEX8(0, announce(0));
}

int download(const struct signed_image *image, uint32_t from)
{
    uint8_t request[2 + BLOCK] = {0x36, 0};
    int result = announce(from);

    for (uint32_t at = from; at < SIGNED_BYTES && result == 0; at += BLOCK) {
        request[1]++;
        memcpy(&request[2], &image->bytes[at], BLOCK);
        result = ask(request, sizeof request);
    }
    return result != 0 ? result : ASK(0x37);
}

int check(void)
{
    return ASK(0x31, 1, 0xFF, 1);
}

int update(const struct signed_image *image)
{
    int result;

    unlock();
    result = erase_for(image, 0);
    if (result == 0)
        result = download(image, 0);
    return result != 0 ? result : check();
}
