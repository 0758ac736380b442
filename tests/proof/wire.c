/* The wire, both ways: whatever frames come in whatever order, and whatever the robot answers. */
#include "hal/protocol/wire.h"
#include "tests/proof/any.h"

static void take_any_frame(struct frame *frame)
{
    frame->id = any_u32;
    frame->len = any_between(0, sizeof frame->data);
    for (unsigned i = 0; i < sizeof frame->data; i++)
        frame->data[i] = any_u8;
}

static void answer_anything(struct output *out)
{
    out->has_answer = any_bool();
    out->has_report = any_bool();
    out->has_memory = any_bool();
    out->has_drive = any_bool();
    out->whole_report = any_bool();
    out->silent = any_bool();
    out->contradiction = any_bool();
    out->denied = any_bool();
    out->store = any_bool();
    out->answer = (enum result)any_between(0, 15);
    out->answer_value = any_u32;
    out->report = (struct report){any_bool(), any_bool(), any_between(0, PROFILE_COUNT - 1), any_u16};
    for (unsigned p = 0; p < CELL_COUNT; p++)
        out->memory[p] = any_u8;
    out->drive.tick = any_u8;
    out->drive.left_mm_s = (int16_t)any_u16;
    out->drive.right_mm_s = (int16_t)any_u16;
    out->drive.reason = (enum reason)any_between(0, 15);
    out->drive.repeat_count = any_u8;
    out->drive.action = any_between(0, ACTION_SPAN - 1);
    out->drive.eat = any_bool();
}

int main(void)
{
    struct wire wire;
    struct frame frame;
    struct frame frames[WIRE_FRAMES_MAX] = {{0}};
    struct input in;
    struct output out;

    wire_init(&wire, any_between(1, NODE_MAX));
    wire_boot(&wire, &frame);
    while (any_bool()) {
        take_any_frame(&frame);
        answer_anything(&out);
        if (any_bool())
            (void)wire_read(&wire, &frame, &in);
        else if (any_bool())
            wire_outage(&wire);
        else
            (void)wire_write(&wire, &out, frames);
    }
    return 0;
}
