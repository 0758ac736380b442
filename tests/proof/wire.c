/* The wire, both ways: whatever frames come in whatever order, and whatever the robot answers. */
#include "hal/protocol/wire.h"

#include <octet.h>

#include "hal/protocol/e2e.h"
#include "tests/proof/any/any.h"

/* Half of them are as whole as a frame can be, and half of them for this robot. */
static void take_any_frame(const struct wire *wire, struct frame *frame)
{
    static const uint32_t IDS[] = {OCTET_SENSES_FRAME_ID, OCTET_COMMAND_FRAME_ID, OCTET_RANGES_FRAME_ID, OCTET_DRIVE_FRAME_ID};
    bool whole = any_bool();

    frame->id = any_bool() ? wire_id(wire, IDS[any_between(0, 3)]) : any_u32();
    frame->len = whole ? sizeof frame->data : any_between(0, sizeof frame->data);
    for (unsigned i = 0; i < sizeof frame->data; i++)
        frame->data[i] = any_u8();
    if (whole)
        e2e_protect(frame);
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
    out->answer_value = any_u32();
    out->report = (struct report){any_bool(), any_bool(), any_between(0, PROFILE_COUNT - 1), any_u16()};
    for (unsigned p = 0; p < CELL_COUNT; p++)
        out->memory[p] = any_u8();
    out->drive.tick = any_u8();
    out->drive.left_mm_s = (int16_t)any_u16();
    out->drive.right_mm_s = (int16_t)any_u16();
    out->drive.reason = (enum reason)any_between(0, 15);
    out->drive.repeat_count = any_u8();
    out->drive.action = any_between(0, ACTION_SPAN - 1);
    out->drive.eat = any_bool();
}

static void read_any_frame(struct wire *wire)
{
    struct frame frame;
    struct input in;

    take_any_frame(wire, &frame);
    (void)wire_read(wire, &frame, &in);
}

static void write_anything(struct wire *wire)
{
    struct frame frames[WIRE_FRAMES_MAX] = {{0}};
    struct output out;

    answer_anything(&out);
    (void)wire_write(wire, &out, frames);
}

void exercise(void)
{
    struct wire wire;
    struct frame boot;

    wire_init(&wire, any_between(1, NODE_MAX));
    wire_boot(&wire, &boot);
    while (any_more()) {
        if (any_bool())
            read_any_frame(&wire);
        else if (any_bool())
            write_anything(&wire);
        else
            wire_outage(&wire);
    }
}
