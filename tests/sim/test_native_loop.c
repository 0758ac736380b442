/* Whose turn it is, what is logged, and what ends a block of ticks. */
#include "loop_rig.h"

#include <string.h>

TEST(a_block_runs_as_many_ticks_as_asked_for)
{
    loop.tick = 255;
    loop_run(&loop, 3);
    TEST_ASSERT_EQUAL_UINT32(3, loop.ticks);
    TEST_ASSERT_EQUAL_UINT32(258, loop.tick);
    TEST_ASSERT_FALSE(loop.handed_over);
    TEST_ASSERT_EQUAL_DOUBLE(1012.0, world.bodies[0].x_mm);
    TEST_ASSERT_EQUAL_UINT32(3, robots[1].received);
}

TEST(all_robots_hear_their_senses_before_any_answer_is_read)
{
    static const char *const ids[] = {"101", "102", "041", "042"};

    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_INT(4, logged_lines(&loop.log));
    for (unsigned i = 0; i < 4; i++)
        TEST_ASSERT_EQUAL_STRING_LEN(ids[i], text + i * (loop.log.used / 4) + LOG_STAMP, 3);
    TEST_ASSERT_EQUAL_HEX32(SENSES + 1, octets[1].heard.id);
}

TEST(a_memory_is_heard_by_the_others)
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

TEST(without_a_text_nothing_is_logged)
{
    loop.log.text = NULL;
    loop.log_size = 0;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(TICKS, loop.ticks);
    TEST_ASSERT_EQUAL_size_t(0, loop.log.used);
}

TEST(a_meal_ends_a_block)
{
    world.food[0] = (struct food){1110.0, 1000.0, false};
    octets[0].eat = true;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].food_eaten);
    TEST_ASSERT_EQUAL_UINT32(0, robots[1].food_eaten);
}

TEST(news_ends_a_block)
{
    octets[1].faults = 1;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    TEST_ASSERT_TRUE(robots[1].has_news && !robots[0].has_news);
    TEST_ASSERT_EQUAL_size_t(1, robots[1].report_count);
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(TICKS, loop.ticks);
}

TEST(a_silent_robots_tick_does_not_count)
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

TEST(a_robot_that_has_stopped_by_itself_is_asked_and_goes_on_at_rest)
{
    octets[1].reason = REASON_STOP;
    loop.ask = ask;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(TICKS, loop.ticks);
    TEST_ASSERT_TRUE(robots[1].halted);
    TEST_ASSERT_FALSE(robots[0].halted);
}

static bool ask_at_length(struct loop *of, size_t robot)
{
    const struct frame report = {.id = FAULTS, .len = 8};

    for (unsigned i = 0; i < LOOP_ASK_LINES; i++)
        log_lines_add(&of->log, &report);
    return ask(of, robot);
}

TEST(a_log_without_room_for_being_asked_ends_the_block)
{
    octets[1].reason = REASON_STOP;
    loop.ask = ask_at_length;
    loop.log_size = (size_t)ROBOTS * (1 + LOOP_FRAMES_MAX + LOOP_ASK_LINES) * LOG_LINE_MAX;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    loop.log_size--;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT32(0, loop.ticks);
    TEST_ASSERT_FALSE(loop.handed_over);
}

TEST(a_robot_that_rests_for_another_reason_hands_its_tick_over)
{
    octets[1].silent = true;
    loop.ask = ask;
    loop_run(&loop, TICKS);
    TEST_ASSERT_TRUE(loop.handed_over);
    TEST_ASSERT_FALSE(robots[1].halted);
}

TEST(a_drive_for_other_senses_is_refused_and_not_logged)
{
    struct frame old = drive_of(&octets[0], 77);

    robots[0].waiting = &old;
    robots[0].waiting_count = 1;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT32(1, robots[0].refused);
    TEST_ASSERT_EQUAL_INT(4, logged_lines(&loop.log));
}

TEST(what_waited_is_logged_once_after_the_senses)
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

TEST(turns_may_be_taken_in_another_way)
{
    loop.take_turns = turns_in_process;
    loop_run(&loop, 1);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
}

TEST(a_block_ends_before_the_log_overflows)
{
    loop.log_size = (ROBOTS * (1 + LOOP_FRAMES_MAX) + 1) * LOG_LINE_MAX;
    loop_run(&loop, TICKS);
    TEST_ASSERT_EQUAL_UINT32(1, loop.ticks);
    TEST_ASSERT_TRUE(loop.log.used <= loop.log_size);
}

/* What a loop keeps of its ticks: poses, rows and actions. */

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

TEST(a_tick_that_was_done_elsewhere_is_recorded_like_all)
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
