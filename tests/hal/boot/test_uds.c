#include "hal/boot/uds.h"

#include <string.h>

#include "tests/test.h"

#include "hal/boot/uds_parts.h"

#include "tester.h"

enum { NOW_MS = 100 };

void setUp(void)
{
    boot_flash_clear();
    tester_power_on();
}

TEST(a_session_is_entered_and_told)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8_ARRAY(((uint8_t[]){0x50, 2, 0, 50, 1, 0xF4}), answer, 6);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xF1, 0x86));
    TEST_ASSERT_EQUAL_HEX8(2, answer[3]);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 1));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xF1, 0x86));
    TEST_ASSERT_EQUAL_HEX8(1, answer[3]);
}

TEST(what_is_asked_to_be_quiet_is)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 0x82));
    TEST_ASSERT_EQUAL_UINT16(0, answered);
    TEST_ASSERT_TRUE(uds.programming);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x27, 0x81));
    TEST_ASSERT_EQUAL_UINT16(0, answered);
    TEST_ASSERT_TRUE(uds.asked);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x3E, 0x80));
    TEST_ASSERT_EQUAL_UINT16(0, answered);
    TEST_ASSERT_EQUAL_HEX8(0x12, ASK(0x3E, 0x81));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x11, 0x81));
    TEST_ASSERT_EQUAL_UINT16(0, answered);
    TEST_ASSERT_TRUE(uds.restart);
}

/* {request}, its length, and the code that it is refused with: in the default session, and in a programming session. */
TEST(what_does_not_fit_is_refused_with_its_code)
{
    static const struct {
        uint8_t request[5];
        uint8_t len, by_default, programming;
    } wrong[] = {
        {{0x99}, 1, 0x11, 0x11},
        {{0x10}, 1, 0x13, 0x13}, {{0x10, 3}, 2, 0x12, 0x12}, {{0x10, 0}, 2, 0x12, 0x12},
        {{0x10, 33}, 2, 0x12, 0x12}, {{0x10, 8}, 2, 0x12, 0x12}, {{0x10, 0x7F}, 2, 0x12, 0x12}, {{0x10, 1, 0}, 3, 0x13, 0x13},
        {{0x11}, 1, 0x13, 0x13}, {{0x11, 2}, 2, 0x12, 0x12}, {{0x11, 1, 0}, 3, 0x13, 0x13},
        {{0x3E}, 1, 0x13, 0x13}, {{0x3E, 1}, 2, 0x12, 0x12}, {{0x3E, 0, 0}, 3, 0x13, 0x13},
        {{0x22, 0xF1}, 2, 0x13, 0x13}, {{0x22, 0xF1, 0x8F}, 3, 0x31, 0x31}, {{0x22, 0xF1, 0x80, 0}, 4, 0x13, 0x13},
        {{0x27}, 1, 0x7F, 0x13}, {{0x27, 1}, 2, 0x7F, 0}, {{0x27, 3}, 2, 0x7F, 0x12}, {{0x27, 1, 0}, 3, 0x7F, 0x13},
        {{0x27, 2}, 2, 0x7F, 0x13},
        {{0x2E, 0xFD, 4}, 3, 0x7F, 0x13}, {{0x2E, 0xFD, 6, 1}, 4, 0x7F, 0x31}, {{0x2E, 0xFD, 4, 1}, 4, 0x7F, 0x33},
        {{0x2E, 0xFD, 4, 1, 0}, 5, 0x7F, 0x13},
        {{0x31, 1, 0xFF}, 3, 0x7F, 0x33}, {{0x31, 1, 0xFF, 1}, 4, 0x7F, 0x33}, {{0x34, 0, 0x44}, 3, 0x7F, 0x33},
        {{0x36, 1, 0}, 3, 0x7F, 0x33}, {{0x37}, 1, 0x7F, 0x33},
    };

    for (unsigned session = 1; session <= 2; session++)
        for (unsigned i = 0; i < sizeof wrong / sizeof wrong[0]; i++) {
            TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, (uint8_t)session));
            TEST_ASSERT_EQUAL_HEX8(session == 1 ? wrong[i].by_default : wrong[i].programming,
                                   ask(wrong[i].request, wrong[i].len));
        }
}

TEST(the_board_and_the_boot_loader_say_what_they_are)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xF1, 0x91));
    TEST_ASSERT_EQUAL_UINT(3 + strlen("test_board"), answered);
    TEST_ASSERT_EQUAL_STRING_LEN("test_board", &answer[3], answered - 3);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xF1, 0x80));
    TEST_ASSERT_EQUAL_UINT(3 + strlen("octet boot 1"), answered);
    TEST_ASSERT_EQUAL_STRING_LEN("octet boot 1", &answer[3], answered - 3);
}

TEST(the_status_says_what_is_in_both_slots)
{
    struct choice choice = {.installed = 3, .slot = 1, .trial = true, .starts = 2, .floor = 0x01020304};
    static const uint8_t expected[] = {3, 1, 3, 1, 1, 2, 3, 4, 0, 0, 0, 5, 0, 0, 0, 6, 7, 0, 0, SLOT_BYTES >> 8, SLOT_BYTES & 0xFF, 0,
                                       0xFC, 0x51, 0xCD, 0x8E};

    signer_put(0, 5);
    signer_put(1, 6);
    TEST_ASSERT_EQUAL(0, choices_save(&choices, &choice, true));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xFD, 0));
    TEST_ASSERT_EQUAL_UINT16(3 + sizeof expected, answered);
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, &answer[3], sizeof expected);
}

TEST(the_status_of_a_blank_chip_has_no_versions)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xFD, 0));
    TEST_ASSERT_EACH_EQUAL_HEX8(0, &answer[3], 16);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xFD, 1));
    TEST_ASSERT_EQUAL_UINT16(3 + 8, answered);
}

TEST(who_proves_the_key_is_let_in)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0, prove());
    TEST_ASSERT_EQUAL_HEX8(0x13, ASK(0x31, 1, 0xFF, 0));
}

TEST(who_is_let_in_already_need_not_prove_it_again)
{
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x27, 1));
    TEST_ASSERT_EQUAL_UINT16(2 + UDS_CHALLENGE, answered);
    TEST_ASSERT_EACH_EQUAL_HEX8(0, &answer[2], UDS_CHALLENGE);
    TEST_ASSERT_FALSE(uds.asked);
    TEST_ASSERT_TRUE(uds.unlocked);
}

TEST(a_session_that_is_entered_anew_is_locked)
{
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0x33, ASK(0x31, 1, 0xFF, 0));
}

static int prove_wrongly(void)
{
    uint8_t request[2 + IMAGE_SIGNATURE] = {0x27, 2};

    (void)ASK(0x27, 1);
    return ask(request, sizeof request);
}

TEST(a_challenge_is_good_for_one_proof)
{
    uint8_t text[32] = "octet challenge";
    uint8_t request[2 + IMAGE_SIGNATURE] = {0x27, 2};

    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0x24, ask(request, sizeof request));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x27, 1));
    for (unsigned i = 0; i < UDS_CHALLENGE; i++)
        text[16 + i] = answer[2 + i];
    signer_sign(text, sizeof text, &request[2]);
    TEST_ASSERT_EQUAL_HEX8(0, ask(request, sizeof request));
    TEST_ASSERT_EQUAL_HEX8(0x24, ask(request, sizeof request));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x27, 1));
    TEST_ASSERT_EQUAL_HEX8(0x35, ask(request, sizeof request));   /* said before */
    TEST_ASSERT_EQUAL_HEX8(0x33, ASK(0x31, 1, 0xFF, 0));
}

TEST(who_guesses_three_times_waits)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0x35, prove_wrongly());
    TEST_ASSERT_EQUAL_HEX8(0x35, prove_wrongly());
    uds_pass(&uds, NOW_MS, true);
    TEST_ASSERT_EQUAL_HEX8(0x36, prove_wrongly());
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0x37, ASK(0x27, 1));
    uds_pass(&uds, NOW_MS + UDS_DELAY_MS - 1, true);
    TEST_ASSERT_EQUAL_HEX8(0x37, ASK(0x27, 1));
    uds_pass(&uds, NOW_MS + UDS_DELAY_MS, true);
    TEST_ASSERT_EQUAL_HEX8(0, prove());
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0x35, prove_wrongly());
}

TEST(a_proof_that_holds_forgets_the_guesses_and_time_alone_does_not)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    for (unsigned i = 0; i < 2; i++)
        TEST_ASSERT_EQUAL_HEX8(0x35, prove_wrongly());
    TEST_ASSERT_EQUAL_HEX8(0, prove());
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    for (unsigned i = 0; i < 2; i++)
        TEST_ASSERT_EQUAL_HEX8(0x35, prove_wrongly());
    uds_pass(&uds, NOW_MS + 2 * UDS_DELAY_MS, true);
    TEST_ASSERT_EQUAL_HEX8(0x36, prove_wrongly());
    uds_pass(&uds, NOW_MS + 4 * UDS_DELAY_MS, true);
    for (unsigned i = 0; i < 2; i++)
        TEST_ASSERT_EQUAL_HEX8(0x35, prove_wrongly());
}

TEST(a_proof_is_no_longer_than_a_signature)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x27, 1));
    TEST_ASSERT_EQUAL_HEX8(0x13, ask((uint8_t[2 + IMAGE_SIGNATURE + 1]){0x27, 2}, 2 + IMAGE_SIGNATURE + 1));
}

TEST(a_session_that_was_not_kept_up_for_longer_has_ended_too)
{
    unlock();
    uds_pass(&uds, NOW_MS, true);
    uds_pass(&uds, NOW_MS + UDS_SESSION_MS + 1, false);
    TEST_ASSERT_FALSE(uds.programming);
}

TEST(a_session_that_nobody_keeps_up_ends)
{
    unlock();
    uds_pass(&uds, NOW_MS, true);
    uds_pass(&uds, NOW_MS + UDS_SESSION_MS - 1, false);
    TEST_ASSERT_TRUE(uds.unlocked);
    uds_pass(&uds, NOW_MS + UDS_SESSION_MS, false);
    TEST_ASSERT_FALSE(uds.programming);
    TEST_ASSERT_FALSE(uds.unlocked);
}

TEST(its_number_can_be_written_with_the_key_only)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0x33, ASK(0x2E, 0xFD, 4, 2));
    TEST_ASSERT_EQUAL_HEX8(0, prove());
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x2E, 0xFD, 4, NODE_MAX + 1));
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x2E, 0xFD, 4, NODE_MAX));
    tester_power_on();
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xFD, 4));
    TEST_ASSERT_EQUAL_HEX8(NODE_MAX, answer[3]);
    TEST_ASSERT_EQUAL_UINT16(4, answered);
    unlock();
    for (unsigned i = 0; i < 40; i++)
        TEST_ASSERT_EQUAL_HEX8(0, ASK(0x2E, 0xFD, 4, i % 2));
    boot_flash.failing = true;
    TEST_ASSERT_EQUAL_HEX8(0x72, ASK(0x2E, 0xFD, 4, 2));
}

TEST(the_bit_rate_of_the_bus_can_be_written_with_the_key_only)
{
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x10, 2));
    TEST_ASSERT_EQUAL_HEX8(0x33, ASK(0x2E, 0xFD, 5, 0, 3, 0xD0, 0x90));
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x2E, 0xFD, 5, 0, 3, 0xD0, 0x91));
    TEST_ASSERT_EQUAL_HEX8(0x13, ASK(0x2E, 0xFD, 5, 0));
    TEST_ASSERT_EQUAL_HEX8(0x31, ASK(0x2E, 0xFD, 6, 0));
    for (uint32_t rate = 125000; rate <= 1000000; rate *= 2) {
        TEST_ASSERT_EQUAL_HEX8(0, ASK(0x2E, 0xFD, 5, 0, (uint8_t)(rate >> 16), (uint8_t)(rate >> 8), (uint8_t)rate));
        TEST_ASSERT_EQUAL_UINT32(rate, choice_bitrate(&choices.now));
    }
    tester_power_on();
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x22, 0xFD, 5));
    TEST_ASSERT_EQUAL_UINT32(1000000, uds_number(&answer[3]));
    TEST_ASSERT_EQUAL_UINT16(7, answered);
    unlock();
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x2E, 0xFD, 5, 0, 0, 0, 0));
    TEST_ASSERT_EQUAL_UINT32(0, choice_bitrate(&choices.now));
}

#define ASSERT_ANSWER(...) do { \
    static const uint8_t expected[] = {__VA_ARGS__}; \
    TEST_ASSERT_EQUAL_UINT16(sizeof expected, answered); \
    TEST_ASSERT_EQUAL_HEX8_ARRAY(expected, answer, sizeof expected); \
} while (0)

TEST(each_answer_is_what_the_standard_says_to_its_last_byte)
{
    struct signed_image image = signer_image(0, 7);
    uint8_t block[2 + SIGNED_BYTES] = {0x36, 1};

    boot_flash_clear();
    tester_power_on();
    unlock();
    ASSERT_ANSWER(0x67, 2);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x31, 1, 0xF0, 0, 0, 0, 0, 1));
    ASSERT_ANSWER(0x71, 1, 0xF0, 0, 0);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x2E, 0xFD, 4, 1));
    ASSERT_ANSWER(0x6E, 0xFD, 4);
    TEST_ASSERT_EQUAL_HEX8(0, erase_for(&image, 0));
    ASSERT_ANSWER(0x71, 1, 0xFF, 0, 0);
    TEST_ASSERT_EQUAL_HEX8(0, announce(0));
    ASSERT_ANSWER(0x74, 0x20, 4, 2);
    memcpy(&block[2], image.bytes, SIGNED_BYTES);
    TEST_ASSERT_EQUAL_HEX8(0, ask(block, sizeof block));
    ASSERT_ANSWER(0x76, 1);
    TEST_ASSERT_EQUAL_HEX8(0, ASK(0x37));
    ASSERT_ANSWER(0x77);
    TEST_ASSERT_EQUAL_HEX8(0, check());
    ASSERT_ANSWER(0x71, 1, 0xFF, 1, 0);
}
