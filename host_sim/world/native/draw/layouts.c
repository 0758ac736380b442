#include "host_sim/world/native/draw/layout.h"

#include <math.h>
#include <string.h>

#include "host_sim/world/native/draw/draw.h"
#include "host_sim/world/native/trig.h"

enum { TRIES = 1000, DIGITS_MAX = 20 };

/* Appends a space and a whole number to a text. */
static void append_number(char *text, int64_t number)
{
    char digits[DIGITS_MAX + 1] = "", *at = digits + DIGITS_MAX;
    uint64_t rest = number < 0 ? 0 - (uint64_t)number : (uint64_t)number;

    do {
        *--at = (char)('0' + rest % 10);
    } while (rest /= 10);
    strcat(text, number < 0 ? " -" : " ");
    strcat(text, at);
}

/* Seeds the draws with a text: seed, number, and what is drawn. */
static void seed_draws(struct draws *draws, const struct layout_which *which, const char *what)
{
    char text[DRAWS_TEXT_MAX] = "octet";

    append_number(text, which->seed);
    append_number(text, which->number);
    strcat(text, what);
    draws_seed(draws, text);
}

static void draw(struct draws *draws, const struct layout_kind *kind, struct reach *reach, struct layout *out)
{
    switch (kind->style) {
    case LAYOUT_BARS:
        draw_bars(draws, &kind->params, out);
        break;
    case LAYOUT_CORRIDORS:
        draw_corridors(draws, &kind->params, out);
        break;
    case LAYOUT_DEAD_ENDS:
        draw_dead_ends(draws, &kind->params, out);
        break;
    case LAYOUT_WRITTEN:
        draw_written(draws, kind, reach, out);
        break;
    }
}

/* Whether start and food have room, and all food can be reached; leaves in `reach` the cells that can be. */
static bool is_fair(const struct layout *layout, const struct layout_params *params, struct reach *reach)
{
    struct obstacles obstacles = layout_obstacles(layout, params);
    double room = layout_room_mm(params);

    if (!clearance_suffices(&obstacles, layout->starts[0].at, room))
        return false;
    for (uint32_t i = 0; i < layout->food_count; i++)
        if (!clearance_suffices(&obstacles, layout->food[i], room))
            return false;
    reach_find(reach, &obstacles, params->body_radius_mm, layout->starts[0].at);
    for (uint32_t i = 0; i < layout->food_count; i++)
        if (!reach_has(reach, layout->food[i]))
            return false;
    return true;
}

/* Whether a start is out of the other robots' sensor range. */
static bool is_apart(struct vector at, const struct layout *layout, const struct layout_params *params)
{
    for (uint32_t i = 0; i < layout->start_count; i++) {
        struct vector other = layout->starts[i].at;

        if (trig_hypot(at.x - other.x, at.y - other.y) - params->body_radius_mm < layout_room_mm(params))
            return false;
    }
    return true;
}

/* Start poses have random numbers of their own: the layout is the same for any number of robots. */
static void add_starts(const struct layout_kind *kind, const struct layout_which *which, const struct reach *reach,
                       struct layout *out)
{
    struct obstacles obstacles = layout_obstacles(out, &kind->params);
    double room = layout_room_mm(&kind->params);
    struct draws draws;

    seed_draws(&draws, which, " starts");
    for (unsigned i = 0; i < TRIES && out->start_count < which->robots; i++) {
        struct pose pose = draw_pose(&draws, &kind->params);

        if (reach_has(reach, pose.at) && clearance_suffices(&obstacles, pose.at, room)
            && is_apart(pose.at, out, &kind->params))
            out->starts[out->start_count++] = pose;
    }
}

bool layouts_draw(const struct layout_kind *kind, const struct layout_which *which, struct reach *reach,
                  struct layout *out)
{
    struct draws draws;

    seed_draws(&draws, which, "");
    for (unsigned i = 0; i < TRIES; i++) {
        draw(&draws, kind, reach, out);
        if (is_fair(out, &kind->params, reach)) {
            if (which->robots > 1)
                add_starts(kind, which, reach, out);
            return true;
        }
    }
    return false;
}
