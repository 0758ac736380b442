#include "hal/port/cortex_m/loader.h"

uint8_t loader_node(uint8_t built)
{
    return built;
}

const char *loader_link(void)
{
    return "";
}

void loader_alive(bool outage)
{
    (void)outage;
}

uint16_t loader_id(void)
{
    return 0;
}

bool loader_frame(const struct frame *frame, bool at_rest, struct frame *answer)
{
    (void)frame;
    (void)at_rest;
    (void)answer;
    return false;
}
