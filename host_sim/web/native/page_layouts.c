#include "host_sim/web/native/page.h"

#include <string.h>

enum {
    COUNTS = 3,   /* numbers in front of the lists in the result */
    TANGENTS_MAX = 6000
};

static struct drawing {
    double numbers[PAGE_DRAW_NUMBERS];
    struct written written;
    struct written_fault fault;
    struct layout layout;
    struct pose starts[PAGE_ROBOTS_MAX];
    union {   /* used at different times */
        struct {
            uint8_t cells[WRITTEN_CELLS_MAX];
            uint32_t stack[WRITTEN_CELLS_MAX];
        } reach;
        struct tour_tangent tangents[TANGENTS_MAX];
    } room;
    struct tour tour;
    double out[COUNTS + (sizeof(struct layout) + sizeof(struct pose[PAGE_ROBOTS_MAX])) / sizeof(double)];
} drawing;

double *page_drawing(void)
{
    return drawing.numbers;
}

void page_write_nothing(void)
{
    written_clear(&drawing.written);
}

void page_write_list(uint32_t key, int32_t count)
{
    written_list(&drawing.written, (enum written_key)key, count);
}

double *page_write_entry(uint32_t key, uint32_t index, int32_t count)
{
    struct written_entry *entry = written_entry(&drawing.written, (enum written_key)key, index);

    if (!entry)
        return NULL;
    entry->count = count;
    return entry->numbers;
}

static struct layout_params params_of(const double numbers[PAGE_DRAW_NUMBERS])
{
    struct layout_params params = {
        .width_mm = numbers[PAGE_DRAW_WIDTH_MM],
        .height_mm = numbers[PAGE_DRAW_HEIGHT_MM],
        .body_radius_mm = numbers[PAGE_DRAW_BODY_MM],
        .sensor_reach_mm = numbers[PAGE_DRAW_REACH_MM],
        .bar_thickness_mm = numbers[PAGE_DRAW_THICKNESS_MM],
        .bar_min_mm = numbers[PAGE_DRAW_BAR_MIN_MM],
        .bar_max_mm = numbers[PAGE_DRAW_BAR_MAX_MM],
        .bar_count = (uint32_t)numbers[PAGE_DRAW_BAR_COUNT],
        .food_count = (uint32_t)numbers[PAGE_DRAW_FOOD_COUNT],
    };

    for (uint32_t i = 0; i < params.food_count; i++) {
        params.food_min_mm[i] = numbers[PAGE_DRAW_FOOD + 2 * i];
        params.food_max_mm[i] = numbers[PAGE_DRAW_FOOD + 2 * i + 1];
    }
    return params;
}

static struct reach reach(void)
{
    return (struct reach){.cells = drawing.room.reach.cells, .stack = drawing.room.reach.stack};
}

/* Appends structs that consist of doubles. */
static double *put(double *at, const void *things, size_t size)
{
    memcpy(at, things, size);
    return at + size / sizeof *at;
}

const double *page_check(void)
{
    const struct written_fault *fault = &drawing.fault;
    struct reach room = reach();

    if (written_check(&drawing.written, params_of(drawing.numbers), &room, &drawing.fault))
        return NULL;
    drawing.out[0] = fault->key;
    drawing.out[1] = fault->entry;
    drawing.out[2] = fault->value_count;
    (void)put(drawing.out + COUNTS, fault->values, sizeof fault->values);
    return drawing.out;
}

struct layout *page_drawn(void)
{
    return &drawing.layout;
}

const char *page_fault_text(void)
{
    return drawing.fault.text;
}

const double *page_draw(double seed, double number, uint32_t robots)
{
    const struct layout_which which = {(int64_t)seed, (int64_t)number, robots};
    const double *numbers = drawing.numbers;
    struct layout *layout = &drawing.layout;
    struct layout_kind kind = {(enum layout_style)numbers[PAGE_DRAW_STYLE], params_of(numbers), &drawing.written};
    struct reach room = reach();
    double *at = drawing.out + COUNTS;

    if (drawing.written.food_count > 0)
        kind.style = LAYOUT_WRITTEN;
    layout->starts = drawing.starts;
    if (!layouts_draw(&kind, &which, &room, layout))
        layout->start_count = 0;
    drawing.out[0] = layout->bar_count;
    drawing.out[1] = layout->food_count;
    drawing.out[2] = layout->start_count;
    at = put(at, layout->bars, layout->bar_count * sizeof *layout->bars);
    at = put(at, layout->food, layout->food_count * sizeof *layout->food);
    (void)put(at, layout->starts, layout->start_count * sizeof *layout->starts);
    return drawing.out;
}

double page_tour(void)
{
    const struct layout_params params = params_of(drawing.numbers);
    const struct obstacles obstacles = layout_obstacles(&drawing.layout, &params);
    struct vector places[1 + LAYOUT_FOOD_MAX] = {drawing.starts[0].at};

    memcpy(&places[1], drawing.layout.food, drawing.layout.food_count * sizeof places[0]);
    drawing.tour.tangents = drawing.room.tangents;
    drawing.tour.tangents_max = TANGENTS_MAX;
    return tour_mm(&drawing.tour, &obstacles, params.body_radius_mm, places, 1 + drawing.layout.food_count);
}
