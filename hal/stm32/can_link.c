/* Frames over the chip's own CAN controller. Every wait is bounded. */
#include "hal/link/link.h"

#include <stdbool.h>

#include "hal/port/cortex_m/can_controller.h"
#include "hal/port/cortex_m/can_queue.h"
#include "hal/port/cortex_m/uart.h"
#include "hal/stm32/chip.h"

enum {
    RECOVERY_MS = 250,             /* between attempts to recover from bus-off: four times what a full bus needs */
    BITRATE = OCTET_CAN_BITRATE,   /* bit/s, set by the build */
    QUANTA_MIN = 8, QUANTA_MAX = 18   /* per bit: each of our controllers supports these */
};

struct link {
    uint32_t off_ms;   /* start of the last attempt to recover from bus-off */
    bool off;          /* bus-off, and not yet recovered */
    uint8_t bus_offs;  /* as in struct link_health */
    struct can_queue queue;
};

static struct link the_link;   /* one controller */

/* The bit rate in the name, bit/s, or that of the build. */
static uint32_t bitrate_of(const char *name)
{
    uint32_t bitrate = 0;

    for (const char *at = name; *at != '\0'; at++)
        bitrate = 10u * bitrate + (uint32_t)(*at - '0');
    return bitrate != 0 ? bitrate : (uint32_t)BITRATE;
}

/* Quanta per bit for which an integer prescaler gives exactly that bit rate, as many as can be: finer ones improve
 * synchronisation. 0: the clock has no such divisor. */
static uint32_t quanta_for(uint32_t clock_hz, uint32_t bitrate)
{
    for (uint32_t quanta = QUANTA_MAX; quanta >= QUANTA_MIN; quanta--)
        if (clock_hz % (bitrate * quanta) == 0)
            return quanta;
    return 0;
}

int link_open(struct link **link, const char *name, const uint16_t ids[], size_t id_count)
{
    uint32_t clock_hz = machine_clocks().can_hz;
    uint32_t bitrate = bitrate_of(name);
    uint32_t quanta = quanta_for(clock_hz, bitrate);

    if (id_count > LINK_IDS_MAX || quanta == 0 || !can_stop())
        return LINK_E_OPEN;
    can_set_up(clock_hz / (bitrate * quanta), quanta, ids, id_count);
    can_start();
    the_link = (struct link){.off = false};
    can_queue_begin(&the_link.queue, bitrate);
    *link = &the_link;
    return 0;
}

/* Drops waiting frames, which would be out of date when sent. */
static void recover(struct link *link)
{
    uint32_t now = machine_ms();

    if (link->off && now - link->off_ms < RECOVERY_MS)
        return;
    if (!link->off && link->bus_offs < UINT8_MAX)
        link->bus_offs++;
    can_queue_drop(&link->queue);
    link->off = true;
    link->off_ms = now;
    if (can_stop())
        can_start();
}

static bool is_up(struct link *link)
{
    enum can_state state = can_state();

    if (state == CAN_LOST)
        recover(link);
    else
        link->off = false;
    return state == CAN_JOINED;
}

/* Families after all others. */
static int take(struct frame *out)
{
    int result = 0;

    for (unsigned n = 0; n < CAN_FIFOS && result == 0; n++)
        result = can_take(n, out);
    return result;
}

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    uint32_t start = machine_ms();
    bool up;
    int result;

    do {
        up = is_up(link);
        if (link->queue.count > 0)
            (void)can_queue_pump(&link->queue);
        result = take(out);
    } while (result == 0 && machine_ms() - start < wait_ms);
    return result == 0 && !up ? LINK_E_DOWN : result;
}

int link_send(struct link *link, const struct frame *frame)
{
    if (!is_up(link))
        return LINK_E_DOWN;
    return can_queue_put(&link->queue, frame) ? 0 : LINK_E_FULL;
}

/* Nothing to do: the controller buffers three received frames. */
void line_pump(void)
{
}

void link_health(const struct link *link, struct link_health *out)
{
    *out = (struct link_health){.bus_offs = link->bus_offs, .dropped = link->queue.dropped};
    can_status(out);
}

void link_close(struct link *link)
{
    if (link)
        (void)can_stop();
}
