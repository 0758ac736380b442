#include "tests/program/native/program_rig.h"

#include "tests/test.h"

void setUp(void)
{
    rig_reset();
}

static void is(struct action action, enum reason reason, int forward_mm, int turn_deg)
{
    TEST_ASSERT_EQUAL(reason, action.reason);
    TEST_ASSERT_EQUAL(forward_mm, action.forward_mm);
    TEST_ASSERT_EQUAL(turn_deg, action.turn_deg);
}

TEST(a_pixel_is_5_mm_and_right_is_positive)
{
    is(rig_begin("rForward 2.4\nrTurn -10\nrForward -4\nrTurn 0.6"), REASON_WANDER, 12, 0);
    is(rig_next(), REASON_PROGRAM, 0, -10);
    is(rig_next(), REASON_WANDER, -20, 0);
    is(rig_next(), REASON_PROGRAM, 0, 1);
}

TEST(a_command_for_nothing_takes_no_time)
{
    is(rig_begin("rForward 0\nrTurn 0.4\ndelay 0\nrTurn 5"), REASON_PROGRAM, 0, 5);
}

TEST(a_long_way_is_driven_in_parts_and_ends_at_an_obstacle)
{
    is(rig_begin("rForward 100\nrTurn 7"), REASON_WANDER, 150, 0);
    is(rig_next(), REASON_WANDER, 150, 0);
    senses.feel = FEEL_FRONT;
    is(rig_next(), REASON_PROGRAM, 0, 7);
}

TEST(a_long_way_back_is_driven_whatever_is_ahead)
{
    senses.feel = FEEL_FRONT;
    is(rig_begin("rForward -40"), REASON_WANDER, -150, 0);
    is(rig_next(), REASON_WANDER, -50, 0);
}

TEST(delay_rests_for_as_many_ticks_as_it_takes)
{
    TEST_ASSERT_EQUAL(0, rig_begin("delay 15\ndelay 2000\ndelay 6000\nrTurn 5").rest_ticks);
    TEST_ASSERT_EQUAL(99, rig_next().rest_ticks);
    TEST_ASSERT_EQUAL(249, rig_next().rest_ticks);
    TEST_ASSERT_EQUAL(49, rig_next().rest_ticks);
    is(rig_next(), REASON_PROGRAM, 0, 5);
}

TEST(a_range_is_that_of_the_sensor_in_its_direction)
{
    senses = (struct senses){.range_mm = {10, 20, 30, 40, RANGE_NONE}};
    (void)rig_begin("a=rRange()\nb=rRange(45)\nc=rRange(90)\nd=rRange(-30)\ne=rRange(-90)\nf=rRange(22)");
    TEST_ASSERT_EQUAL_DOUBLE(6, rig_value("a"));
    TEST_ASSERT_EQUAL_DOUBLE(4, rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(2, rig_value("c"));
    TEST_ASSERT_EQUAL_DOUBLE(8, rig_value("d"));
    TEST_ASSERT_EQUAL_DOUBLE(800, rig_value("e"));
    TEST_ASSERT_EQUAL_DOUBLE(6, rig_value("f"));
    TEST_ASSERT_TRUE(program.measures);
}

TEST(it_senses_what_the_robot_senses)
{
    senses = (struct senses){.feel = FEEL_FRONT_RIGHT | FEEL_RIGHT, .look = true, .beacon_mm = 149, .bump = true};
    (void)rig_begin("a=rFeel()\nb=rLook(0)=Green\nc=rBeacon(Green)\nd=rBumper()\ne=rBeacon(Red)\nf=rLook()");
    TEST_ASSERT_EQUAL_DOUBLE(FEEL_FRONT_RIGHT | FEEL_RIGHT, rig_value("a"));
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(29, rig_value("c"));
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("d"));
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("e"));
    TEST_ASSERT_EQUAL_DOUBLE(2, rig_value("f"));
}

TEST(food_that_is_seen_is_never_at_no_distance)
{
    senses = (struct senses){.look = true, .beacon_mm = 3};
    (void)rig_begin("c=rBeacon(Green)");
    TEST_ASSERT_EQUAL_DOUBLE(1, rig_value("c"));
}

TEST(random_numbers_are_the_firmware_s)
{
    struct random random = brain.random;
    double expected[3] = {random_below(&random, 2), random_below(&random, 60), random_next(&random) % 1000};

    (void)rig_begin("a=random(2)\nb=random(60)\nc=random(1000)");
    TEST_ASSERT_EQUAL_DOUBLE(expected[0], rig_value("a"));
    TEST_ASSERT_EQUAL_DOUBLE(expected[1], rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(expected[2], rig_value("c"));
}

TEST(mem_is_what_the_robot_has_learned)
{
    brain.memory.cell[5] = SIDE_LEFT;
    (void)rig_begin("a=Mem[5]\nMem[5]=2\nMem[6]=1");
    TEST_ASSERT_EQUAL_DOUBLE(SIDE_LEFT, rig_value("a"));
    TEST_ASSERT_EQUAL(SIDE_RIGHT, brain.memory.cell[5]);
    TEST_ASSERT_EQUAL(SIDE_LEFT, brain.memory.cell[6]);
    TEST_ASSERT_TRUE(brain.changed);
}

TEST(a_frozen_robot_learns_nothing)
{
    brain.frozen = true;
    (void)rig_begin("Mem[5]=2\na=Mem[5]");
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("a"));
    TEST_ASSERT_EQUAL(SIDE_NOTHING, brain.memory.cell[5]);
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(what_is_in_mem_already_is_no_news)
{
    (void)rig_begin("Mem[5]=0");
    TEST_ASSERT_FALSE(brain.changed);
}

TEST(a_program_that_keeps_mem_does_what_it_does_for_the_firmware_s_reasons)
{
    senses.feel = FEEL_FRONT;
    is(rig_begin("x=rFeel()\nrTurn 45\nMem[2]=1\nx=rFeel()\nrTurn -10\nrTurn 160\nrForward 1\nrTurn 4\nx=rFeel()\nrTurn 3"), REASON_TRIAL, 0, 45);
    is(rig_next(), REASON_REMEMBERED, 0, -10);
    TEST_ASSERT_EQUAL(1, brain.repeat_count);
    is(rig_next(), REASON_BOREDOM, 0, 160);
    is(rig_next(), REASON_WANDER, 5, 0);
    TEST_ASSERT_EQUAL(0, brain.repeat_count);
    is(rig_next(), REASON_LOOK_AROUND, 0, 4);
    senses.feel = 0;
    is(rig_next(), REASON_LOOK_AROUND, 0, 3);
}

TEST(a_step_with_food_ahead_goes_toward_it_and_eats_at_a_word)
{
    senses = (struct senses){.look = true, .beacon_mm = 100};
    is(rig_begin("rForward 2\nrEat"), REASON_TOWARD_FOOD, 10, 0);
    is(rig_next(), REASON_EAT, 0, 0);
}

TEST(a_program_that_has_ended_rests)
{
    is(rig_begin("x=1"), REASON_PROGRAM, 0, 0);
    TEST_ASSERT_EQUAL(PROGRAM_ENDED, program.state);
    is(rig_next(), REASON_PROGRAM, 0, 0);
}

TEST(where_it_is_comes_from_its_wheels)
{
    (void)rig_begin("rLocate 400,300,-90\nrForward 20\nx=rGPSx()\ny=rGPSy()\nrTurn 100\na=rCompass()\nrForward 1\nrLocate 5,6\nb=rCompass()");
    senses.odometer_left = senses.odometer_right = 1000;
    (void)rig_next();
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 380, rig_value("x"));
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 300, rig_value("y"));
    senses.odometer_left = 1100;
    (void)rig_next();
    TEST_ASSERT_EQUAL_DOUBLE(10, rig_value("a"));
    TEST_ASSERT_DOUBLE_WITHIN(0.001, 380, program.x_mm / 5);
    (void)rig_next();
    TEST_ASSERT_EQUAL_DOUBLE(0, rig_value("b"));
    TEST_ASSERT_EQUAL_DOUBLE(30, program.y_mm);
}
