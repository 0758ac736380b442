#include "host_sim/world/native/munk_space.h"

#include <unity.h>

#include "tests/world/fake_munk.h"

enum { OBSTACLE = 1, DISC = 2 };

static struct world world;

void setUp(void)
{
    fake_open(&world, 2, 0);
}

void tearDown(void) {}

static void owner(struct munk_arbiter *arbiter, struct munk_space *space, void *data)
{
    (void)arbiter;
    (void)space;
    (void)data;
}

static void test_handlers_are_given_back_as_they_were(void)
{
    struct munk_handler *handler;

    munk_space_return(&fake_space);
    handler = fake_handler(DISC, OBSTACLE);
    handler->begin = handler->pre_solve = handler->separate = owner;
    handler->data = &world;
    munk_space_borrow(&fake_space, &world);
    TEST_ASSERT_TRUE(handler->begin != owner && handler->pre_solve != owner && handler->separate != owner);
    munk_space_return(&fake_space);
    TEST_ASSERT_TRUE(handler->begin == owner && handler->pre_solve == owner && handler->separate == owner);
    TEST_ASSERT_EQUAL_PTR(&world, handler->data);
}

static void test_every_pair_of_every_body_is_borrowed(void)
{
    TEST_ASSERT_EQUAL_size_t(MUNK_LOANS + 2 * MUNK_LOANS_EACH, fake.handler_count);
    TEST_ASSERT_EQUAL_size_t(fake.handler_count, fake_space.loan_count);
    munk_space_return(&fake_space);
    TEST_ASSERT_EQUAL_size_t(0, fake_space.loan_count);
}

static void test_the_space_has_the_body_at_its_pose(void)
{
    world.bodies[0].heading_rad = 0.5;
    world.space->place(&world, &world.bodies[0]);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, fake.position.x);
    TEST_ASSERT_EQUAL_DOUBLE(0.5, fake.angle);
    TEST_ASSERT_EQUAL_DOUBLE(0.02, fake.step_s);
}

static void test_the_space_has_a_lifted_body_in_the_air(void)
{
    world.bodies[0].lifted = true;
    world.space->place(&world, &world.bodies[0]);
    TEST_ASSERT_EQUAL_DOUBLE(-10000.0, fake.position.x);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, world.bodies[0].x_mm);
}

static void move(double x_mm)
{
    world.bodies[0].x_mm = x_mm;
    world.space->place(&world, &world.bodies[0]);
}

static void test_a_body_that_is_alone_is_only_placed_where_it_could_feel_something(void)
{
    world.body_count = 1;
    fake.nearest_mm = 260.0;
    move(1000.0);
    move(1099.0);
    TEST_ASSERT_EQUAL_size_t(1, fake.steps);
    move(1100.0);
    TEST_ASSERT_EQUAL_size_t(2, fake.steps);
    TEST_ASSERT_EQUAL_DOUBLE(1100.0, fake.position.x);
}

static void test_in_the_open_nothing_is_as_near_as_one_looks(void)
{
    world.body_count = 1;
    fake.nearest_mm = 5000.0;
    move(1000.0);
    move(1600.0);
    TEST_ASSERT_EQUAL_size_t(1, fake.steps);
    move(1650.0);
    TEST_ASSERT_EQUAL_size_t(2, fake.steps);
}

static void test_near_an_obstacle_and_with_others_a_body_is_always_placed(void)
{
    fake.nearest_mm = 260.0;
    move(1000.0);
    move(1001.0);
    TEST_ASSERT_EQUAL_size_t(2, fake.steps);
    world.body_count = 1;
    fake.nearest_mm = 160.0;
    move(1002.0);
    move(1003.0);
    TEST_ASSERT_EQUAL_size_t(4, fake.steps);
    fake.nearest_mm = 260.0;
    world.bodies[0].feel = FEEL_FRONT;
    move(1004.0);
    move(1005.0);
    TEST_ASSERT_EQUAL_size_t(6, fake.steps);
}

static void test_a_space_is_given_back_with_the_body_at_its_place(void)
{
    world.body_count = 1;
    fake.nearest_mm = 260.0;
    move(1000.0);
    move(1050.0);
    munk_space_return(&fake_space);
    TEST_ASSERT_EQUAL_DOUBLE(1050.0, fake.position.x);
}

static void test_what_is_in_a_bodys_line_of_sight_hides(void)
{
    fake_space.places[1].sight.group = 7;
    TEST_ASSERT_FALSE(world.space->hides(&world, &world.bodies[1], (struct vector){0.0, 0.0}));
    fake.hides = true;
    TEST_ASSERT_TRUE(world.space->hides(&world, &world.bodies[1], (struct vector){0.0, 0.0}));
    TEST_ASSERT_EQUAL_UINT(7, fake.sight.group);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_handlers_are_given_back_as_they_were);
    RUN_TEST(test_every_pair_of_every_body_is_borrowed);
    RUN_TEST(test_the_space_has_the_body_at_its_pose);
    RUN_TEST(test_the_space_has_a_lifted_body_in_the_air);
    RUN_TEST(test_a_body_that_is_alone_is_only_placed_where_it_could_feel_something);
    RUN_TEST(test_in_the_open_nothing_is_as_near_as_one_looks);
    RUN_TEST(test_near_an_obstacle_and_with_others_a_body_is_always_placed);
    RUN_TEST(test_a_space_is_given_back_with_the_body_at_its_place);
    RUN_TEST(test_what_is_in_a_bodys_line_of_sight_hides);
    return UNITY_END();
}
