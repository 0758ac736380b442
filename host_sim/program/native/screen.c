#include "host_sim/program/native/machine.h"

#include <string.h>

enum { DIGITS = 24, DECIMALS = 3, PARTS = 1000 };

static size_t put_whole(char *to, uint32_t number)
{
    char digits[DIGITS];
    size_t count = 0;

    do
        digits[count++] = (char)('0' + number % 10);
    while ((number /= 10) > 0);
    for (size_t i = 0; i < count; i++)
        to[i] = digits[count - 1 - i];
    return count;
}

/* Up to three decimals, without trailing zeros. */
static size_t put_parts(char *to, uint32_t parts)
{
    size_t count = 0;

    if (parts == 0)
        return 0;
    to[count++] = '.';
    for (uint32_t unit = PARTS / 10; parts > 0; unit /= 10) {
        to[count++] = (char)('0' + parts / unit);
        parts %= unit;
    }
    return count;
}

static size_t put_number(char text[DIGITS], double number)
{
    size_t len = 0;
    double size = number < 0 ? -number : number;
    uint32_t whole = (uint32_t)machine_whole(size);
    uint32_t parts = size < INT32_MAX ? (uint32_t)((size - whole) * PARTS + 0.5) : 0;

    if (parts == PARTS) {
        whole++;
        parts = 0;
    }
    if (number < 0 && (whole > 0 || parts > 0))
        text[len++] = '-';
    len += put_whole(text + len, whole);
    return len + put_parts(text + len, parts);
}

void machine_show_number(struct machine *machine, double number)
{
    char text[DIGITS];

    machine_show_text(machine, text, put_number(text, number));
}

void machine_print_number(struct machine *machine, double number)
{
    char text[DIGITS];

    machine_print_text(machine, text, put_number(text, number));
}

void machine_print_text(struct machine *machine, const char *text, size_t len)
{
    struct program *program = machine->program;
    size_t room = PROGRAM_PRINTED_MAX - 1u - program->printed_len;

    len = len < room ? len : room;
    memcpy(program->printed + program->printed_len, text, len);
    program->printed_len = (uint16_t)(program->printed_len + len);
    program->printed[program->printed_len] = '\0';
}

void machine_show_text(struct machine *machine, const char *text, size_t len)
{
    struct program_shown *shown = &machine->program->shown[machine->program->shown_at];
    size_t used = strlen(shown->text), room = PROGRAM_SHOWN_TEXT - 1 - used;

    len = len < room ? len : room;
    memcpy(shown->text + used, text, len);
    shown->text[used + len] = '\0';
}

/* Selects the line already shown at this position, or a free one, or else the last one. */
void machine_show_at(struct machine *machine, double x, double y)
{
    struct program *program = machine->program;
    uint8_t at = 0;

    while (at < PROGRAM_SHOWN_MAX - 1 && program->shown[at].text[0] != '\0'
           && (program->shown[at].x != x || program->shown[at].y != y))
        at++;
    program->shown_at = at;
    program->shown[at] = (struct program_shown){.x = x, .y = y};
}
