/* Challenges of a chip without a random number generator: what the RAM held at power-up, and when requests came. */
#include <string.h>

#include "hal/boot/sha512.h"
#include "hal/boot/uds.h"
#include "hal/port/cortex_m/core.h"
#include "hal/port/cortex_m/systick.h"

static uint8_t pool[SHA512_BYTES] __attribute__((section(".noinit")));   /* power-up fills it at random; a reset leaves it */

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
