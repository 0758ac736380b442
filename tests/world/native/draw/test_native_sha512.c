#include "host_sim/world/native/draw/sha512.h"
#include "tests/test.h"

#include <string.h>

static void expect(const char *message, const char *hex)
{
    static const char digits[] = "0123456789abcdef";
    uint8_t digest[SHA512_BYTES];
    char text[2 * SHA512_BYTES + 1] = "";

    sha512((const uint8_t *)message, strlen(message), digest);
    for (unsigned i = 0; i < SHA512_BYTES; i++) {
        text[2 * i] = digits[digest[i] >> 4];
        text[2 * i + 1] = digits[digest[i] & 15];
    }
    TEST_ASSERT_EQUAL_STRING(hex, text);
}

TEST(the_digest_of_nothing)
{
    expect("", "cf83e1357eefb8bdf1542850d66d8007d620e4050b5715dc83f4a921d36ce9ce"
               "47d0d13c5d85f2b0ff8318d2877eec2f63b931bd47417a81a538327af927da3e");
}

TEST(the_digest_in_the_standard)
{
    expect("abc", "ddaf35a193617abacc417349ae20413112e6fa4e89a97ea20a9eeee64b55d39a"
                  "2192992a274fc1a836ba3c23a3feebbd454d4423643ce80e2a9ac94fa54ca49f");
}

TEST(the_digest_of_the_longest_message)
{
    char message[SHA512_MESSAGE_MAX + 1] = "";

    memset(message, 'a', SHA512_MESSAGE_MAX);
    expect(message, "fa9121c7b32b9e01733d034cfc78cbf67f926c7ed83e82200ef8681819692176"
                    "0b4beff48404df811b953828274461673c68d04e297b0eb7b2b4d60fc6b566a2");
}
