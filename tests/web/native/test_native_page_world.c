/* The world of a page: objects in it, and robots that drive. */
#include "page_rig.h"

#include <string.h>

enum { TICKS = 50 };

static struct pose starts[ROBOTS];

/* Robots far apart that look along x, in an arena of 4 m by 3 m, without anything until a test adds to page_drawn(). */
static void build(void)
{
    static const double dimensions[PAGE_DIMENSIONS] = {
        [PAGE_WIDTH_MM] = 4000.0, [PAGE_HEIGHT_MM] = 3000.0, [PAGE_BODY_MM] = 100.0, [PAGE_TRACK_MM] = 160.0,
        [PAGE_REACH_MM] = 60.0, [PAGE_FRONT_EXTRA_MM] = 0.5, [PAGE_BEAM_MM] = 100.0, [PAGE_EAT_MM] = 150.0,
        [PAGE_TICK_S] = 0.02, [PAGE_SPEED_MM_S] = 500.0, [PAGE_THICKNESS_MM] = 40.0,
    };

    memcpy(page_numbers(), dimensions, sizeof dimensions);
    page_build();
    *page_drawn() = (struct layout){.starts = starts, .start_count = ROBOTS};
    for (uint32_t i = 0; i < ROBOTS; i++) {
        starts[i] = (struct pose){{1000.0, 1000.0 + 1000.0 * i}, 0.0};
        start(i, PROFILE_ARTICLE);
    }
}

static const char *edit(enum edit_kind kind, uint32_t robot, const double place[2], const char *what)
{
    memset(page_numbers(), 0, PAGE_NUMBERS * sizeof(double));
    page_numbers()[PAGE_EDIT_ROBOT] = robot;
    page_numbers()[PAGE_EDIT_RADIUS] = 40.0;
    page_numbers()[PAGE_EDIT_HEADING] = 1500.0;
    memcpy(page_numbers() + PAGE_EDIT_AT, place, 2 * sizeof *place);
    strcpy(page_text(), what);
    return page_edit((int32_t)kind);
}

static struct body *body(uint32_t robot)
{
    return &page_state()->world.bodies[robot];
}

static const int16_t *row(uint32_t robot, unsigned tick)
{
    return page_rows(robot) + tick * ROW_COUNT;
}

TEST(robots_drive_and_are_recorded)
{
    build();
    page_enter();
    TEST_ASSERT_EQUAL_UINT32(TICKS, page_run(7, TICKS));
    TEST_ASSERT_EQUAL_INT16(7, row(0, 0)[0]);
    TEST_ASSERT_EQUAL_INT16(7 + TICKS - 1, row(1, TICKS - 1)[0]);
    TEST_ASSERT_GREATER_THAN_DOUBLE(1000.0, page_poses(0)[0]);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, page_poses(0)[1]);
    TEST_ASSERT_EQUAL_DOUBLE(body(1)->x_mm, page_poses(1)[(TICKS - 1) * LOOP_POSE]);
    TEST_ASSERT_EQUAL_UINT(TICKS, logged("101"));
    TEST_ASSERT_EQUAL_UINT(TICKS, logged("041"));
}

TEST(walls_and_bars_are_sensed_at_their_positions)
{
    build();
    starts[0].at.x = 3870.0;
    page_drawn()->bars[0] = (struct bar){{1150.0, 1900.0}, {1150.0, 2100.0}};
    page_drawn()->bar_count = 1;
    page_enter();
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT_RIGHT | FEEL_FRONT | FEEL_FRONT_LEFT, body(0)->feel);
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT_RIGHT | FEEL_FRONT | FEEL_FRONT_LEFT, body(1)->feel);
    (void)page_run(0, 1);
    TEST_ASSERT_EQUAL_INT16(REASON_TRIAL, row(1, 0)[ROW_REASON]);
}

TEST(added_plant_is_sensed_until_removed)
{
    build();
    page_enter();
    TEST_ASSERT_NULL(edit(EDIT_KIND_PLANT, 0, (double[]){1180.0, 2000.0}, ""));
    TEST_ASSERT_NOT_EQUAL_UINT8(0, body(1)->feel);
    TEST_ASSERT_NULL(edit(EDIT_KIND_REMOVE_PLANT, 0, (double[]){0.0, 0.0}, ""));
    TEST_ASSERT_EQUAL_UINT8(0, body(1)->feel);
    TEST_ASSERT_EQUAL_STRING("there is no such number", edit(EDIT_KIND_REMOVE_PLANT, 0, (double[]){0.0, 0.0}, ""));
}

TEST(scene_lists_all_objects_with_their_ids)
{
    static const double expected[] = {1, 1, 2, 0, 3000, 100, 3000, 200, 0, 2000, 2500, 40, 500, 600, 0, 700, 800, 1};

    build();
    page_drawn()->bars[0] = (struct bar){{3000.0, 100.0}, {3000.0, 200.0}};
    page_drawn()->food[0] = (struct vector){500.0, 600.0};
    page_drawn()->food[1] = (struct vector){700.0, 800.0};
    page_drawn()->bar_count = 1;
    page_drawn()->food_count = 2;
    page_enter();
    TEST_ASSERT_NULL(edit(EDIT_KIND_PLANT, 0, (double[]){2000.0, 2500.0}, ""));
    page_state()->world.food[1].eaten = true;
    TEST_ASSERT_EQUAL_DOUBLE_ARRAY(expected, page_scene(), sizeof expected / sizeof *expected);
}

TEST(eaten_food_returns_in_the_next_environment)
{
    const struct food *food = page_state()->world.food;

    build();
    page_drawn()->food[0] = (struct vector){3000.0, 500.0};
    page_drawn()->food[1] = (struct vector){1250.0, 1000.0};
    page_drawn()->food_count = 2;
    page_enter();
    (void)page_run(0, TICKS);
    TEST_ASSERT_FALSE(food[0].eaten);
    TEST_ASSERT_TRUE(food[1].eaten);
    TEST_ASSERT_EQUAL_UINT32(1, page_state()->robots[0].food_eaten);
    TEST_ASSERT_NULL(edit(EDIT_KIND_MOVE_FOOD, 0, (double[]){5.0, 6.0}, ""));
    TEST_ASSERT_EQUAL_DOUBLE(6.0, food[0].y_mm);
    TEST_ASSERT_TRUE(food[1].eaten);
    page_enter();
    TEST_ASSERT_FALSE(food[1].eaten);
    TEST_ASSERT_EQUAL_UINT32(0, page_state()->robots[0].food_eaten);
}

TEST(entering_an_environment_keeps_only_odometers)
{
    build();
    page_enter();
    (void)page_run(0, TICKS);
    body(0)->collisions = 3;
    body(0)->seen = 1;
    page_enter();
    TEST_ASSERT_GREATER_THAN_DOUBLE(0.0, body(0)->left_mm);
    TEST_ASSERT_GREATER_THAN_DOUBLE(0.0, body(0)->right_mm);
    TEST_ASSERT_EQUAL_INT32(0, body(0)->collisions);
    TEST_ASSERT_EQUAL_INT32(-1, body(0)->seen);
}

TEST(lifted_robot_stays_lifted_until_it_is_put_down)
{
    build();
    page_enter();
    TEST_ASSERT_NULL(edit(EDIT_KIND_LIFT, 0, (double[]){0.0, 0.0}, ""));
    (void)page_run(0, 1);
    TEST_ASSERT_EQUAL_INT16(1, row(0, 0)[ROW_LIFTED]);
    TEST_ASSERT_EQUAL_INT16(0, row(1, 0)[ROW_LIFTED]);
    TEST_ASSERT_NULL(edit(EDIT_KIND_PUT, 0, (double[]){500.0, 600.0}, ""));
    TEST_ASSERT_FALSE(body(0)->lifted);
    TEST_ASSERT_EQUAL_DOUBLE(500.0, body(0)->x_mm);
    TEST_ASSERT_EQUAL_DOUBLE(600.0, body(0)->y_mm);
    TEST_ASSERT_EQUAL_DOUBLE(1.5, body(0)->heading_rad);
}

static const char *set_body_fault(uint32_t robot, const char *what)
{
    return edit(EDIT_KIND_BODY, robot, (double[]){0.0, 0.0}, what);
}

TEST(body_fault_is_set_from_its_text)
{
    build();
    page_enter();
    TEST_ASSERT_NULL(set_body_fault(1, "stuck-on:front"));
    TEST_ASSERT_EQUAL_STRING("write mirror", set_body_fault(1, "mirror:left"));
    TEST_ASSERT_EQUAL_UINT8(FEEL_FRONT, body(1)->faults.stuck_on);
    TEST_ASSERT_EQUAL_UINT8(0, body(0)->faults.stuck_on);
}

/* Its motors are dead: its actions are denied, it stops by itself, and a report is requested. */
TEST(robot_that_stops_by_itself_is_reported_and_can_start)
{
    uint32_t tick = 0;

    build();
    page_enter();
    TEST_ASSERT_NULL(set_body_fault(0, "weak-motor:left:0%"));
    TEST_ASSERT_NULL(set_body_fault(0, "weak-motor:right:0%"));
    while (tick < 5000 && !page_has_halted(0))
        tick += page_run(tick, PAGE_TICKS_MAX);
    TEST_ASSERT_TRUE(page_has_halted(0));
    TEST_ASSERT_FALSE(page_has_halted(1));
    TEST_ASSERT_EQUAL_UINT(1, logged("021"));   /* the command for a report */
    start(0, PROFILE_ARTICLE);
    TEST_ASSERT_FALSE(page_has_halted(0));
}
