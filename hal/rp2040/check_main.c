/* Shows on the serial line what each input reads, and drives a wheel while it is ordered to: for a robot newly
 * wired. `tools/octet check-wiring` guides through it. Orders are single bytes, of which the last one holds: l and r
 * drive the left and the right wheel forward, any other one neither. */
#include "hal/hal.h"
#include "hal/pins_body/pins.h"
#include "hal/port/cortex_m/mcu.h"
#include "hal/port/cortex_m/uart.h"

enum {
    BAUD = 115200,
    BEAT_MS = 5,
    ORDER_BEATS = HAL_SILENCE_MS / BEAT_MS,   /* an order holds this long */
    LINE_BEATS = 10,
    DUTY = 65536 / 5,
    DIGITS = 5
};

struct check {
    char order;
    uint8_t order_left, line_left;            /* beats */
    uint16_t light[2][FEEL_COUNT];            /* with the infrared LEDs off and on */
    bool shines;
};

static struct check check;                    /* line_pump has no argument */

void line_pump(void)
{
    for (int byte = uart_get(); byte != UART_NOTHING; byte = uart_get()) {
        check.order = (char)byte;
        check.order_left = ORDER_BEATS;
    }
}

static void drive(void)
{
    bool drives = check.order_left > 0 && (check.order == 'l' || check.order == 'r') && !pins_bridge_failed();

    if (check.order_left > 0)
        check.order_left--;
    pins_wake_bridge(drives);
    pins_push(0, drives && check.order == 'l' ? DUTY : 0);
    pins_push(1, drives && check.order == 'r' ? DUTY : 0);
}

static void put(const char *text)
{
    for (unsigned i = 0; text[i] != '\0'; i++)
        (void)uart_put((uint8_t)text[i]);     /* the queue has room for a line */
}

static void show(const char *name, uint32_t number)
{
    char digits[DIGITS + 1] = {0};
    unsigned first = DIGITS;
    uint32_t rest = number;

    do {
        first--;
        digits[first] = (char)('0' + rest % 10u);
        rest /= 10u;
    } while (rest != 0 && first > 0);
    put(name);
    put(&digits[first]);
}

static void show_line(void)
{
    show("left ", pins_count(0));
    show(" right ", pins_count(1));
    show(" mv ", pins_battery_mv());
    show(" fault ", pins_bridge_failed());
    show(" bumper ", pins_bumped());
    show(" button ", pins_button());
    show(" bursts ", pins_bursts());
    for (unsigned lit = 0; lit < 2; lit++) {
        put(lit ? " lit" : " dark");
        for (unsigned i = 0; i < FEEL_COUNT; i++)
            if ((PINS_SENSORS >> i & 1) != 0)
                show(" ", check.light[lit][i]);
    }
    put("\r\n");
}

int main(int argc, char *argv[])
{
    (void)argc;
    (void)argv;
    uart_start(BAUD);
    pins_open();
    mcu_light(true);
    for (;;) {
        pins_wait();
        mcu_feed();
        line_pump();
        drive();
        pins_measure(check.light[check.shines]);
        check.shines = !check.shines;
        pins_shine(check.shines);
        if (check.line_left-- == 0) {
            check.line_left = LINE_BEATS - 1;
            show_line();
        }
    }
}
