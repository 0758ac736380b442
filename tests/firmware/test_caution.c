#include "firmware/robot.h"
#include "tests/test.h"
#include "robot_rig.h"

enum { FRONT_RIGHT = 2, FRONT_LEFT = 8, DISTRUST_AFTER = 5, BACK_MM = 20, TICKS_MAX = 500 };

static void go_until(enum reason reason, uint8_t feel)
{
    unsigned ticks = 0;

    do
        obey(feel);
    while (out.drive.reason != reason && ++ticks < TICKS_MAX);
    TEST_ASSERT_EQUAL(reason, out.drive.reason);
}

/* Lets the bumper close during a step. */
static void close_bumper(void)
{
    go_until(REASON_WANDER, CLEAR);
    wheels.bump = true;
    obey(CLEAR);
}

/* The distance commanded while backing off, in 0.1 mm. */
static int back_off(bool releases)
{
    int way = 0;

    while (out.drive.reason == REASON_AVOID) {
        way += out.drive.left_mm_s / 5;
        TEST_ASSERT_EQUAL_INT16(out.drive.left_mm_s, out.drive.right_mm_s);
        wheels.bump = wheels.bump && !releases;
        obey(CLEAR);
    }
    return way;
}

TEST(bump_reverses_the_wheels_in_the_same_tick)
{
    close_bumper();
    TEST_ASSERT_EQUAL(REASON_AVOID, out.drive.reason);
    TEST_ASSERT_LESS_THAN_INT16(0, out.drive.left_mm_s);
}

TEST(bump_backs_the_robot_off_by_20_mm)
{
    int way;

    close_bumper();
    way = back_off(true);
    TEST_ASSERT_INT_WITHIN(BACK_MM * 10 / 10 + 60, -BACK_MM * 10, way);
}

TEST(bump_is_turned_away_from_like_an_obstacle_in_front)
{
    int turned_deg = 0;

    teach(SIDE_LEFT);
    close_bumper();
    (void)back_off(true);
    while (out.drive.reason != REASON_WANDER) {
        TEST_ASSERT_TRUE(out.drive.reason == REASON_LOOK_AROUND || out.drive.reason == REASON_REMEMBERED);
        if (out.drive.reason == REASON_REMEMBERED)
            turned_deg = out.drive.repeat_count * 10;
        obey(CLEAR);
    }
    TEST_ASSERT_INT_WITHIN(10, 40, turned_deg);
}

TEST(bump_teaches_like_an_obstacle_in_front)
{
    close_bumper();
    (void)back_off(true);
    go_until(REASON_TRIAL, CLEAR);
    go_until(REASON_WANDER, CLEAR);
    TEST_ASSERT_NOT_EQUAL(SIDE_NOTHING, robot.brain.memory.cell[PATTERN_FRONT]);
}

TEST(stuck_bumper_is_backed_off_from_once)
{
    close_bumper();
    (void)back_off(false);
    for (unsigned i = 0; i < TICKS_MAX; i++) {
        obey(CLEAR);
        TEST_ASSERT_NOT_EQUAL(REASON_AVOID, out.drive.reason);
    }
    wheels.bump = false;
    obey(CLEAR);
    close_bumper();
    TEST_ASSERT_EQUAL(REASON_AVOID, out.drive.reason);
}

TEST(bump_in_a_turn_causes_no_backing_off)
{
    go_until(REASON_LOOK_AROUND, CLEAR);
    wheels.bump = true;
    obey(CLEAR);
    TEST_ASSERT_NOT_EQUAL(REASON_AVOID, out.drive.reason);
}

/* Triggers the front sensor until the robot distrusts it. */
static void distrust_front_sensor(void)
{
    command(OPCODE_SET, DISTRUST, DISTRUST_AFTER);
    go_until(REASON_WANDER, FRONT);
}

static int distance_until_look_aside(void)
{
    int way = 0;

    distrust_front_sensor();
    for (unsigned i = 0; i < TICKS_MAX && out.drive.reason != REASON_AVOID; i++) {
        if (out.drive.reason == REASON_WANDER)
            way += out.drive.left_mm_s / 5;
        obey(FRONT);
    }
    return way;
}

TEST(look_aside_comes_early_with_longer_steps)
{
    command(OPCODE_SET, STEP_MM, 24);
    TEST_ASSERT_INT_WITHIN(20, 480, distance_until_look_aside());
}

TEST(distrusted_front_sensor_causes_a_look_aside_every_60_mm)
{
    TEST_ASSERT_INT_WITHIN(20, 600, distance_until_look_aside());
    TEST_ASSERT_LESS_THAN_INT16(0, out.drive.left_mm_s);    /* to the left, */
    TEST_ASSERT_GREATER_THAN_INT16(0, out.drive.right_mm_s);
    while (out.drive.left_mm_s <= 0)
        obey(FRONT);
    TEST_ASSERT_EQUAL(REASON_AVOID, out.drive.reason);      /* and back again */
    TEST_ASSERT_LESS_THAN_INT16(0, out.drive.right_mm_s);
}

TEST(obstacle_seen_in_a_look_aside_is_ahead)
{
    distrust_front_sensor();
    go_until(REASON_AVOID, FRONT);
    while (out.drive.left_mm_s <= 0)
        obey(FRONT | FRONT_RIGHT);
    while (out.drive.reason == REASON_AVOID)
        obey(FRONT);
    while (out.drive.reason == REASON_LOOK_AROUND)
        obey(FRONT);
    TEST_ASSERT_TRUE(out.drive.reason == REASON_TRIAL || out.drive.reason == REASON_REMEMBERED);
}

TEST(obstacle_ahead_prevents_the_look_aside)
{
    distrust_front_sensor();
    go_until(REASON_LOOK_AROUND, FRONT);
    robot.caution.blind_mm = UINT8_MAX;
    while (out.drive.reason == REASON_LOOK_AROUND)
        obey(FRONT | FRONT_RIGHT);
    TEST_ASSERT_EQUAL(REASON_TRIAL, out.drive.reason);
}

TEST(obstacle_ahead_is_kept_until_a_turn_of_40_degrees)
{
    for (unsigned side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        setUp();
        command(OPCODE_SET, LOOK_CHOICES, 1);
        teach((enum side)side);
        close_bumper();
        (void)back_off(true);
        while (robot.caution.ahead)
            obey(CLEAR);
        TEST_ASSERT_EQUAL(REASON_REMEMBERED, out.drive.reason);
        TEST_ASSERT_INT_WITHIN(1, 4, out.drive.repeat_count);
    }
}

/* Otherwise the robot would learn that the turn has helped. */
TEST(obstacle_turned_toward_blindly_is_ahead)
{
    struct caution caution = {.doing = 0};

    caution.beside = FRONT_LEFT;
    caution_see(&caution, CLEAR, false);
    TEST_ASSERT_FALSE(caution.ahead);
    caution_see(&caution, FRONT_LEFT, true);
    TEST_ASSERT_FALSE(caution.ahead);
    caution_see(&caution, CLEAR, true);
    TEST_ASSERT_TRUE(caution.ahead);
}

TEST(start_clears_the_obstacle_ahead)
{
    close_bumper();
    command(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_FALSE(robot.caution.ahead);
}

/* The next action: one of caution, or else of the brain. */
static struct action next(struct caution *caution, uint8_t feel, bool bump)
{
    struct senses senses = {.feel = feel, .bump = bump};

    return caution_next(caution, &robot.brain, &robot.config, &senses);
}

TEST(bump_backs_off_once_and_rests_a_tick)
{
    static const struct senses touching = {.bump = true};
    struct caution caution = {.doing = 0};
    struct action action;

    caution.turned_deg = 7;
    TEST_ASSERT_FALSE(caution_stops(&caution, &touching, false));
    TEST_ASSERT_TRUE(caution_stops(&caution, &touching, true));
    action = next(&caution, CLEAR, true);
    TEST_ASSERT_EQUAL(REASON_AVOID, action.reason);
    TEST_ASSERT_EQUAL_INT(-BACK_MM, action.forward_mm);
    TEST_ASSERT_EQUAL_INT(0, action.turn_deg);
    TEST_ASSERT_EQUAL_UINT(1, action.rest_ticks);
    TEST_ASSERT_TRUE(caution.ahead);
    TEST_ASSERT_EQUAL_INT8(0, caution.turned_deg);
    TEST_ASSERT_FALSE(caution.pressed);
    TEST_ASSERT_NOT_EQUAL(REASON_AVOID, next(&caution, CLEAR, true).reason);
    TEST_ASSERT_TRUE(caution.pressed);
    TEST_ASSERT_FALSE(caution_stops(&caution, &touching, true));
    TEST_ASSERT_TRUE(caution.pressed);
    (void)caution_stops(&caution, &(struct senses){.bump = false}, true);
    TEST_ASSERT_FALSE(caution.pressed);
}

TEST(look_aside_is_24_degrees_to_the_left_and_back)
{
    struct caution caution = {.blind_mm = 60};
    struct action action = next(&caution, CLEAR, false);

    TEST_ASSERT_EQUAL(REASON_AVOID, action.reason);
    TEST_ASSERT_EQUAL_INT(-24, action.turn_deg);
    TEST_ASSERT_EQUAL_UINT(1, action.rest_ticks);
    TEST_ASSERT_EQUAL_UINT8(0, caution.blind_mm);
    action = next(&caution, CLEAR, true);
    TEST_ASSERT_EQUAL_INT(24, action.turn_deg);
    TEST_ASSERT_FALSE(caution.pressed);
    TEST_ASSERT_NOT_EQUAL(REASON_AVOID, next(&caution, CLEAR, false).reason);
    caution.blind_mm = 61;
    TEST_ASSERT_EQUAL_INT(-24, next(&caution, CLEAR, false).turn_deg);
    caution = (struct caution){.blind_mm = 59};
    TEST_ASSERT_NOT_EQUAL(REASON_AVOID, next(&caution, CLEAR, false).reason);
}

/* An obstacle is beside a turn if the sensor on its side shows it; beside a step there is none. */
TEST(obstacle_beside_a_turn_is_that_of_the_sensor_on_its_side)
{
    static const uint8_t all = 31;
    struct caution caution = {.blind_mm = 60};

    (void)next(&caution, 16 | 1, false);   /* neither is a front sensor; the look aside is to the left */
    TEST_ASSERT_EQUAL_UINT8(0, caution.beside);
    for (unsigned i = 0; i < MANY; i++) {
        uint8_t there = i % 2 ? all : FRONT_LEFT;
        struct action action = next(&caution, there, false);
        uint8_t side = action.turn_deg < 0 ? FRONT_LEFT : FRONT_RIGHT;

        TEST_ASSERT_EQUAL_UINT8(action.turn_deg == 0 ? 0 : there & side, caution.beside);
    }
}

TEST(obstacle_ahead_is_cleared_at_40_degrees_to_the_right)
{
    static const int8_t turns[] = {39, -39, 16, -16, 15, -15};

    for (unsigned i = 0; i < sizeof turns; i++) {
        struct caution caution = {.doing = 3, .ahead = true, .turned_deg = turns[i]};   /* it turns back by 24 */

        (void)next(&caution, CLEAR, false);
        TEST_ASSERT_EQUAL(turns[i] + 24 < 40, caution.ahead);
        TEST_ASSERT_EQUAL_INT8(caution.ahead ? turns[i] + 24 : 0, caution.turned_deg);
    }
}

TEST(blind_sighting_restarts_the_angle_of_the_obstacle_ahead)
{
    struct caution caution = {.beside = FRONT_RIGHT, .turned_deg = 5, .blind_mm = 30};

    caution_see(&caution, CLEAR, true);
    TEST_ASSERT_TRUE(caution.ahead);
    TEST_ASSERT_EQUAL_INT8(0, caution.turned_deg);
    TEST_ASSERT_EQUAL_UINT8(30, caution.blind_mm);
    caution_see(&caution, CLEAR, false);
    TEST_ASSERT_EQUAL_UINT8(0, caution.blind_mm);
}

TEST(step_back_has_no_obstacle_beside_and_no_blind_distance)
{
    struct caution caution = {.doing = 1, .beside = FRONT_LEFT, .blind_mm = 30};   /* backing off */

    TEST_ASSERT_EQUAL_INT(-BACK_MM, next(&caution, FRONT_LEFT | FRONT_RIGHT, true).forward_mm);
    TEST_ASSERT_EQUAL_UINT8(0, caution.beside);
    TEST_ASSERT_EQUAL_UINT8(30, caution.blind_mm);
}

TEST(obstacle_ahead_triggers_only_the_front_sensor)
{
    struct senses senses = {.feel = CLEAR};
    struct caution caution = {.ahead = true};

    (void)caution_next(&caution, &robot.brain, &robot.config, &senses);
    TEST_ASSERT_EQUAL_UINT8(FRONT, senses.feel);
}

TEST(obstacle_ahead_is_cleared_at_40_degrees_to_the_left)
{
    unsigned found = 0;

    teach(SIDE_LEFT);
    for (unsigned i = 0; i < MANY; i++) {
        struct caution caution = {.ahead = true, .turned_deg = -30};
        struct action action = next(&caution, CLEAR, false);

        if (action.turn_deg == -10) {
            found++;
            TEST_ASSERT_FALSE(caution.ahead);
        }
    }
    TEST_ASSERT_GREATER_THAN_UINT(0, found);
}
