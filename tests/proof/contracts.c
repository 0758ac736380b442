/* The robot's contracts: each function brings it into any state that fits what it says, and gives it any input of a kind.
 * What may not be written then is in test_proof.py. */
#include "firmware/behaviours/behaviour.h"
#include "tests/proof/any/robot.h"

static void begin(void)
{
    take_any_state();
    take_any_input();
}

/* A drive, if there is one, has both wheels at rest. */
static void check_rest(void)
{
    //@ assert at_rest: !out.has_drive || (out.drive.left_mm_s == 0 && out.drive.right_mm_s == 0);
}

void silence(void)
{
    begin();
    respond(INPUT_SILENCE);
    check_rest();
}

void another_robots_memory(void)
{
    begin();
    respond(INPUT_PEER);
    check_rest();
}

void any_command(void)
{
    begin();
    respond(INPUT_COMMAND);
    check_rest();
}

void command_that_is_not_about_the_memory(void)
{
    static const uint8_t others[] = {
        OPCODE_STOP, OPCODE_RESUME, OPCODE_SET, OPCODE_FREEZE, OPCODE_GET, OPCODE_REPORT, UINT8_MAX,
    };

    begin();
    in.command.opcode = (enum opcode)others[any_between(0, sizeof others - 1)];
    respond(INPUT_COMMAND);
}

void any_senses(void)
{
    begin();
    respond(INPUT_SENSES);
}

void senses_of_a_stopped_robot(void)
{
    begin();
    robot.running = false;
    respond(INPUT_SENSES);
    check_rest();
    //@ assert stays_stopped: !robot.running;
}

void senses_of_a_frozen_robot(void)
{
    begin();
    robot.brain.frozen = true;
    respond(INPUT_SENSES);
}

/* A profile that begins with learns as it is here. */
static void sense_without_learning(uint8_t profile)
{
    begin();
    robot.brain.profile = profile;
    robot.brain.learns = false;
    respond(INPUT_SENSES);
}

void senses_of_fixed(void)
{
    sense_without_learning(PROFILE_FIXED);
}

/* The listing has one lesson: a trial that helped. */
void senses_of_article_without_a_trial(void)
{
    begin();
    robot.brain.profile = PROFILE_ARTICLE;
    robot.sharing.whole = false;
    if (robot.brain.awaits == AWAITS_VERDICT)
        robot.brain.awaits = AWAITS_LOOK;
    respond(INPUT_SENSES);
}

/* Not so: the canary of the assertions. */
void any_drive_is_at_rest(void)
{
    begin();
    respond(INPUT_SENSES);
    check_rest();
}
