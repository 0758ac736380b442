#include "host_sim/program/native/machine.h"

const struct known_word CODE_FUNCTIONS[] = {
    [DO_RANDOM] = {"random", 1, 1}, [DO_FEEL] = {"rfeel", 0, 0}, [DO_LOOK] = {"rlook", 0, 1},
    [DO_BEACON] = {"rbeacon", 1, 1}, [DO_GPS_X] = {"rgpsx", 0, 0}, [DO_GPS_Y] = {"rgpsy", 0, 0},
    [DO_COMPASS] = {"rcompass", 0, 0}, [DO_BUMPER] = {"rbumper", 0, 0}, [DO_RANGE] = {"rrange", 0, 1},
    [DO_ABS] = {"abs", 1, 1},
    [DO_INT] = {"int", 1, 1},
};
const unsigned CODE_FUNCTION_COUNT = sizeof CODE_FUNCTIONS / sizeof *CODE_FUNCTIONS;

const struct known_word CODE_COMMANDS[] = {
    [DO_FORWARD] = {"rforward", 1, 1}, [DO_TURN] = {"rturn", 1, 1}, [DO_DELAY] = {"delay", 1, 1},
    [DO_LOCATE] = {"rlocate", 2, 3}, [DO_EAT] = {"reat", 0, 0}, [DO_SHOW] = {"xystring", 3, PROGRAM_ARGUMENTS_MAX},
};
const unsigned CODE_COMMAND_COUNT = sizeof CODE_COMMANDS / sizeof *CODE_COMMANDS;

static const struct {
    const char *name;
    double value;
} constants[] = {
    {"black", 0}, {"blue", 1}, {"green", COLOUR_GREEN}, {"red", 4}, {"yellow", 14}, {"white", COLOUR_WHITE},
    {"true", 1}, {"false", 0},
};

const struct foreign_word CODE_FOREIGN[] = {
    {"line", EXPECTED_NO_DRAWING}, {"lineto", EXPECTED_NO_DRAWING}, {"linewidth", EXPECTED_NO_DRAWING},
    {"gotoxy", EXPECTED_NO_DRAWING}, {"rectangle", EXPECTED_NO_DRAWING}, {"rectanglewh", EXPECTED_NO_DRAWING},
    {"circle", EXPECTED_NO_DRAWING}, {"circlewh", EXPECTED_NO_DRAWING}, {"arc", EXPECTED_NO_DRAWING},
    {"setpixel", EXPECTED_NO_DRAWING}, {"setcolor", EXPECTED_NO_DRAWING}, {"floodfill", EXPECTED_NO_DRAWING},
    {"clearscr", EXPECTED_NO_DRAWING}, {"drawshape", EXPECTED_NO_DRAWING}, {"rpen", EXPECTED_NO_DRAWING},
    {"getkey", EXPECTED_NO_KEYS}, {"waitkey", EXPECTED_NO_KEYS}, {"waitnokey", EXPECTED_NO_KEYS},
    {"keydown", EXPECTED_NO_KEYS}, {"inkey", EXPECTED_NO_KEYS}, {"input", EXPECTED_NO_KEYS},
    {"readmouse", EXPECTED_NO_KEYS}, {"rsense", EXPECTED_NO_SENSOR}, {"rground", EXPECTED_NO_SENSOR},
    {"rdfeel", EXPECTED_NO_SENSOR}, {"rchargelevel", EXPECTED_NO_SENSOR}, {"rinvisible", EXPECTED_NO_SETTING},
    {"rspeed", EXPECTED_NO_SETTING}, {"rslip", EXPECTED_NO_SETTING}, {"rcommport", EXPECTED_NO_SETTING},
    {"rcommand", EXPECTED_NO_SETTING},
};
const unsigned CODE_FOREIGN_COUNT = sizeof CODE_FOREIGN / sizeof *CODE_FOREIGN;

static char small(char letter)
{
    return (char)(letter >= 'A' && letter <= 'Z' ? letter - 'A' + 'a' : letter);
}

bool code_same(const char *word, size_t len, const char *name)
{
    size_t i = 0;

    while (i < len && name[i] != '\0' && small(word[i]) == small(name[i]))
        i++;
    return i == len && name[i] == '\0';
}

int code_find(const struct known_word words[], unsigned count, const char *word, size_t len)
{
    for (unsigned i = 0; i < count; i++)
        if (code_same(word, len, words[i].name))
            return (int)i;
    return -1;
}

bool code_constant(const char *word, size_t len, double *value)
{
    for (unsigned i = 0; i < sizeof constants / sizeof *constants; i++)
        if (code_same(word, len, constants[i].name)) {
            *value = constants[i].value;
            return true;
        }
    return false;
}
