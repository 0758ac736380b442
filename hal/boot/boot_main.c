/* The boot loader: starts an image, or serves updates on the bus. */
#include "hal/boot/handover.h"
#include "hal/boot/server.h"
#include "hal/boot/start.h"
#include "hal/port/cortex_m/leave.h"
#include "hal/port/cortex_m/mcu.h"
#include "hal/port/cortex_m/systick.h"

enum { BLINK_BIT = 6 };   /* bit of the milliseconds: about 8 Hz */

int main(int argc, char *argv[]);
void startup_crashed(const uint32_t *frame);

/* The boot loader keeps no crash record: nothing would read it. */
__attribute__((used)) void startup_crashed(const uint32_t *frame)
{
    (void)frame;
    leave_by_reset();
}

static void serve(struct server *server, struct link *link)
{
    struct frame frame;
    bool stays = true;

    while (stays) {
        int result = link_receive(link, &frame, isotp_busy(&server->isotp) || server->hurries ? 0 : 1);

        mcu_feed();
        mcu_light(machine_ms() >> BLINK_BIT & 1u);
        if (result == 1)
            server_take(server, &frame, machine_ms());
        else
            stays = server_work(server, machine_ms());
        server_send(server, link, machine_ms());
    }
}

/* A return from main resets the chip. */
int main(int argc, char *argv[])
{
    static struct choices choices;
    static struct server server;
    struct link *link;
    bool asked = handover_take();
    uint8_t node;
    int slot;

    (void)argc;
    (void)argv;
    (void)choices_open(&choices, LAYOUT.choice_page);
    slot = asked ? SLOT_NONE : start_pick(&choices);
    if (slot != SLOT_NONE)
        boot_start((unsigned)slot);
    node = choices.now.node != 0 ? choices.now.node : (uint8_t)OCTET_NODE;
    server_begin(&server, &choices, node, machine_ms());
    if (link_open(&link, choice_link(&choices.now), &server.request_id, 1) < 0)
        return 1;
    mcu_be_patient();
    if (asked)
        server_programming(&server);
    serve(&server, link);
    return 0;
}
