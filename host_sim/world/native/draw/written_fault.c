#include "host_sim/world/native/draw/written_fault.h"

#include <ctype.h>
#include <stdarg.h>
#include <string.h>

static const char *const WHOLE[] = {"size", "the start", "food", "bars"};
static const char *const ONE[] = {"", "", "food %g", "bar %g"};

static void say(struct written_fault *fault, const char *text, size_t len)
{
    size_t used = strlen(fault->text), left = WRITTEN_TEXT_MAX - 1 - used;

    memcpy(fault->text + used, text, len < left ? len : left);
}

static void add_value(struct written_fault *fault, double value)
{
    if (fault->value_count < WRITTEN_VALUES_MAX)
        fault->values[fault->value_count++] = value;
}

static void name_entry(struct written_fault *fault)
{
    const char *name = (fault->entry < 0 ? WHOLE : ONE)[fault->key];

    say(fault, name, strlen(name));
    if (fault->entry >= 0)
        add_value(fault, fault->entry + 1);
}

bool written_fails(struct written_fault *fault, enum written_key key, int32_t entry, const char *words, ...)
{
    va_list rest;

    *fault = (struct written_fault){.key = (int32_t)key, .entry = entry};
    if (!isalpha((unsigned char)*words))
        name_entry(fault);
    va_start(rest, words);
    for (; *words; words++) {
        if (strncmp(words, "%g", 2) == 0)
            add_value(fault, va_arg(rest, double));
        if (strncmp(words, "%s", 2) == 0) {
            const char *text = va_arg(rest, const char *);

            say(fault, text, strlen(text));
            words++;
        } else {
            say(fault, words, 1);
        }
    }
    va_end(rest);
    return false;
}
