#include "loop_rig.h"

#include <string.h>

#include "octet.h"
#include "tests/world/native/fake_space.h"

struct octet octets[ROBOTS];
struct loop_robot robots[ROBOTS];
struct world world;
struct loop loop;
int16_t rows[ROBOTS][TICKS * ROW_COUNT];
double poses[ROBOTS][TICKS * LOOP_POSE];
char text[TICKS * ROBOTS * 20 * LOG_LINE_MAX];

struct frame drive_of(const struct octet *octet, uint8_t tick)
{
    struct octet_drive_t message = {.tick = tick, .reason = (uint8_t)octet->reason, .left = 200, .right = 200,
        .eat = octet->eat, .action = octet->action};
    struct frame frame = {.id = DRIVE + (uint32_t)(octet - octets), .len = OCTET_DRIVE_LENGTH};

    (void)octet_drive_pack(frame.data, &message, sizeof frame.data);
    return frame;
}

static size_t exchange(struct octet *octet, const struct frame *in)
{
    struct octet_senses_t senses;
    size_t count = 0;

    if (in->id >= MEMORY && in->id < MEMORY + ROBOTS) {
        octet->memory = *in;
        octet->memories++;
        return 0;
    }
    octet->heard = *in;
    (void)octet_senses_unpack(&senses, in->data, in->len);
    if (octet->faults)
        octet->answers[count++] = (struct frame){.id = FAULTS, .len = 8, .data = {0, 0, octet->faults}};
    if (octet->tells_memory)
        octet->answers[count++] = (struct frame){.id = MEMORY + (uint32_t)(octet - octets), .len = 6};
    if (!octet->silent)
        octet->answers[count++] = drive_of(octet, senses.tick);
    return count;
}

static const struct frame *answers(const struct octet *octet)
{
    return octet->answers;
}

void setUp(void)
{
    fake_open(&world, ROBOTS, 1);
    world.food[0].eaten = true;
    memset(octets, 0, sizeof octets);
    memset(robots, 0, sizeof robots);
    loop = (struct loop){.exchange = exchange, .answers = answers, .world = &world, .robot_count = ROBOTS,
        .robots = robots, .log = {.text = text}, .log_size = sizeof text};
    for (unsigned i = 0; i < ROBOTS; i++) {
        octets[i].reason = REASON_WANDER;
        octets[i].action = 1;
        robots[i].octet = &octets[i];
        robots[i].senses_id = SENSES + i;
        robots[i].drive_id = DRIVE + i;
        robots[i].rows = rows[i];
        robots[i].poses = poses[i];
    }
}

