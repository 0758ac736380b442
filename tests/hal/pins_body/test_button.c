#include "hal/pins_body/button.h"
#include "tests/test.h"

enum { SECOND = 50, PRESS = 10 };   /* ticks */

static struct button button;
static struct command told;
static unsigned tellings;
static bool running;

void setUp(void)
{
    button = (struct button){.down = false};
    tellings = 0;
    running = false;
}

static void look(bool pressed, unsigned ticks)
{
    for (unsigned i = 0; i < ticks; i++)
        tellings += button_look(&button, pressed, running, &told);
}

static void press(unsigned ticks)
{
    look(true, ticks);
    look(false, PRESS);
}

TEST(one_press_starts_the_first_profile_a_second_later)
{
    press(PRESS);
    look(false, SECOND - PRESS - 1);
    TEST_ASSERT_EQUAL_UINT(0, tellings);
    look(false, PRESS);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
    TEST_ASSERT_EQUAL_INT(OPCODE_START, told.opcode);
    TEST_ASSERT_EQUAL_UINT8(0, told.which);
    look(false, 10 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
}

TEST(as_many_presses_start_that_profile)
{
    for (unsigned i = 0; i < 3; i++)
        press(PRESS);
    look(false, SECOND);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
    TEST_ASSERT_EQUAL_UINT8(2, told.which);
}

TEST(after_the_last_profile_comes_the_first)
{
    for (unsigned i = 0; i < PROFILE_COUNT + 1; i++)
        press(PRESS);
    look(false, SECOND);
    TEST_ASSERT_EQUAL_UINT8(0, told.which);
}

TEST(a_press_stops_a_running_robot_at_once_when_it_ends)
{
    running = true;
    press(PRESS);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
    TEST_ASSERT_EQUAL_INT(OPCODE_STOP, told.opcode);
    running = false;
    look(false, 10 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
}

TEST(held_for_five_seconds_it_forgets_and_does_not_start)
{
    look(true, 5 * SECOND + 2);
    TEST_ASSERT_EQUAL_UINT(0, tellings);
    look(true, 1);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
    TEST_ASSERT_EQUAL_INT(OPCODE_ERASE, told.opcode);
    look(true, 10 * SECOND);
    look(false, 10 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
}

TEST(held_while_it_runs_it_forgets_and_goes_on)
{
    running = true;
    press(6 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
    TEST_ASSERT_EQUAL_INT(OPCODE_ERASE, told.opcode);
}

TEST(contacts_that_bounce_are_no_press)
{
    for (unsigned i = 0; i < SECOND; i++) {
        look(true, 2);
        look(false, 1);
    }
    look(false, 2 * SECOND);
    TEST_ASSERT_EQUAL_UINT(0, tellings);
}

TEST(it_starts_exactly_a_second_after_it_is_known_to_be_let_go)
{
    look(true, PRESS);
    look(false, 3 + SECOND - 1);
    TEST_ASSERT_EQUAL_UINT(0, tellings);
    look(false, 1);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
}

TEST(while_it_is_pressed_again_nothing_starts)
{
    press(PRESS);
    look(true, 2 * SECOND);
    TEST_ASSERT_EQUAL_UINT(0, tellings);
}

TEST(a_contact_that_bounces_just_after_a_press_is_known_makes_no_second_one)
{
    look(true, 3);
    look(false, 2);
    look(true, PRESS);
    look(false, 2 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
    TEST_ASSERT_EQUAL_UINT8(0, told.which);
}

TEST(presses_before_a_stop_start_nothing_later)
{
    press(PRESS);
    running = true;
    press(PRESS);
    running = false;
    look(false, 2 * SECOND);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
    TEST_ASSERT_EQUAL_INT(OPCODE_STOP, told.opcode);
    TEST_ASSERT_EQUAL_UINT8(0, told.which);
}

TEST(after_it_has_forgotten_it_can_be_started)
{
    press(6 * SECOND);
    TEST_ASSERT_EQUAL_UINT8(0, told.which);
    TEST_ASSERT_EQUAL_UINT16(PRESS - 3, button.ticks);
    press(PRESS);
    look(false, SECOND);
    TEST_ASSERT_EQUAL_UINT(2, tellings);
    TEST_ASSERT_EQUAL_INT(OPCODE_START, told.opcode);
}

TEST(its_time_stays_at_the_end_however_long_it_is_held)
{
    look(true, 400 * SECOND);
    TEST_ASSERT_EQUAL_UINT16(5 * SECOND, button.ticks);
    TEST_ASSERT_EQUAL_UINT(1, tellings);
}
