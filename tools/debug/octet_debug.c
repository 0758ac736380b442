/* octet_debug FEED TICK: hands the frames in FEED to a robot, for a debugger. tools/octet debug writes FEED.
 *
 * FEED begins with the robot's node and memory, `1 0000000000000000`. Each line after it is a frame that the robot
 * heard: tick, time in ms, identifier, data, and the data of the DRIVE that the log has for it, or `-`:
 * `371 7420 101 0011223344556677 0011223344556677`. A line with identifier 0 is an outage. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "hal/library/exchange.h"
#include "octet.h"

enum { TEXT_MAX = 2 * 8 + 1 };

/* For the debugger: its user, and log.gdb, name them. */
struct robot *robot;
uint32_t tick, time_ms;   /* of the frame that is handed over next, or was the last */
unsigned long compared, differing;

void stop_here(void);

/* The debugger's breakpoint before the tick that was asked for. */
__attribute__((noinline)) void stop_here(void)
{
    __asm__ volatile("");
}

static uint8_t bytes_of(const char *text, uint8_t bytes[8])
{
    unsigned value;
    uint8_t count = 0;

    while (count < 8 && sscanf(&text[2 * count], "%2x", &value) == 1)
        bytes[count++] = (uint8_t)value;
    return count;
}

static void print_data(const char *who, const struct frame *frame)
{
    printf("  %s  ", who);
    for (unsigned i = 0; i < frame->len; i++)
        printf("%02X", frame->data[i]);
    printf("%s\n", frame->len ? "" : "nothing");
}

/* Compares the robot's DRIVE with the log's, and tells of the first difference. */
static void compare(const struct frame *recorded, const struct frame *answers, size_t count)
{
    struct frame drive = {.len = 0};

    for (size_t i = 0; i < count; i++)
        if (answers[i].id == recorded->id)
            drive = answers[i];
    compared++;
    if (drive.len == recorded->len && memcmp(drive.data, recorded->data, recorded->len) == 0)
        return;
    if (differing++ > 0)
        return;
    printf("tick %" PRIu32 ": the first DRIVE that differs from the log's\n", tick);
    print_data("recorded", recorded);
    print_data("this one", &drive);
}

static void hand_over(struct octet *octet, const struct frame *heard, const char *drive)
{
    struct frame recorded = {.id = OCTET_DRIVE_FRAME_ID + octet->wire.node - 1};

    if (heard->id == 0) {
        octet_outage(octet);
        return;
    }
    size_t count = octet_exchange(octet, heard);
    recorded.len = bytes_of(drive, recorded.data);
    if (recorded.len > 0)
        compare(&recorded, octet_answers(octet), count);
}

static void feed(struct octet *octet, FILE *lines, uint32_t stop)
{
    struct frame heard = {.len = 0};
    char data[TEXT_MAX], drive[TEXT_MAX];
    bool stopped = false;

    while (fscanf(lines, "%" SCNu32 "%" SCNu32 "%" SCNx32 "%16s%16s", &tick, &time_ms, &heard.id, data, drive) == 5) {
        heard.len = bytes_of(data, heard.data);
        if (!stopped && tick >= stop && heard.id == OCTET_SENSES_FRAME_ID + octet->wire.node - 1) {
            stopped = true;
            stop_here();
        }
        hand_over(octet, &heard, drive);
    }
    if (!stopped)
        printf("the log has no tick %" PRIu32 "\n", stop);
}

int main(int argc, char *argv[])
{
    FILE *lines = argc == 3 ? fopen(argv[1], "r") : NULL;
    char text[TEXT_MAX];
    uint8_t memory[CELL_COUNT];
    unsigned node;

    if (!lines || fscanf(lines, "%u %16s", &node, text) != 2 || bytes_of(text, memory) != CELL_COUNT) {
        fprintf(stderr, "usage: octet-debug FEED TICK\n");
        return 2;
    }
    setvbuf(stdout, NULL, _IONBF, 0);
    struct octet *octet = octet_open((uint8_t)node, memory);
    if (!octet)
        return 1;
    robot = &octet->robot;
    feed(octet, lines, (uint32_t)strtoul(argv[2], NULL, 10));
    printf("end of the log: %lu drives compared, %lu differ\n", compared, differing);
    octet_close(octet);
    fclose(lines);
    return 0;
}
