#include "hal/boot/server.h"

void server_begin(struct server *server, struct choices *choices, uint8_t node, uint32_t now_ms)
{
    *server = (struct server){
        .isotp = {.id = (uint16_t)(UPDATE_ANSWER_ID + node)},
        .request_id = (uint16_t)(UPDATE_REQUEST_ID + node),
    };
    uds_begin(&server->uds, choices, now_ms);
}

static void serve(struct server *server, const uint8_t request[], uint16_t len)
{
    uint16_t size = uds_serve(&server->uds, request, len, server->isotp.tx);

    if (size > 0)
        isotp_send(&server->isotp, size);
}

void server_programming(struct server *server)
{
    static const uint8_t request[] = {0x10, 2};

    serve(server, request, sizeof request);
}

void server_take(struct server *server, const struct frame *frame, uint32_t now_ms)
{
    uint16_t len = frame->id == server->request_id ? isotp_take(&server->isotp, frame, now_ms) : 0;

    server->hurries = true;
    if (len == 0)
        return;
    uds_pass(&server->uds, now_ms, true);
    serve(server, server->isotp.rx, len);
}

void server_send(struct server *server, struct link *link, uint32_t now_ms)
{
    struct frame frame;

    while (isotp_next(&server->isotp, &frame, now_ms) && link_send(link, &frame) == 0)
        isotp_sent(&server->isotp, now_ms);
}

/* Whether no tester is present, and there is an image to start. */
static bool is_idle(const struct server *server, uint32_t now_ms)
{
    const struct uds *uds = &server->uds;

    return !uds->programming && uds->choices->now.installed != 0 && now_ms - uds->asked_ms >= SERVER_IDLE_MS;
}

static void work(struct server *server)
{
    uint16_t size = uds_do(&server->uds, server->isotp.tx);

    if (size > 0)
        isotp_send(&server->isotp, size);
}

bool server_work(struct server *server, uint32_t now_ms)
{
    bool receives = isotp_receives(&server->isotp, now_ms);

    uds_pass(&server->uds, now_ms, receives);
    if (isotp_busy(&server->isotp))
        return true;
    server->hurries = receives && uds_ahead(&server->uds, server->isotp.rx, server->isotp.rx_at);
    if (server->uds.work != WORK_NONE)
        work(server);
    if (!server->leaving) {
        server->leaving = server->uds.restart || is_idle(server, now_ms);
        server->leaving_ms = now_ms;
    }
    return !server->leaving || now_ms - server->leaving_ms < SERVER_LAST_MS;
}
