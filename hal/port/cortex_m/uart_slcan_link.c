/* Frames as slcan text over a serial line. A byte arrives at most every 87 us, and every wait here receives it; a
 * serial port may hold several. */
#include "hal/link/link.h"

#include <stdbool.h>

#include "hal/link/slcan.h"
#include "hal/port/cortex_m/systick.h"
#include "hal/port/cortex_m/uart.h"

enum {
    BAUD = 115200,
    WAITING_MAX = 128,   /* bytes received and not yet decoded: four lines */
    SPOILT = '?'         /* occurs in no valid line: marks a line as garbled */
};

struct link {
    struct slcan_decoder decoder;
    char waiting[WAITING_MAX];
    uint8_t first, count;   /* index of the first of these bytes, and their number */
    bool cut_short;         /* the last line sent lacks its end */
};

static struct link the_link;   /* one line per program */

int link_open(struct link **link, const char *name, const uint16_t ids[], size_t id_count)
{
    (void)name;
    (void)ids;
    (void)id_count;
    uart_start(BAUD);
    the_link = (struct link){.count = 0};
    *link = &the_link;
    return 0;
}

/* What there is no room for stays in the serial port, which reports what it loses then. */
static void pump(struct link *link)
{
    int byte = 0;

    while (byte != UART_NOTHING && link->count < WAITING_MAX) {
        byte = uart_get();
        if (byte != UART_NOTHING) {
            link->waiting[(link->first + link->count) % WAITING_MAX] = byte == UART_DAMAGED ? SPOILT : (char)byte;
            link->count++;
        }
    }
}

void line_pump(void)
{
    pump(&the_link);
}

/* Returns 1, 0 or LINK_E_GARBLED as link_receive, without waiting. */
static int decode(struct link *link, struct frame *out)
{
    enum slcan_found found = SLCAN_NOTHING;

    while (link->count > 0 && found == SLCAN_NOTHING) {
        found = slcan_decode(&link->decoder, link->waiting[link->first], out);
        link->first = (uint8_t)((link->first + 1u) % WAITING_MAX);
        link->count--;
    }
    if (found == SLCAN_NOTHING)
        return 0;
    return found == SLCAN_FRAME ? 1 : LINK_E_GARBLED;
}

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    uint32_t start = machine_ms();
    int result;

    do {
        pump(link);
        result = decode(link, out);
    } while (result == 0 && machine_ms() - start < wait_ms);
    return result;
}

static bool send_byte(struct link *link, char byte, uint32_t start)
{
    while (!uart_put((uint8_t)byte)) {
        pump(link);
        if (machine_ms() - start > LINK_SEND_MS)
            return false;
    }
    return true;
}

/* First ends a line that was cut short; otherwise this one would be read as its tail. */
int link_send(struct link *link, const struct frame *frame)
{
    char text[1 + SLCAN_TEXT_MAX];
    size_t prefix = link->cut_short ? 1 : 0;
    size_t len = prefix + slcan_encode(&text[1], frame);
    uint32_t start = machine_ms();
    size_t sent = 0;

    text[0] = '\r';
    while (sent < len && send_byte(link, text[1 - prefix + sent], start))
        sent++;
    if (sent > 0)
        link->cut_short = sent < len;
    return sent == len ? 0 : LINK_E_FULL;
}

/* A serial line has no error counters, and an adapter at its far end does not report its own. */
void link_health(const struct link *link, struct link_health *out)
{
    (void)link;
    *out = (struct link_health){.state = BUS_ACTIVE};
}

void link_close(struct link *link)
{
    if (link)
        uart_stop();
}
