/* Challenges without a random number generator: from the RAM's content at power-up and the times of requests. */
#include <string.h>

#include "hal/boot/sha512.h"
#include "hal/boot/uds.h"
#include "hal/port/cortex_m/core.h"
#include "hal/port/cortex_m/systick.h"

static uint8_t pool[SHA512_BYTES] __attribute__((section(".noinit")));   /* random after power-up; kept by a reset */

void boot_random(uint8_t out[UDS_CHALLENGE])
{
    uint32_t moment[] = {SYSTICK.val, machine_ms()};
    struct sha512 hash;

    sha512_begin(&hash);
    sha512_add(&hash, pool, sizeof pool);
    sha512_add(&hash, (const uint8_t *)moment, sizeof moment);
    sha512_end(&hash, pool);
    memcpy(out, pool, UDS_CHALLENGE);
    sha512(pool, sizeof pool, pool);
}
