/* page.h: a run for a web page. JavaScript calls these functions of page.wasm and reads their results in its memory.
 *
 * The page has an instance of the module for each run, so that a run's state is the whole memory of its instance: a copy
 * of that memory is a snapshot of the run. Robot i has node i + 1. */
#ifndef OCTET_PAGE_H
#define OCTET_PAGE_H

#include "hal/library/exchange.h"
#include "host_sim/sim/native/loop.h"

enum {
    PAGE_ROBOTS_MAX = 4,
    PAGE_TICKS_MAX = 256,   /* of a block */
    PAGE_WAITING_MAX = 64,  /* frames of a robot that nobody has taken yet */
    PAGE_BYTES = 8
};

/* A run. */
struct page {
    struct loop loop;
    struct loop_robot robots[PAGE_ROBOTS_MAX];
    struct frame waiting[PAGE_ROBOTS_MAX][PAGE_WAITING_MAX];
    uint8_t counters[PAGE_ROBOTS_MAX];   /* of the last command */
    uint32_t answer_value;
    uint8_t bytes[PAGE_BYTES];
};

struct page *page_state(void);
        /* The run of this instance. */

bool page_open(uint32_t robots);
        /* Wakes the robots of a run, with empty memories. False if there is no memory for them. robots is
           1..PAGE_ROBOTS_MAX. */

size_t page_exchange(uint32_t robot, uint32_t id, uint32_t len);
        /* Gives a robot the frame with the bytes in page_bytes(). Returns how many frames it answers: page_answers(). */

uint8_t *page_bytes(void);
        /* Where JavaScript puts what it wants to hand over: 8 bytes. */

const struct frame *page_answers(uint32_t robot);
        /* What the robot answered last. */

int32_t page_command(uint32_t robot, uint32_t opcode, uint32_t which, uint32_t value);
        /* Sends a command, with which and value as in struct command, and logs it and what the robot says up to its
           answer. Returns the answer's result, an enum result; -1 if there was none. */

uint32_t page_answer_value(void);
        /* The value of that answer. */

void page_take_reports(uint32_t robot);
        /* Logs all that the robot has said since. */

const uint8_t *page_memory(uint32_t robot);
        /* The robot's eight bytes. */

const uint8_t *page_sides(uint32_t robot);
        /* The turn for each pattern in them, whatever kind of memory they are. */

void page_write_side(uint32_t robot, uint32_t pattern, uint32_t side);
        /* Sets the turn for a pattern in page_bytes(), which hold a memory that this robot's behaviour understands. */

bool page_translate(uint32_t robot);
        /* Makes the memory in page_bytes() one that this robot's behaviour understands. False if they are no memory. */

void page_set_time(double time_us);
        /* The time of the log's lines that follow. */

const char *page_log(void);
        /* The log's lines since the last page_clear_log, */

size_t page_log_used(void);
        /* and their length. */

void page_clear_log(void);

#endif
