#include <stdio.h>
#include <string.h>

#include "hal/link/link_kind.h"

static const struct link_kind *kind_of(const char *name)
{
    static const struct link_kind *const KINDS[] = {&LINK_KIND_SOCKETCAN, &LINK_KIND_FD, &LINK_KIND_SLCAN};
    for (size_t i = 0; i < sizeof KINDS / sizeof KINDS[0]; i++)
        if (strncmp(name, KINDS[i]->prefix, strlen(KINDS[i]->prefix)) == 0)
            return KINDS[i];
    return NULL;
}

static int open_request(struct link **link, const struct link_kind *kind, struct link_request *request)
{
    if (kind == NULL) {
        request->why = "no such kind of link";
        return LINK_E_NAME;
    }
    request->place += strlen(kind->prefix);
    if (*request->place == '\0') {
        request->why = "nothing after the colon";
        return LINK_E_NAME;
    }
    if (request->id_count > LINK_IDS_MAX) {
        request->why = "too many identifiers to listen for";
        return LINK_E_OPEN;
    }
    return kind->open(link, request);
}

int link_open(struct link **link, const char *name, const uint16_t ids[], size_t id_count)
{
    struct link_request request = {.place = name, .ids = ids, .id_count = id_count};
    int result = open_request(link, kind_of(name), &request);
    if (result == LINK_E_NAME)
        fprintf(stderr, "link %s: %s; the links are socketcan:IFACE, fd:N, slcan:PATH[@BAUD]\n", name, request.why);
    if (result == LINK_E_OPEN)
        fprintf(stderr, "link %s: %s\n", name, request.why);
    return result;
}

int link_receive(struct link *link, struct frame *out, uint32_t wait_ms)
{
    return link->kind->receive(link, out, wait_ms);
}

int link_send(struct link *link, const struct frame *frame)
{
    return link->kind->send(link, frame);
}

/* The kernel or the adapter does not report these values. */
void link_health(const struct link *link, struct link_health *out)
{
    (void)link;
    *out = (struct link_health){.state = BUS_ACTIVE};
}

void link_close(struct link *link)
{
    if (link != NULL)
        link->kind->close(link);
}
