#include "host_sim/web/native/page.h"

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
        .capsules = of->capsules,
        .places = of->places,
        .touching = of->touching,
    };
    of->ranges = (struct ranges){
        .capsules = of->capsules,
        .body_radius_mm = d[PAGE_BODY_MM],
        .reach_mm = d[PAGE_BODY_MM] + d[PAGE_REACH_MM],
        .front_extra_mm = d[PAGE_FRONT_EXTRA_MM],
    };
    cones_set(&of->cones, d[PAGE_BODY_MM] + d[PAGE_REACH_MM], d[PAGE_FRONT_EXTRA_MM]);
    of->world.bodies = of->bodies;
    of->world.food = of->food;
}

double *page_dimensions(void)
{
    return page_state()->dimensions;
}

void page_build(void)
{
    struct page_world *of = page_world();
    const double *dimensions = page_state()->dimensions;

    set_world(of, dimensions);
    of->world.body_count = page_state()->loop.robot_count;
    capsule_set_walls(of->capsules, dimensions[PAGE_WIDTH_MM], dimensions[PAGE_HEIGHT_MM]);
    page_state()->loop.world = &of->world;
}

void page_put_obstacle(uint32_t index, double ax_mm, double ay_mm, double bx_mm, double by_mm, double radius_mm)
{
    struct vector a = {ax_mm, ay_mm}, b = {bx_mm, by_mm};

    capsule_set(&page_world()->capsules[WALLS + index], a, b, radius_mm);
}

void page_put_food(uint32_t index, double x_mm, double y_mm)
{
    struct food *food = &page_world()->food[index];

    food->x_mm = x_mm;
    food->y_mm = y_mm;
}

void page_put_body(uint32_t robot, double x_mm, double y_mm, double heading_rad)
{
    struct body *body = &page_world()->bodies[robot];

    body->x_mm = x_mm;
    body->y_mm = y_mm;
    body->heading_rad = heading_rad;
    body->lifted = false;
}

void page_lift(uint32_t robot)
{
    page_world()->bodies[robot].lifted = true;
}

const char *page_break(uint32_t robot, uint32_t seed)
{
    return body_faults_add(&page_world()->bodies[robot].faults, page_state()->text, seed, robot);
}

static void count_obstacles(uint32_t obstacles)
{
    struct page_world *of = page_world();

    of->space.capsule_count = WALLS + obstacles;
    of->ranges.capsule_count = of->space.capsule_count;
    of->space.words = PLAIN_WORDS(of->space.capsule_count + of->world.body_count);
}

/* A body that has come from another environment has rolled as far as it has; of the rest it knows nothing. */
static void begin_body(struct body *body)
{
    *body = (struct body){
        .x_mm = body->x_mm,
        .y_mm = body->y_mm,
        .heading_rad = body->heading_rad,
        .left_mm = body->left_mm,
        .right_mm = body->right_mm,
        .faults = body->faults,
        .seen = -1,
    };
}

/* What the bodies overlap where they are now is not new to them. */
static void take_space(uint32_t obstacles)
{
    struct page_world *of = page_world();

    count_obstacles(obstacles);
    for (size_t i = 0; i < sizeof of->touching / sizeof of->touching[0]; i++)
        of->touching[i] = 0;
    world_begin(&of->world);
    plain_space_take(&of->space, &of->world);
}

void page_measure(uint32_t robot, uint8_t *range_mm)
{
    struct page_world *of = page_world();

    ranges_measure(&of->ranges, &of->world, &of->bodies[robot], range_mm);
}

void page_enter(uint32_t obstacles, uint32_t food)
{
    struct page_world *of = page_world();

    of->world.food_count = food;
    for (uint32_t i = 0; i < food; i++)
        of->food[i].eaten = false;
    for (size_t i = 0; i < of->world.body_count; i++) {
        begin_body(&of->bodies[i]);
        page_state()->robots[i].food_eaten = 0;
    }
    take_space(obstacles);
}

void page_settle(uint32_t obstacles)
{
    take_space(obstacles);
}

uint32_t page_run(uint32_t tick, uint32_t ticks_max)
{
    struct loop *loop = &page_state()->loop;

    loop->tick = tick;
    loop_run(loop, ticks_max);
    return loop->ticks;
}

uint32_t page_is_eaten(uint32_t food)
{
    return page_world()->food[food].eaten;
}

const int16_t *page_rows(uint32_t robot)
{
    return page_state()->robots[robot].rows;
}

const double *page_poses(uint32_t robot)
{
    return page_state()->robots[robot].poses;
}
