#include "firmware/robot.h"
#include "tests/test.h"
#include "robot_rig.h"

enum { FRONT_RIGHT = 2, FRONT_LEFT = 8, DISTRUST_AFTER = 5, BACK_MM = 20, ENOUGH = 500 };

static void go_until(enum reason reason, uint8_t feel_there)
{
    unsigned ticks = 0;

    do
        obey(feel_there);
    while (out.drive.reason != reason && ++ticks < ENOUGH);
    TEST_ASSERT_EQUAL(reason, out.drive.reason);
}

/* Drives a step until the body touches something. */
static void touch(void)
{
    go_until(REASON_WANDER, CLEAR);
    wheels.bump = true;
    obey(CLEAR);
}

/* In 0.1 mm, as the wheels are told while they avoid. */
static int way_back(bool lets_go)
{
    int way = 0;

    while (out.drive.reason == REASON_AVOID) {
        way += out.drive.left_mm_s / 5;
        TEST_ASSERT_EQUAL_INT16(out.drive.left_mm_s, out.drive.right_mm_s);
        wheels.bump = wheels.bump && !lets_go;
        obey(CLEAR);
    }
    return way;
}

TEST(a_robot_that_touches_something_stops_pushing_in_that_tick)
{
    touch();
    TEST_ASSERT_EQUAL(REASON_AVOID, out.drive.reason);
    TEST_ASSERT_LESS_THAN_INT16(0, out.drive.left_mm_s);
}

TEST(it_backs_off_by_20_mm)
{
    int way;

    touch();
    way = way_back(true);
    TEST_ASSERT_INT_WITHIN(BACK_MM * 10 / 10 + 60, -BACK_MM * 10, way);
}

TEST(after_a_touch_it_turns_away_as_from_an_obstacle_in_front)
{
    int turned_deg = 0;

    learned(SIDE_LEFT);
    touch();
    (void)way_back(true);
    while (out.drive.reason != REASON_WANDER) {
        TEST_ASSERT_TRUE(out.drive.reason == REASON_LOOK_AROUND || out.drive.reason == REASON_REMEMBERED);
        if (out.drive.reason == REASON_REMEMBERED)
            turned_deg = out.drive.repeat_count * 10;
        obey(CLEAR);
    }
    TEST_ASSERT_INT_WITHIN(10, 40, turned_deg);
}

TEST(from_a_touch_it_learns_as_from_an_obstacle_in_front)
{
    touch();
    (void)way_back(true);
    go_until(REASON_TRIAL, CLEAR);
    go_until(REASON_WANDER, CLEAR);
    TEST_ASSERT_NOT_EQUAL(SIDE_NOTHING, robot.brain.memory.cell[PATTERN_FRONT]);
}

TEST(a_bumper_that_does_not_let_go_is_backed_off_from_once)
{
    touch();
    (void)way_back(false);
    for (unsigned i = 0; i < ENOUGH; i++) {
        obey(CLEAR);
        TEST_ASSERT_NOT_EQUAL(REASON_AVOID, out.drive.reason);
    }
    wheels.bump = false;
    obey(CLEAR);
    touch();
    TEST_ASSERT_EQUAL(REASON_AVOID, out.drive.reason);
}

TEST(a_touch_while_it_turns_is_no_reason_to_back_off)
{
    go_until(REASON_LOOK_AROUND, CLEAR);
    wheels.bump = true;
    obey(CLEAR);
    TEST_ASSERT_NOT_EQUAL(REASON_AVOID, out.drive.reason);
}

/* The front sensor says that something is there, always, until it is not believed. */
static void be_blind(void)
{
    command(OPCODE_SET, DISTRUST, DISTRUST_AFTER);
    go_until(REASON_WANDER, FRONT);
}

static int way_until_it_looks_aside(void)
{
    int way = 0;

    be_blind();
    for (unsigned i = 0; i < ENOUGH && out.drive.reason != REASON_AVOID; i++) {
        if (out.drive.reason == REASON_WANDER)
            way += out.drive.left_mm_s / 5;
        obey(FRONT);
    }
    return way;
}

TEST(with_longer_steps_it_looks_aside_earlier_and_not_later)
{
    command(OPCODE_SET, STEP_MM, 24);
    TEST_ASSERT_INT_WITHIN(20, 480, way_until_it_looks_aside());
}

TEST(a_robot_that_does_not_believe_its_front_sensor_looks_aside_every_60_mm)
{
    TEST_ASSERT_INT_WITHIN(20, 600, way_until_it_looks_aside());
    TEST_ASSERT_LESS_THAN_INT16(0, out.drive.left_mm_s);    /* to the left, */
    TEST_ASSERT_GREATER_THAN_INT16(0, out.drive.right_mm_s);
    while (out.drive.left_mm_s <= 0)
        obey(FRONT);
    TEST_ASSERT_EQUAL(REASON_AVOID, out.drive.reason);      /* and back again */
    TEST_ASSERT_LESS_THAN_INT16(0, out.drive.right_mm_s);
}

TEST(what_it_sees_aside_is_ahead)
{
    be_blind();
    go_until(REASON_AVOID, FRONT);
    while (out.drive.left_mm_s <= 0)
        obey(FRONT | FRONT_RIGHT);
    while (out.drive.reason == REASON_AVOID)
        obey(FRONT);
    while (out.drive.reason == REASON_LOOK_AROUND)
        obey(FRONT);
    TEST_ASSERT_TRUE(out.drive.reason == REASON_TRIAL || out.drive.reason == REASON_REMEMBERED);
}

TEST(where_something_is_ahead_it_does_not_look_aside_first)
{
    be_blind();
    go_until(REASON_LOOK_AROUND, FRONT);
    robot.caution.blind_mm = UINT8_MAX;
    while (out.drive.reason == REASON_LOOK_AROUND)
        obey(FRONT | FRONT_RIGHT);
    TEST_ASSERT_EQUAL(REASON_TRIAL, out.drive.reason);
}

TEST(what_is_ahead_is_there_until_it_has_turned_by_40_degrees_either_way)
{
    for (unsigned side = SIDE_LEFT; side <= SIDE_RIGHT; side++) {
        setUp();
        command(OPCODE_SET, LOOK_CHOICES, 1);
        learned((enum side)side);
        touch();
        (void)way_back(true);
        while (robot.caution.ahead)
            obey(CLEAR);
        TEST_ASSERT_EQUAL(REASON_REMEMBERED, out.drive.reason);
        TEST_ASSERT_INT_WITHIN(1, 4, out.drive.repeat_count);
    }
}

/* Else it would learn that the turn has helped. */
TEST(what_a_blind_robot_turns_toward_is_ahead)
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

TEST(a_start_forgets_what_was_ahead)
{
    touch();
    command(OPCODE_START, PROFILE_ARTICLE, 1);
    TEST_ASSERT_FALSE(robot.caution.ahead);
}

/* The next action of a robot that caution alone commands, or of one that looks around. */
static struct action next(struct caution *caution, uint8_t feel_there, bool bump)
{
    struct senses senses = {.feel = feel_there, .bump = bump};

    return caution_next(caution, &robot.brain, &robot.config, &senses);
}

TEST(it_backs_off_once_for_each_touch_and_rests_a_tick_afterwards)
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

TEST(a_look_aside_is_24_degrees_to_the_left_and_back)
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

/* What is beside it is what the sensor on the side of its turn shows; in a step nothing is. */
TEST(what_is_beside_a_turn_is_what_the_sensor_on_its_side_shows)
{
    static const uint8_t all = 31;
    struct caution caution = {.blind_mm = 60};

    (void)next(&caution, 16 | 1, false);   /* neither is a front sensor: left is looked at */
    TEST_ASSERT_EQUAL_UINT8(0, caution.beside);
    for (unsigned i = 0; i < MANY; i++) {
        uint8_t there = i % 2 ? all : FRONT_LEFT;
        struct action action = next(&caution, there, false);
        uint8_t side = action.turn_deg < 0 ? FRONT_LEFT : FRONT_RIGHT;

        TEST_ASSERT_EQUAL_UINT8(action.turn_deg == 0 ? 0 : there & side, caution.beside);
    }
}

TEST(what_was_ahead_counts_until_just_40_degrees)
{
    static const int8_t turns[] = {39, -39, 16, -16, 15, -15};

    for (unsigned i = 0; i < sizeof turns; i++) {
        struct caution caution = {.doing = 3, .ahead = true, .turned_deg = turns[i]};   /* it turns back by 24 */

        (void)next(&caution, CLEAR, false);
        TEST_ASSERT_EQUAL(turns[i] + 24 < 40, caution.ahead);
        TEST_ASSERT_EQUAL_INT8(caution.ahead ? turns[i] + 24 : 0, caution.turned_deg);
    }
}

TEST(what_a_blind_robot_finds_is_ahead_from_there_on)
{
    struct caution caution = {.beside = FRONT_RIGHT, .turned_deg = 5, .blind_mm = 30};

    caution_see(&caution, CLEAR, true);
    TEST_ASSERT_TRUE(caution.ahead);
    TEST_ASSERT_EQUAL_INT8(0, caution.turned_deg);
    TEST_ASSERT_EQUAL_UINT8(30, caution.blind_mm);
    caution_see(&caution, CLEAR, false);
    TEST_ASSERT_EQUAL_UINT8(0, caution.blind_mm);
}

TEST(nothing_is_beside_a_step_back_and_it_is_no_way_driven_blind)
{
    struct caution caution = {.doing = 1, .beside = FRONT_LEFT, .blind_mm = 30};   /* it touches something */

    TEST_ASSERT_EQUAL_INT(-BACK_MM, next(&caution, FRONT_LEFT | FRONT_RIGHT, true).forward_mm);
    TEST_ASSERT_EQUAL_UINT8(0, caution.beside);
    TEST_ASSERT_EQUAL_UINT8(30, caution.blind_mm);
}

TEST(what_is_ahead_is_shown_by_the_front_sensor_alone)
{
    struct senses senses = {.feel = CLEAR};
    struct caution caution = {.ahead = true};

    (void)caution_next(&caution, &robot.brain, &robot.config, &senses);
    TEST_ASSERT_EQUAL_UINT8(FRONT, senses.feel);
}

TEST(what_was_ahead_is_not_after_just_40_degrees_to_the_left)
{
    unsigned found = 0;

    learned(SIDE_LEFT);
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
