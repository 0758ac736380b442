#include "host_sim/web/native/page.h"

#include <string.h>

#include "hal/protocol/e2e.h"
#include "octet.h"

static struct page_world *page_world(void)
{
    return &page_state()->world;
}

static void set_world(struct page_world *of, const double dimensions[PAGE_DIMENSIONS])
{
    const double *d = dimensions;

    of->world.params = (struct world_params){
        .wheel_track_mm = d[PAGE_TRACK_MM],
        .beam_width_mm = d[PAGE_BEAM_MM],
        .eat_reach_mm = d[PAGE_EAT_MM],
        .tick_s = d[PAGE_TICK_S],
        .max_wheel_speed_mm_s = d[PAGE_SPEED_MM_S],
    };
    of->space = (struct plain_world){
        .body_radius_mm = d[PAGE_BODY_MM],
        .cones = &of->cones,
        .capsules = of->furniture.capsules,
        .places = of->places,
        .touching = of->touching,
    };
    of->ranges = (struct ranges){
        .capsules = of->furniture.capsules,
        .body_radius_mm = d[PAGE_BODY_MM],
        .reach_mm = d[PAGE_BODY_MM] + d[PAGE_REACH_MM],
        .front_extra_mm = d[PAGE_FRONT_EXTRA_MM],
    };
    of->furniture = (struct furniture){
        .width_mm = d[PAGE_WIDTH_MM],
        .height_mm = d[PAGE_HEIGHT_MM],
        .bar_radius_mm = d[PAGE_THICKNESS_MM] / 2,
        .body_radius_mm = d[PAGE_BODY_MM],
    };
    of->kit_ranges = of->ranges;
    if (of->is_real) {
        of->kit_ranges.reach_mm = d[PAGE_BODY_MM] + kit_reach_mm(&of->kind);
        of->kit_ranges.front_extra_mm = 0.0;
    }
    cones_set(&of->cones, of->kit_ranges.reach_mm, of->kit_ranges.front_extra_mm);
    of->world.bodies = of->bodies;
    of->world.food = of->food;
}

/* Rebuilds the space from the furniture. What the bodies already overlap is no new contact. */
static void take_furniture(struct page_world *of)
{
    of->space.capsule_count = of->ranges.capsule_count = of->kit_ranges.capsule_count = of->furniture.capsule_count;
    world_begin(&of->world);
    plain_space_take(&of->space, &of->world);
}

void page_set_bodies(uint32_t is_real, uint32_t is_kit)
{
    struct page_world *of = page_world();

    of->is_real = is_real != 0;
    kit_set_kind(&of->kind, is_kit != 0);
}

bool page_set_trait(double value, double tolerance)
{
    struct kit_kind *kind = &page_world()->kind;

    for (unsigned i = 0; i < TRAIT_COUNT; i++) {
        const struct trait_row *row = &KIT_TRAITS[i];

        if (strcmp(row->name, page_text()) == 0 && value >= row->least && value <= row->most && tolerance >= 0.0) {
            kind->trait[i] = value;
            kind->tolerance[i] = tolerance;
            return true;
        }
    }
    return false;
}

void page_draw_bodies(uint32_t seed)
{
    struct page_world *of = page_world();

    for (uint32_t i = 0; i < of->world.body_count; i++) {
        of->kits[i].ranges = &of->kit_ranges;
        kit_draw(&of->kits[i], of->is_real ? &of->kind : NULL, seed, i);
        of->bodies[i].kit = &of->kits[i];
    }
}

void page_build(void)
{
    struct page_world *of = page_world();

    set_world(of, page_numbers());
    furniture_set(&of->furniture, NULL, 0);
    of->world.body_count = page_state()->loop.robot_count;
    page_state()->loop.world = &of->world;
    take_furniture(of);
}

/* A body in a new environment keeps its odometry, faults and traits; all else starts afresh. */
static void begin_body(struct body *body, const struct pose *start)
{
    *body = (struct body){
        .x_mm = start->at.x,
        .y_mm = start->at.y,
        .heading_rad = start->heading_rad,
        .left_mm = body->left_mm,
        .right_mm = body->right_mm,
        .faults = body->faults,
        .kit = body->kit,
        .seen = -1,
    };
}

void page_enter(void)
{
    struct page_world *of = page_world();
    const struct layout *layout = page_drawn();

    furniture_set(&of->furniture, layout->bars, layout->bar_count);
    of->world.food_count = layout->food_count;
    for (size_t i = 0; i < layout->food_count; i++)
        of->food[i] = (struct food){layout->food[i].x, layout->food[i].y, false};
    for (size_t i = 0; i < of->world.body_count; i++) {
        begin_body(&of->bodies[i], &layout->starts[i]);
        page_state()->robots[i].food_eaten = 0;
    }
    take_furniture(of);
}

static struct vector place_at(unsigned first)
{
    return (struct vector){page_numbers()[first], page_numbers()[first + 1]};
}

const char *page_edit(int32_t kind)
{
    struct page_world *of = page_world();
    const double *numbers = page_numbers();
    struct edit edit = {
        .kind = kind,
        .id = (uint32_t)numbers[PAGE_EDIT_ID],
        .robot = (uint32_t)numbers[PAGE_EDIT_ROBOT],
        .seed = (uint32_t)numbers[PAGE_EDIT_SEED],
        .a = place_at(PAGE_EDIT_A),
        .b = place_at(PAGE_EDIT_B),
        .at = place_at(PAGE_EDIT_AT),
        .heading = numbers[PAGE_EDIT_HEADING],
        .radius = numbers[PAGE_EDIT_RADIUS],
    };
    const char *why;

    memcpy(edit.what, page_text(), sizeof edit.what);
    why = edit_make(&of->furniture, &of->world, &edit);
    if (!why)
        take_furniture(of);
    return why;
}

static double *put(double *at, const double numbers[], size_t count)
{
    memcpy(at, numbers, count * sizeof *at);
    return at + count;
}

const double *page_scene(void)
{
    static double scene[3 + 5 * FURNITURE_BARS_MAX + 4 * FURNITURE_PLANTS_MAX + 3 * LAYOUT_FOOD_MAX];
    const struct page_world *of = page_world();
    const struct furniture *furniture = &of->furniture;
    const double counts[] = {(double)furniture->bar_count, (double)furniture->plant_count,
                             (double)of->world.food_count};
    double *at = put(scene, counts, 3);

    for (size_t i = 0; i < furniture->bar_count; i++) {
        const struct bar *bar = &furniture->bars[i];

        at = put(at, (double[]){furniture->bar_ids[i], bar->a.x, bar->a.y, bar->b.x, bar->b.y}, 5);
    }
    for (size_t i = 0; i < furniture->plant_count; i++) {
        const struct plant *plant = &furniture->plants[i];

        at = put(at, (double[]){furniture->plant_ids[i], plant->at.x, plant->at.y, plant->radius_mm}, 4);
    }
    for (size_t i = 0; i < of->world.food_count; i++)
        at = put(at, (double[]){of->food[i].x_mm, of->food[i].y_mm, of->food[i].eaten}, 3);
    return scene;
}

void page_send_ranges(uint32_t robot, uint32_t tick)
{
    struct page_world *of = page_world();
    const struct loop_robot *to = &page_state()->robots[robot];
    uint8_t range[FEEL_COUNT];
    struct frame frame = {.id = wire_id(&page_octet(robot)->wire, OCTET_RANGES_FRAME_ID), .len = OCTET_RANGES_LENGTH};
    struct octet_ranges_t message = {
        .counter = e2e_next(to->senses_counter),
        .tick = (uint8_t)(tick & (TICK_SPAN - 1)),
    };

    world_measure(&of->world, &of->bodies[robot], tick, &of->ranges, range);
    message.range_right = range[0];
    message.range_front_right = range[1];
    message.range_front = range[2];
    message.range_front_left = range[3];
    message.range_left = range[4];
    (void)octet_ranges_pack(frame.data, &message, sizeof frame.data);
    e2e_protect(&frame);
    log_lines_add(&page_state()->loop.log, &frame);
    page_hear(robot, &frame);
}

uint32_t page_run(uint32_t tick, uint32_t ticks_max)
{
    struct loop *loop = &page_state()->loop;

    loop->tick = tick;
    loop_run(loop, ticks_max);
    return loop->ticks;
}

const int16_t *page_rows(uint32_t robot)
{
    return page_state()->robots[robot].rows;
}

const double *page_poses(uint32_t robot)
{
    return page_state()->robots[robot].poses;
}
