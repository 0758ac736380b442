#include "logged_lines.h"
#include "octet.h"

#include "tests/test.h"
#include "host_sim/sim/native/loop.h"
#include "tests/world/native/fake_space.h"

#include <string.h>

/* The loop over ticks, with fake robots in a fake space: turns, the log, and what ends a block. */

enum { ROBOTS = 2, TICKS = 8, SENSES = 0x101, DRIVE = 0x041, FAULTS = 0x781, MEMORY = 0x681 };

/* A fake robot, whose answers a test sets. */
struct octet {
    enum reason reason;
    uint8_t action;
    bool eat;
    bool silent;
    uint8_t faults;        /* reported each tick; 0: no report */
    bool sends_memory;     /* each tick */
    unsigned memories;     /* received from others, */
    struct frame memory;   /* and the last of them */
    struct frame heard;
    struct frame answers[3];
};

static struct octet octets[ROBOTS];
static struct loop_robot robots[ROBOTS];
static struct world world;
static struct loop loop;
static int16_t rows[ROBOTS][TICKS * ROW_COUNT];
static double poses[ROBOTS][TICKS * LOOP_POSE];
static char text[TICKS * ROBOTS * 20 * LOG_LINE_MAX];   /* the log */

/* The robot's answer to that tick. */
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
    if (octet->sends_memory)
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
    }
}

TEST(block_runs_the_given_number_of_ticks)
{
    loop.tick = 255;
    loop_run(&loop, 3);
    TEST_ASSERT_EQUAL_UINT32(3, loop.ticks);
    TEST_ASSERT_EQUAL_UINT32(258, loop.tick);
    TEST_ASSERT_FALSE(loop.handed_over);
    TEST_ASSERT_EQUAL_DOUBLE(1012.0, world.bodies[0].x_mm);
    TEST_ASSERT_EQUAL_UINT32(3, robots[1].received);
}

TEST(senses_are_sent_to_all_robots_before_answers_are_read)
{
    static const char *const ids[] = {"101", "102", "041", "042"};

    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_INT(4, logged_lines(&loop.log));
    for (unsigned i = 0; i < 4; i++)
        TEST_ASSERT_EQUAL_STRING_LEN(ids[i], text + i * (loop.log.used / 4) + LOG_STAMP, 3);
    TEST_ASSERT_EQUAL_HEX32(SENSES + 1, octets[1].heard.id);
}

TEST(memory_frame_is_delivered_to_the_other_robots)
{
    octets[0].sends_memory = true;
    octets[0].faults = 1;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT(0, octets[0].memories);
    TEST_ASSERT_EQUAL_UINT(1, octets[1].memories);
    TEST_ASSERT_EQUAL_HEX32(MEMORY, octets[1].memory.id);
    loop_run(&loop, 2);
    TEST_ASSERT_EQUAL_UINT(3, octets[1].memories);
}

TEST(loop_without_a_log_buffer_logs_nothing)
{
    loop.log.text = NULL;
    loop.log_size = 0;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(TICKS, loop.ticks);
    TEST_ASSERT_EQUAL_size_t(0, loop.log.used);
}

TEST(block_ends_when_food_is_eaten)
{
    world.food[0] = (struct food){1110.0, 1000.0, false};
    octets[0].eat = true;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].food_eaten);
    TEST_ASSERT_EQUAL_UINT32(0, robots[1].food_eaten);
}

TEST(block_ends_when_a_report_changes)
{
    octets[1].faults = 1;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    TEST_ASSERT_TRUE(robots[1].has_news && !robots[0].has_news);
    TEST_ASSERT_EQUAL_size_t(1, robots[1].report_count);
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(TICKS, loop.ticks);
}

TEST(tick_without_an_answer_is_handed_over)
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

TEST(loop_queries_a_robot_that_stopped_by_itself)
{
    octets[1].reason = REASON_STOP;
    loop.ask = ask;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(TICKS, loop.ticks);
    TEST_ASSERT_TRUE(robots[1].halted);
    TEST_ASSERT_FALSE(robots[0].halted);
}

static bool ask_and_fill_log(struct loop *of, size_t robot)
{
    const struct frame report = {.id = FAULTS, .len = 8};

    for (unsigned i = 0; i < LOOP_ASK_LINES; i++)
        log_lines_add(&of->log, &report);
    return ask(of, robot);
}

TEST(block_ends_before_a_question_overflows_the_log)
{
    octets[1].reason = REASON_STOP;
    loop.ask = ask_and_fill_log;
    loop.log_size = (size_t)ROBOTS * (1 + LOOP_FRAMES_MAX + LOOP_ASK_LINES) * LOG_LINE_MAX;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    loop.log_size--;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT32(0, loop.ticks);
    TEST_ASSERT_FALSE(loop.handed_over);
}

TEST(silent_robot_hands_its_tick_over)
{
    octets[1].silent = true;
    loop.ask = ask;
    loop_run(&loop, TICKS);
    TEST_ASSERT_TRUE(loop.handed_over);
    TEST_ASSERT_FALSE(robots[1].halted);
}

TEST(drive_for_other_senses_is_refused_and_not_logged)
{
    struct frame old = drive_of(&octets[0], 77);

    robots[0].waiting = &old;
    robots[0].waiting_count = 1;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].refused);
    TEST_ASSERT_EQUAL_INT(4, logged_lines(&loop.log));
}

TEST(waiting_frame_is_logged_once_after_the_senses)
{
    struct frame report = {.id = FAULTS, .len = 8};

    robots[0].waiting = &report;
    robots[0].waiting_count = 1;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_INT(5, logged_lines(&loop.log));
    TEST_ASSERT_EQUAL_STRING_LEN("781", text + 2 * (loop.log.used / 5) + LOG_STAMP, 3);
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_INT(4, logged_lines(&loop.log));
}

TEST(loop_calls_the_given_function_for_its_turns)
{
    loop.take_turns = turns_in_process;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
}

TEST(block_ends_before_the_log_overflows)
{
    loop.log_size = (ROBOTS * (1 + LOOP_FRAMES_MAX) + 1) * LOG_LINE_MAX;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    TEST_ASSERT_TRUE(loop.log.used <= loop.log_size);
}

/* Recorded ticks: poses, rows and counts of actions. */

TEST(ticks_are_recorded)
{
    world.bodies[1].feel = FEEL_FRONT;
    world.bodies[1].lifted = true;
    loop_run(&loop, 2);
    TEST_ASSERT_EQUAL_DOUBLE(1004.0, poses[0][0]);
    TEST_ASSERT_EQUAL_DOUBLE(1008.0, poses[0][LOOP_POSE]);
    TEST_ASSERT_EQUAL_INT16(1, rows[1][ROW_COUNT + ROW_TICK]);
    TEST_ASSERT_EQUAL_INT16(4, rows[1][ROW_FEEL]);
    TEST_ASSERT_EQUAL_INT16(200, rows[1][ROW_LEFT_MM_S]);
    TEST_ASSERT_EQUAL_INT16(1, rows[1][ROW_LIFTED]);
    TEST_ASSERT_EQUAL_INT16(0, rows[0][ROW_LIFTED]);
}

TEST(actions_are_counted_when_they_begin)
{
    loop_run(&loop, 2);
    octets[0].action = 2;
    octets[0].reason = REASON_LOOK_AROUND;
    loop_run(&loop, 2);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_WANDER]);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_LOOK_AROUND]);
}

TEST(loop_records_a_tick_that_python_has_run)
{
    int16_t *row = rows[0] + 2 * ROW_COUNT;

    loop_run(&loop, 2);
    memcpy(row, rows[0] + ROW_COUNT, ROW_PATTERN * sizeof *row);
    row[ROW_FEEL] = FEEL_FRONT;
    row[ROW_REASON] = REASON_TRIAL;
    row[ROW_ACTION] = 5;
    world.bodies[0].x_mm = 77.0;
    world.bodies[0].lifted = true;
    loop_record(&loop);
    TEST_ASSERT_EQUAL_UINT32(3, loop.ticks);
    TEST_ASSERT_EQUAL_UINT32(3, loop.tick);
    TEST_ASSERT_EQUAL_DOUBLE(77.0, poses[0][2 * LOOP_POSE]);
    TEST_ASSERT_EQUAL_INT16(1, row[ROW_LIFTED]);
    TEST_ASSERT_EQUAL_UINT8(5, robots[0].action);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].begun[REASON_TRIAL]);
}
