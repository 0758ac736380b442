#include "host_sim/web/native/page.h"

#include "octet.h"

/* Space for a block's lines: senses, drive and report of each tick, and all waiting frames once. */
enum { LINES_A_TICK = 3, LOG_LINES = PAGE_ROBOTS_MAX * (LINES_A_TICK * PAGE_TICKS_MAX + PAGE_WAITING_MAX) };

void page_bind(struct loop_robot *robot, struct octet *octet)
{
    static int16_t rows[PAGE_ROBOTS_MAX][PAGE_TICKS_MAX * ROW_COUNT];
    static double poses[PAGE_ROBOTS_MAX][PAGE_TICKS_MAX * LOOP_POSE];
    size_t index = (size_t)(robot - page_state()->robots);

    robot->octet = octet;
    robot->senses_id = wire_id(&octet->wire, OCTET_SENSES_FRAME_ID);
    robot->drive_id = wire_id(&octet->wire, OCTET_DRIVE_FRAME_ID);
    robot->heartbeat_id = wire_id(&octet->wire, OCTET_HEARTBEAT_FRAME_ID);
    robot->health_id = wire_id(&octet->wire, OCTET_HEALTH_FRAME_ID);
    robot->waiting = page_state()->waiting[index];
    robot->rows = rows[index];
    robot->poses = poses[index];
}

/* As in host_sim/client/supervision.py: logs the robot's frames except the drive, then asks for its report. */
static bool ask(struct loop *loop, size_t index)
{
    struct loop_robot *robot = &loop->robots[index];
    const struct frame *answers = octet_answers(robot->octet);

    if (robot->octet->robot.running || robot->octet->robot.denials == 0)
        return false;
    for (size_t i = 0; i < robot->answer_count; i++)
        if (answers[i].id != robot->drive_id)
            log_lines_add(&loop->log, &answers[i]);
    (void)page_command((uint32_t)index, OPCODE_REPORT, 0, 0);
    page_take_reports((uint32_t)index);
    return true;
}

bool page_open(uint32_t robots)
{
    static const uint8_t nothing[CELL_COUNT];
    static char text[LOG_LINES * LOG_LINE_MAX];
    struct loop *loop = &page_state()->loop;

    *loop = (struct loop){.exchange = octet_exchange, .answers = octet_answers, .ask = ask, .robot_count = robots};
    loop->robots = page_state()->robots;
    loop->log.text = text;
    loop->log_size = sizeof text;
    log_lines_stamp(&loop->log, 0);
    for (uint8_t i = 0; i < robots; i++) {
        struct octet *octet = octet_open((uint8_t)(i + 1), nothing);

        if (!octet)
            return false;
        page_bind(&loop->robots[i], octet);
    }
    return true;
}
