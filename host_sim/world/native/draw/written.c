#include "host_sim/world/native/draw/written.h"

#include <ctype.h>
#include <math.h>
#include <stdarg.h>
#include <string.h>

#include "host_sim/world/native/trig.h"

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

static const double NUMBER_MAX = 1e9;   /* far beyond any arena */

static const struct form {
    int32_t count;
    const char *numbers;
} FORMS[] = {
    [WRITTEN_SIZE] = {2, "[width, height]"},
    [WRITTEN_START] = {3, "[x, y, heading]"},
    [WRITTEN_FOOD] = {2, "[x, y]"},
    [WRITTEN_BARS] = {4, "[x, y, x, y]"},
};

/* A world while it is checked. */
struct check {
    const struct written *written;
    struct layout_params params;
    struct reach *reach;
    struct written_fault *fault;
};

void written_clear(struct written *written)
{
    memset(written, 0, sizeof *written);
    written->size.count = written->start.count = WRITTEN_LEFT_OUT;
}

void written_list(struct written *written, enum written_key key, int32_t count)
{
    *(key == WRITTEN_FOOD ? &written->food_count : &written->bar_count) = count;
}

struct written_entry *written_entry(struct written *written, enum written_key key, uint32_t index)
{
    switch (key) {
    case WRITTEN_SIZE:
        return &written->size;
    case WRITTEN_START:
        return &written->start;
    case WRITTEN_FOOD:
        return index < WRITTEN_FOOD_MAX ? &written->food[index] : NULL;
    default:
        return index < WRITTEN_BARS_MAX ? &written->bars[index] : NULL;
    }
}

static struct vector point(const struct written_entry *entry, unsigned first)
{
    return (struct vector){entry->numbers[first], entry->numbers[first + 1]};
}

void written_lay_out(const struct written *written, struct layout *out)
{
    out->bar_count = (uint32_t)written->bar_count;
    out->food_count = (uint32_t)written->food_count;
    for (uint32_t i = 0; i < out->bar_count; i++)
        out->bars[i] = (struct bar){point(&written->bars[i], 0), point(&written->bars[i], 2)};
    for (uint32_t i = 0; i < out->food_count; i++)
        out->food[i] = point(&written->food[i], 0);
}

static bool check_list(const struct check *it, enum written_key key, int32_t count, int32_t most)
{
    if (count >= 0 && count <= most)
        return true;
    return written_fails(it->fault, key, -1, " must be a list of at most %g lists, such as [[...], [...]]",
                         (double)most);
}

static bool check_numbers(const struct check *it, enum written_key key, int32_t index,
                          const struct written_entry *entry)
{
    const struct form *form = &FORMS[key];
    bool good = entry->count == form->count;

    for (int32_t i = 0; good && i < form->count; i++)
        good = fabs(entry->numbers[i]) < NUMBER_MAX;
    return good
        || written_fails(it->fault, key, index, " must be %s: %g numbers", form->numbers, (double)form->count);
}

static bool check_inside(const struct check *it, enum written_key key, int32_t index, struct vector at)
{
    double width = it->params.width_mm, height = it->params.height_mm;

    if (at.x >= 0 && at.x <= width && at.y >= 0 && at.y <= height)
        return true;
    return written_fails(it->fault, key, index, ": [%g, %g] is outside of the arena, whose size is [%g, %g]",
                         at.x, at.y, width, height);
}

static bool check_place(const struct check *it, enum written_key key, int32_t index,
                        const struct written_entry *entry)
{
    return check_numbers(it, key, index, entry) && check_inside(it, key, index, point(entry, 0));
}

static bool check_size(struct check *it)
{
    const struct written_entry *size = &it->written->size;
    double width = size->numbers[0], height = size->numbers[1], least = WRITTEN_SIZE_MIN_MM;

    if (size->count == WRITTEN_LEFT_OUT)
        return true;
    if (!check_numbers(it, WRITTEN_SIZE, -1, size))
        return false;
    if (fmin(width, height) < least || width > WRITTEN_WIDTH_MAX_MM || height > WRITTEN_HEIGHT_MAX_MM)
        return written_fails(it->fault, WRITTEN_SIZE, -1, " must be [width, height] in mm, from [%g, %g] to [%g, %g]",
                             least, least, (double)WRITTEN_WIDTH_MAX_MM, (double)WRITTEN_HEIGHT_MAX_MM);
    it->params.width_mm = width;
    it->params.height_mm = height;
    return true;
}

static bool check_bar(const struct check *it, int32_t index)
{
    const struct written_entry *bar = &it->written->bars[index];
    struct vector a = point(bar, 0), b = point(bar, 2);
    double least = it->params.bar_thickness_mm;

    if (!check_place(it, WRITTEN_BARS, index, bar) || !check_inside(it, WRITTEN_BARS, index, b))
        return false;
    return trig_hypot(b.x - a.x, b.y - a.y) >= least
           || written_fails(it->fault, WRITTEN_BARS, index, " must be at least %g mm long", least);
}

static bool check_bars(const struct check *it)
{
    bool good = check_list(it, WRITTEN_BARS, it->written->bar_count, WRITTEN_BARS_MAX);

    for (int32_t i = 0; good && i < it->written->bar_count; i++)
        good = check_bar(it, i);
    return good;
}

static bool check_food(const struct check *it)
{
    bool good = check_list(it, WRITTEN_FOOD, it->written->food_count, WRITTEN_FOOD_MAX);

    for (int32_t i = 0; good && i < it->written->food_count; i++)
        good = check_place(it, WRITTEN_FOOD, i, &it->written->food[i]);
    if (good && it->written->food_count == 0)
        return written_fails(it->fault, WRITTEN_FOOD, -1, "a world needs food, such as food = [[3500, 400]]");
    return good;
}

static bool check_start(const struct check *it)
{
    const struct written_entry *start = &it->written->start;

    return start->count == WRITTEN_LEFT_OUT || check_place(it, WRITTEN_START, -1, start);
}

static bool check_room(const struct check *it, const struct obstacles *obstacles, int32_t place)
{
    const struct written_entry *entry = place < 0 ? &it->written->start : &it->written->food[place];
    enum written_key key = place < 0 ? WRITTEN_START : WRITTEN_FOOD;
    double room = clearance_mm(obstacles, point(entry, 0)), needed = layout_room_mm(&it->params);

    if (room >= needed)
        return true;
    if (room <= 0)
        return written_fails(it->fault, key, place, " is inside an obstacle; %g mm are needed", needed);
    return written_fails(it->fault, key, place, " is only %g mm away from an obstacle or a wall; %g mm are needed",
                         nearbyint(room), needed);
}

/* Whether there is room at each position, and a path from the first to all others, as layouts_draw has it. */
static bool check_fair(const struct check *it)
{
    struct layout layout;
    struct obstacles obstacles;
    int32_t count = it->written->food_count, first = it->written->start.count == WRITTEN_LEFT_OUT ? 0 : -1;
    const struct written_entry *from = first < 0 ? &it->written->start : &it->written->food[0];

    written_lay_out(it->written, &layout);
    obstacles = layout_obstacles(&layout, &it->params);
    for (int32_t place = first; place < count; place++)
        if (!check_room(it, &obstacles, place))
            return false;
    reach_find(it->reach, &obstacles, it->params.body_radius_mm, point(from, 0));
    for (int32_t i = 0; i < count; i++)
        if (!reach_has(it->reach, layout.food[i]))
            return written_fails(it->fault, WRITTEN_FOOD, i,
                                 " cannot be reached from %s: the robot does not fit through",
                                 first < 0 ? "the start" : "food 1");
    return true;
}

bool written_check(const struct written *written, struct layout_params params, struct reach *reach,
                   struct written_fault *out)
{
    struct check it = {written, params, reach, out};

    return check_size(&it) && check_bars(&it) && check_food(&it) && check_start(&it) && check_fair(&it);
}
