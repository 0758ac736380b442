/* A body that restarts in the middle of a turn: its odometers begin anew at 0, and the turn goes on where it was. */
#include "firmware/robot.h"

#include <stdlib.h>

#include "tests/test.h"
#include "robot_rig.h"

enum {
    TRIAL_COUNTS = 1257, TWO_DEGREES = 56,   /* left wheel less right wheel: 45 degrees are 1256.6 counts, one is 27.9 */
    SILENCE_MS = 100, TICK = 20
};

static const unsigned OUTAGES_MS[] = {50, 100, 300, 1000};

/* How far the wheels are from one body's odometers to the next, right positive. */
static int turned(const struct senses *from)
{
    int left = (wheels.odometer_left - from->odometer_left) & (ODOMETER_SPAN - 1);
    int right = (wheels.odometer_right - from->odometer_right) & (ODOMETER_SPAN - 1);

    return (left < ODOMETER_SPAN / 2 ? left : left - ODOMETER_SPAN)
        - (right < ODOMETER_SPAN / 2 ? right : right - ODOMETER_SPAN);
}

/* A body whose odometers show these when a trial begins obeys for some ticks; the senses after that are yet to come.
 * Returns how far it has turned. */
static int turn_for(unsigned ticks, uint16_t left, uint16_t right)
{
    struct senses begun;

    setUp();
    wheels.odometer_left = left;
    wheels.odometer_right = right;
    obey(FRONT);
    begun = wheels;
    while (ticks-- > 0)
        obey(FRONT);
    return turned(&begun);
}

static void stay_away_for(unsigned ms)
{
    for (unsigned silent_ms = SILENCE_MS; silent_ms <= ms; silent_ms += SILENCE_MS)
        silence();
    wheels.tick = (uint8_t)(wheels.tick + ms / TICK);
}

/* Carries the trial on with a body whose odometers show these. Returns how far that turns it. */
static int turn_on_from(uint16_t left, uint16_t right)
{
    const struct senses anew = {.odometer_left = left, .odometer_right = right};
    const uint8_t trial = robot.action;

    wheels.odometer_left = left;
    wheels.odometer_right = right;
    sense(wheels);
    while (robot.action == trial)
        obey(FRONT);
    return turned(&anew);
}

TEST(a_body_that_restarts_turns_no_farther_than_it_was_told)
{
    for (unsigned i = 0; i < sizeof OUTAGES_MS / sizeof *OUTAGES_MS; i++)
        for (uint16_t left = 7; left < ODOMETER_SPAN; left += 130)
            for (uint16_t right = 5; right < ODOMETER_SPAN; right += 170) {
                int way = turn_for(5, left, right);

                stay_away_for(OUTAGES_MS[i]);
                way += turn_on_from(0, 0);
                TEST_ASSERT_INT_WITHIN(TWO_DEGREES, TRIAL_COUNTS, abs(way));
            }
}

TEST(a_restart_is_counted)
{
    (void)turn_for(5, 300, 300);
    stay_away_for(300);
    wheels.odometer_left = wheels.odometer_right = 0;
    sense(wheels);
    TEST_ASSERT_TRUE(out.contradiction);
}

/* It holds its last drive for 100 ms, and then stands. */
TEST(what_a_body_rolled_in_silence_is_part_of_its_turn)
{
    for (unsigned i = 0; i < sizeof OUTAGES_MS / sizeof *OUTAGES_MS; i++) {
        int way = turn_for(2, 1000, 1000);
        int held = (int)(OUTAGES_MS[i] < SILENCE_MS ? OUTAGES_MS[i] : SILENCE_MS) / TICK * (out.drive.left_mm_s / 5);

        stay_away_for(OUTAGES_MS[i]);
        way += 2 * held + turn_on_from((uint16_t)(wheels.odometer_left + held), (uint16_t)(wheels.odometer_right - held));
        TEST_ASSERT_INT_WITHIN(TWO_DEGREES, TRIAL_COUNTS, abs(way));
        TEST_ASSERT_FALSE(out.contradiction);
    }
}

/* Whatever the number of its tick: a body may begin anew with that, too. */
TEST(in_silence_wheels_roll_no_farther_than_a_drive_is_held)
{
    for (unsigned silences = 0; silences <= 21; silences++) {
        setUp();
        obey(CLEAR);
        stay_away_for(SILENCE_MS * silences);
        wheels.odometer_left = wheels.odometer_right = 500;
        wheels.tick += 200;
        sense(wheels);
        TEST_ASSERT_TRUE(out.contradiction);
    }
}

TEST(a_body_that_has_stood_at_0_all_the_time_has_not_restarted)
{
    obey(CLEAR);
    stay_away_for(300);
    wheels.odometer_left = wheels.odometer_right = 0;
    sense(wheels);
    TEST_ASSERT_FALSE(out.contradiction);
}

TEST(stopping_the_robot_clears_the_backlog)
{
    robot.motion.apart.counts = robot.motion.together.counts = 100;
    command(OPCODE_STOP, 0, 0);
    TEST_ASSERT_EQUAL_INT32(0, robot.motion.apart.counts);
    TEST_ASSERT_EQUAL_INT32(0, robot.motion.together.counts);
    TEST_ASSERT_FALSE(robot.motion.referenced);
}
