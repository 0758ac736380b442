#include "host_sim/web/native/page.h"

struct page *page_state(void)
{
    static struct page page;

    return &page;
}

uint8_t *page_bytes(void)
{
    return page_state()->bytes;
}

double *page_numbers(void)
{
    return page_state()->numbers;
}

char *page_text(void)
{
    return page_state()->text;
}

bool page_has_halted(uint32_t robot)
{
    return page_state()->robots[robot].halted;
}

void page_set_time(double time_us)
{
    log_lines_stamp(&page_state()->loop.log, (uint64_t)time_us);
}

const char *page_log(void)
{
    return page_state()->loop.log.text;
}

size_t page_log_used(void)
{
    return page_state()->loop.log.used;
}

void page_clear_log(void)
{
    page_state()->loop.log.used = 0;
}
