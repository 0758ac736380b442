#include "host_sim/sim/native/loop.h"

#include <string.h>
#include <unity.h>

#include "octet.h"
#include "tests/world/fake_munk.h"

enum { ROBOTS = 2, TICKS = 8, SENSES = 0x101, DRIVE = 0x041, FAULTS = 0x781, MEMORY = 0x681 };

/* A robot that answers as the test says. */
struct octet {
    enum reason reason;
    uint8_t action;
    bool eat;
    bool silent;
    uint8_t faults;        /* told each tick; 0: no report */
    bool tells_memory;     /* each tick */
    unsigned memories;     /* of others that were heard, */
    struct frame memory;   /* and the last of them */
    struct frame heard;
    struct frame answers[3];
};

static struct octet octets[ROBOTS];
static struct loop_robot robots[ROBOTS];
static struct world world;
static struct loop loop;
static int16_t rows[ROBOTS][TICKS * LOOP_ROW];
static double poses[ROBOTS][TICKS * LOOP_POSE];
static uint32_t decisions[ROBOTS][TICKS];
static char text[TICKS * ROBOTS * 20 * LOG_LINE_MAX];

static struct frame drive_of(const struct octet *octet, uint8_t tick)
{
    struct octet_drive_t message = {.tick = tick, .reason = (uint8_t)octet->reason, .left = 200, .right = 200,
        .eat = octet->eat, .action = octet->action};
    struct frame frame = {.id = DRIVE + (uint32_t)(octet - octets), .len = OCTET_DRIVE_LENGTH};

    (void)octet_drive_pack(frame.data, &message, sizeof frame.data);
    return frame;
}

static size_t exchange(struct octet *octet, const struct frame *in)
{
    struct octet_senses_t senses;
    size_t count = 0;

    if (in->id >= MEMORY && in->id < MEMORY + ROBOTS) {
        octet->memory = *in;
        octet->memories++;
        return 0;
    }
    octet->heard = *in;
    (void)octet_senses_unpack(&senses, in->data, in->len);
    if (octet->faults)
        octet->answers[count++] = (struct frame){.id = FAULTS, .len = 8, .data = {0, 0, octet->faults}};
    if (octet->tells_memory)
        octet->answers[count++] = (struct frame){.id = MEMORY + (uint32_t)(octet - octets), .len = 6};
    if (!octet->silent)
        octet->answers[count++] = drive_of(octet, senses.tick);
    return count;
}

static const struct frame *answers(const struct octet *octet)
{
    return octet->answers;
}

void setUp(void)
{
    fake_open(&world, ROBOTS, 1);
    world.food[0].eaten = true;
    memset(octets, 0, sizeof octets);
    memset(robots, 0, sizeof robots);
    loop = (struct loop){.exchange = exchange, .answers = answers, .world = &world, .robot_count = ROBOTS,
        .robots = robots, .log = {.text = text}, .log_size = sizeof text};
    for (unsigned i = 0; i < ROBOTS; i++) {
        octets[i].reason = REASON_WANDER;
        octets[i].action = 1;
        robots[i].octet = &octets[i];
        robots[i].senses_id = SENSES + i;
        robots[i].drive_id = DRIVE + i;
        robots[i].rows = rows[i];
        robots[i].poses = poses[i];
        robots[i].decisions = decisions[i];
    }
}

void tearDown(void) {}

static int lines(void)
{
    int count = 0;

    for (size_t i = 0; i < loop.log.used; i++)
        count += text[i] == '\n';
    return count;
}

static void test_a_block_runs_as_many_ticks_as_asked_for(void)
{
    loop.tick = 255;
    loop_run(&loop, 3);
    TEST_ASSERT_EQUAL_UINT32(3, loop.ticks);
    TEST_ASSERT_EQUAL_UINT32(258, loop.tick);
    TEST_ASSERT_FALSE(loop.handed_over);
    TEST_ASSERT_EQUAL_DOUBLE(1012.0, world.bodies[0].x_mm);
    TEST_ASSERT_EQUAL_UINT32(3, robots[1].received);
}

static void test_all_robots_hear_their_senses_before_any_answer_is_read(void)
{
    static const char *const ids[] = {"101", "102", "041", "042"};

    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_INT(4, lines());
    for (unsigned i = 0; i < 4; i++)
        TEST_ASSERT_EQUAL_STRING_LEN(ids[i], text + i * (loop.log.used / 4) + LOG_STAMP, 3);
    TEST_ASSERT_EQUAL_HEX32(SENSES + 1, octets[1].heard.id);
}

static void test_a_memory_is_heard_by_the_others(void)
{
    octets[0].tells_memory = true;
    octets[0].faults = 1;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT(0, octets[0].memories);
    TEST_ASSERT_EQUAL_UINT(1, octets[1].memories);
    TEST_ASSERT_EQUAL_HEX32(MEMORY, octets[1].memory.id);
    loop_run(&loop, 2);
    TEST_ASSERT_EQUAL_UINT(3, octets[1].memories);
}

static void test_without_a_text_nothing_is_logged(void)
{
    loop.log.text = NULL;
    loop.log_size = 0;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(TICKS, loop.ticks);
    TEST_ASSERT_EQUAL_size_t(0, loop.log.used);
}

static void test_ticks_are_recorded(void)
{
    world.bodies[1].feel = FEEL_FRONT;
    world.bodies[1].lifted = true;
    loop_run(&loop, 2);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0, poses[0][0]);
    TEST_ASSERT_EQUAL_DOUBLE(1008.0, poses[0][LOOP_POSE]);
    TEST_ASSERT_EQUAL_INT16(1, rows[1][LOOP_ROW]);       /* tick */
    TEST_ASSERT_EQUAL_INT16(4, rows[1][1]);              /* feel */
    TEST_ASSERT_EQUAL_INT16(200, rows[1][8]);            /* left wheel */
    TEST_ASSERT_EQUAL_INT16(2, rows[1][14]);             /* pattern */
    TEST_ASSERT_EQUAL_INT16(1, rows[1][15]);             /* lifted */
    TEST_ASSERT_EQUAL_INT16(0, rows[0][15]);
}

static void test_actions_are_counted_when_they_begin(void)
{
    loop_run(&loop, 2);
    octets[0].action = 2;
    octets[0].reason = REASON_LOOK_AROUND;
    loop_run(&loop, 2);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_WANDER]);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_LOOK_AROUND]);
    TEST_ASSERT_EQUAL_size_t(0, robots[0].decision_count);
}

static void test_the_pattern_is_that_of_the_tick_in_which_the_action_began(void)
{
    world.bodies[0].feel = FEEL_FRONT_RIGHT;
    loop_run(&loop, 1);
    world.bodies[0].feel = 0;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT8(1, robots[0].pattern);
    octets[0].action = 2;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT8(0, robots[0].pattern);
}

static void begins(enum reason reason)
{
    octets[0].action++;
    octets[0].reason = reason;
    loop_run(&loop, 1);
}

static void test_decisions_to_learn_from_are_noted(void)
{
    begins(REASON_TRIAL);
    TEST_ASSERT_EQUAL_size_t(1, robots[0].decision_count);
    begins(REASON_WANDER);   /* the trial's end */
    TEST_ASSERT_EQUAL_size_t(1, robots[0].decision_count);
    begins(REASON_WANDER);
    TEST_ASSERT_EQUAL_size_t(0, robots[0].decision_count);
    begins(REASON_REMEMBERED);
    TEST_ASSERT_EQUAL_size_t(1, robots[0].decision_count);
    TEST_ASSERT_EQUAL_UINT32(0, decisions[0][0]);
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_size_t(0, robots[0].decision_count);
}

static void test_a_meal_ends_a_block(void)
{
    world.food[0] = (struct food){1110.0, 1000.0, false};
    octets[0].eat = true;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].food_eaten);
    TEST_ASSERT_EQUAL_UINT32(0, robots[1].food_eaten);
}

static void test_news_ends_a_block(void)
{
    octets[1].faults = 1;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    TEST_ASSERT_TRUE(robots[1].has_news && !robots[0].has_news);
    TEST_ASSERT_EQUAL_size_t(1, robots[1].report_count);
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(TICKS, loop.ticks);
}

static void test_a_silent_robots_tick_does_not_count(void)
{
    octets[1].silent = true;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(0, loop.ticks);
    TEST_ASSERT_TRUE(loop.handed_over);
    TEST_ASSERT_EQUAL_size_t(ROBOTS, loop.sent);
    TEST_ASSERT_EQUAL_size_t(1, loop.answered);
    TEST_ASSERT_EQUAL_DOUBLE(1000.0, world.bodies[0].x_mm);
}

static bool ask(struct loop *of, size_t robot)
{
    (void)of;
    return octets[robot].reason == REASON_STOP;
}

static void test_a_robot_that_has_stopped_by_itself_is_asked_and_goes_on_at_rest(void)
{
    octets[1].reason = REASON_STOP;
    loop.ask = ask;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(TICKS, loop.ticks);
    TEST_ASSERT_TRUE(robots[1].halted);
    TEST_ASSERT_FALSE(robots[0].halted);
}

static void test_a_robot_that_rests_for_another_reason_hands_its_tick_over(void)
{
    octets[1].silent = true;
    loop.ask = ask;
    loop_run(&loop, TICKS);
    TEST_ASSERT_TRUE(loop.handed_over);
    TEST_ASSERT_FALSE(robots[1].halted);
}

static void test_a_drive_for_other_senses_is_refused_and_not_logged(void)
{
    struct frame old = drive_of(&octets[0], 77);

    robots[0].waiting = &old;
    robots[0].waiting_count = 1;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].refused);
    TEST_ASSERT_EQUAL_INT(4, lines());
}

static void test_what_waited_is_logged_once_after_the_senses(void)
{
    struct frame report = {.id = FAULTS, .len = 8};

    robots[0].waiting = &report;
    robots[0].waiting_count = 1;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_INT(5, lines());
    TEST_ASSERT_EQUAL_STRING_LEN("781", text + 2 * (loop.log.used / 5) + LOG_STAMP, 3);
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_INT(4, lines());
}

static void test_a_tick_that_was_done_elsewhere_is_recorded_like_all(void)
{
    int16_t *row = rows[0] + 2 * LOOP_ROW;

    loop_run(&loop, 2);
    memcpy(row, rows[0] + LOOP_ROW, 14 * sizeof *row);
    row[1] = FEEL_FRONT;
    row[10] = REASON_TRIAL;
    row[12] = 5;
    world.bodies[0].x_mm = 77.0;
    world.bodies[0].lifted = true;
    loop_record(&loop);
    TEST_ASSERT_EQUAL_UINT32(3, loop.ticks);
    TEST_ASSERT_EQUAL_UINT32(3, loop.tick);
    TEST_ASSERT_EQUAL_DOUBLE(77.0, poses[0][2 * LOOP_POSE]);
    TEST_ASSERT_EQUAL_INT16(2, row[14]);
    TEST_ASSERT_EQUAL_INT16(1, row[15]);
    TEST_ASSERT_EQUAL_UINT8(5, robots[0].action);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_TRIAL]);
    TEST_ASSERT_EQUAL_size_t(1, robots[0].decision_count);
    TEST_ASSERT_EQUAL_UINT32(2, decisions[0][0]);
}

static void test_turns_may_be_taken_in_another_way(void)
{
    loop.take_turns = turns_in_process;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
}

static void test_a_block_ends_before_the_log_overflows(void)
{
    loop.log_size = (ROBOTS * (1 + LOOP_FRAMES_MAX) + 1) * LOG_LINE_MAX;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    TEST_ASSERT_TRUE(loop.log.used <= loop.log_size);
}

int main(void)
{
    UNITY_BEGIN();
    RUN_TEST(test_a_block_runs_as_many_ticks_as_asked_for);
    RUN_TEST(test_all_robots_hear_their_senses_before_any_answer_is_read);
    RUN_TEST(test_a_memory_is_heard_by_the_others);
    RUN_TEST(test_without_a_text_nothing_is_logged);
    RUN_TEST(test_ticks_are_recorded);
    RUN_TEST(test_actions_are_counted_when_they_begin);
    RUN_TEST(test_the_pattern_is_that_of_the_tick_in_which_the_action_began);
    RUN_TEST(test_decisions_to_learn_from_are_noted);
    RUN_TEST(test_a_meal_ends_a_block);
    RUN_TEST(test_news_ends_a_block);
    RUN_TEST(test_a_silent_robots_tick_does_not_count);
    RUN_TEST(test_a_robot_that_has_stopped_by_itself_is_asked_and_goes_on_at_rest);
    RUN_TEST(test_a_robot_that_rests_for_another_reason_hands_its_tick_over);
    RUN_TEST(test_a_drive_for_other_senses_is_refused_and_not_logged);
    RUN_TEST(test_what_waited_is_logged_once_after_the_senses);
    RUN_TEST(test_a_tick_that_was_done_elsewhere_is_recorded_like_all);
    RUN_TEST(test_turns_may_be_taken_in_another_way);
    RUN_TEST(test_a_block_ends_before_the_log_overflows);
    return UNITY_END();
}
