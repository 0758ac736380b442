/* Commands, one after another: whatever they ask for, each gets one answer, the parameters keep to their ranges, and no
 * wheel turns. */
#include <octet.h>

#include "hal/library/exchange.h"
#include "tests/proof/any/any.h"
#include "tests/proof/any/command.h"

static void check_parameters(const struct config *config)
{
#define CHECK(parameter, minimum, maximum, initial) \
    must(config->value[parameter] >= minimum && config->value[parameter] <= maximum);
    ROBOT_PARAMETERS(CHECK)
}

static void check_rest(const struct frame *frame)
{
    struct octet_drive_t drive;

    must(octet_drive_unpack(&drive, frame->data, frame->len) == 0);
    must(drive.left == 0 && drive.right == 0);
}

static void give(struct octet *octet, const struct frame *command)
{
    size_t count = octet_exchange(octet, command);
    unsigned answers = 0;

    for (size_t i = 0; i < count; i++) {
        answers += octet->answers[i].id == OCTET_ANSWER_FRAME_ID;
        if (octet->answers[i].id == OCTET_DRIVE_FRAME_ID)
            check_rest(&octet->answers[i]);
    }
    must(answers == 1);
    check_parameters(&octet->robot.config);
}

void exercise(void)
{
    static const uint8_t nothing[CELL_COUNT];
    struct octet *octet = octet_open(1, nothing);

    for (unsigned before = 0; octet && any_more(); before++) {
        struct frame command = any_command(1, before);

        give(octet, &command);
    }
    octet_close(octet);
}
