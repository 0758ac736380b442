/* A motor controller of somebody else's. It follows its set point, every 20 ms, and refuses damaged ones: all its
 * tests on a good bus pass. When its set point is lost, it should stop within 100 ms. */
#include <stdint.h>
#include <string.h>

struct frame { uint32_t id; uint8_t len; uint8_t data[8]; };

enum { SETPOINT = 0x100, STATUS = 0x200, STATUS_MS = 10, LOST_MS = 100 };

static int16_t speed, wanted;
static uint8_t counter, refused;
static uint32_t heard_ms, now;

static uint8_t crc8(const struct frame *frame)
{
    uint8_t bytes[9] = {(uint8_t)frame->id, (uint8_t)(frame->id >> 8)}, crc = 0;

    memcpy(&bytes[2], &frame->data[1], 7);
    for (unsigned i = 0; i < sizeof bytes; i++) {
        crc ^= bytes[i];
        for (unsigned bit = 0; bit < 8; bit++)
            crc = (uint8_t)(crc << 1 ^ (crc & 0x80 ? 0x1D : 0));
    }
    return crc;
}

void receive(const struct frame *frame)
{
    if (frame->id != SETPOINT)
        return;
    heard_ms = now;   /* the bug: a set point that is refused below counts as heard */
    if (frame->len != 8 || frame->data[0] != crc8(frame)) {
        refused++;
        return;
    }
    wanted = (int16_t)(frame->data[2] | frame->data[3] << 8);
}

int tick(uint32_t now_ms, struct frame frames[16])
{
    struct frame *frame = &frames[0];

    now = now_ms;
    if (now - heard_ms > LOST_MS)
        wanted = 0;
    speed = (int16_t)(speed + (wanted - speed) / 8);
    if (now % STATUS_MS != 0)
        return 0;
    *frame = (struct frame){.id = STATUS, .len = 8};
    frame->data[1] = counter;
    frame->data[2] = (uint8_t)speed;
    frame->data[3] = (uint8_t)(speed >> 8);
    frame->data[4] = refused;
    frame->data[0] = crc8(frame);
    counter = (uint8_t)((counter + 1) % 15);
    return 1;
}
