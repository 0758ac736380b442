/* sha512.h: the digest by which Python seeds its random numbers. */
#ifndef OCTET_SHA512_H
#define OCTET_SHA512_H

#include <stddef.h>
#include <stdint.h>

enum { SHA512_BYTES = 64, SHA512_MESSAGE_MAX = 111 };

void sha512(const uint8_t *message, size_t len, uint8_t digest[SHA512_BYTES]);
        /* The SHA-512 digest (FIPS 180-4) of a message of at most SHA512_MESSAGE_MAX bytes: with its length, they are one block. */

#endif
