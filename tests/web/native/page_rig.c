#include "page_rig.h"

#include <string.h>

void setUp(void)
{
    memset(page_state(), 0, sizeof *page_state());
    TEST_ASSERT_TRUE(page_open(ROBOTS));
}

void tearDown(void)
{
    for (unsigned i = 0; i < ROBOTS; i++)
        octet_close(page_state()->robots[i].octet);
}

void start(uint32_t robot, enum profile profile)
{
    TEST_ASSERT_EQUAL_INT32(RESULT_DONE, page_command(robot, OPCODE_START, profile, SEED));
    page_take_reports(robot);
    page_clear_log();
}

void put_bytes(const uint8_t bytes[PAGE_BYTES])
{
    memcpy(page_bytes(), bytes, PAGE_BYTES);
}

unsigned logged(const char *id)
{
    const char *line = page_log(), *end = line + page_log_used();
    unsigned count = 0;

    while (line < end) {
        count += strncmp(line + LOG_STAMP, id, strlen(id)) == 0 && line[LOG_STAMP + strlen(id)] == '#';
        line = (const char *)memchr(line, '\n', (size_t)(end - line)) + 1;
    }
    return count;
}
