#include <string.h>

#include "firmware/io.h"
#include "host_sim/world/native/body_faults.h"

enum { NOISE_OF_MAX = 1000000, FULL_PERCENT = 100, COUNTED_MAX_PERCENT = 999, BEACON_MAX_MM = 8191 };
enum { LAG_MAX_MS = 1000, SLACK_MAX_DEG = 20, LATENCY_MAX = 5 };
enum { DIGITS_MAX = 7, VALUES_MAX = 2, BODY_SIDES = 2, ROBOTS_A_SEED = 10000 };

#define SENSORS "with SENSOR one of right, front-right, front, front-left, left"

static const char *const NAMES[] = BODY_FAULT_NAMES;
static const char *const FEELS[] = FEEL_NAMES;
static const char *const SIDE_NAMES[BODY_SIDES] = {"left", "right"};

/* The text after the name of a fault: S is a sensor, D a side, N a number; anything else is literal. */
static const struct form {
    const char *details;
    const char *meant;
    const char *range;   /* what a single number may be, in words */
    int32_t most;        /* and its maximum */
} FORMS[] = {
    [BODY_FAULT_SWAP_MOTORS] = {"", "write swap-motors", NULL, 0},
    [BODY_FAULT_MIRROR] = {"", "write mirror", NULL, 0},
    [BODY_FAULT_STUCK_ON] = {":S", "write stuck-on:SENSOR, " SENSORS, NULL, 0},
    [BODY_FAULT_STUCK_OFF] = {":S", "write stuck-off:SENSOR, " SENSORS, NULL, 0},
    [BODY_FAULT_NOISE] = {":N/N", "write noise:N/TICKS, such as noise:10/1000", NULL, 0},
    [BODY_FAULT_WEAK_MOTOR] = {":D:N%", "write weak-motor:left:60% or weak-motor:right:60%", NULL, 0},
    [BODY_FAULT_SWAP_ODOMETERS] = {"", "write swap-odometers", NULL, 0},
    [BODY_FAULT_ODOMETER] = {":D:N%", "write odometer:left:0% or odometer:right:-100%", NULL, 0},
    [BODY_FAULT_FALSE_BEACON] = {":N", "write false-beacon:MM, such as false-beacon:100", NULL, 0},
    [BODY_FAULT_LAG] = {":Nms", "write lag:60ms", "wheels lag by 0 to 1000 ms", LAG_MAX_MS},
    [BODY_FAULT_SLACK] = {":Ndeg", "write slack:3deg", "gears have a slack of 0 to 20 degrees", SLACK_MAX_DEG},
    [BODY_FAULT_SLIP] = {":N%", "write slip:5%", "wheels slip by 0% to 100%", FULL_PERCENT},
    [BODY_FAULT_LATENCY] = {":N", "write latency:1, in ticks", "senses are 0 to 5 ticks late", LATENCY_MAX},
    [BODY_FAULT_DARK_WALL] = {"", "write dark-wall", NULL, 0},
    [BODY_FAULT_WEAK_BATTERY] = {"", "write weak-battery", NULL, 0},
    [BODY_FAULT_REPAIR] = {"", "write repair", NULL, 0},
};

enum { FAULTS = sizeof FORMS / sizeof *FORMS };

/* Index of a word in a list; -1 if it is not there. */
static int32_t find(const char *word, size_t len, const char *const names[], size_t count)
{
    for (size_t i = 0; i < count; i++)
        if (strlen(names[i]) == len && memcmp(names[i], word, len) == 0)
            return (int32_t)i;
    return -1;
}

static bool read_number(const char *word, size_t len, int32_t *out)
{
    bool negative = len > 0 && *word == '-';
    size_t first = negative ? 1 : 0;

    *out = 0;
    for (size_t i = first; i < len; i++) {
        if (word[i] < '0' || word[i] > '9')
            return false;
        *out = 10 * *out + (word[i] - '0');
        if (i - first == DIGITS_MAX)
            return false;
    }
    if (negative)
        *out = -*out;
    return len > first;
}

static bool read_value(char kind, const char *word, size_t len, int32_t *out)
{
    if (kind == 'N')
        return read_number(word, len, out);
    *out = kind == 'S' ? find(word, len, FEELS, FEEL_COUNT) : find(word, len, SIDE_NAMES, BODY_SIDES);
    return *out >= 0;
}

/* Reads the numbers and names that a form has. */
static bool read_details(const char *at, const char *form, int32_t values[])
{
    for (; *form; form++) {
        size_t len = *form == 'N' ? strspn(at, "-0123456789") : strcspn(at, ":/%");

        if (*form == 'S' || *form == 'D' || *form == 'N') {
            if (!read_value(*form, at, len, values++))
                return false;
            at += len;
        } else if (*at++ != *form) {
            return false;
        }
    }
    return *at == '\0';
}

static const char *weaken(struct body_faults *faults, int32_t side, int32_t percent)
{
    if (percent < 0 || percent > FULL_PERCENT)
        return "a motor has 0% to 100%";
    *(side == 0 ? &faults->left_lost_percent : &faults->right_lost_percent)
        = (uint8_t)(FULL_PERCENT - percent);
    return NULL;
}

static const char *miscount(struct body_faults *faults, int32_t side, int32_t percent)
{
    if (percent < -COUNTED_MAX_PERCENT || percent > COUNTED_MAX_PERCENT)
        return "an odometer counts -999% to 999% of the way";
    *(side == 0 ? &faults->left_miscounted_percent : &faults->right_miscounted_percent)
        = (int16_t)(percent - FULL_PERCENT);
    return NULL;
}

static const char *make_noise(struct body_faults *faults, const int32_t values[], uint64_t key)
{
    if (values[0] < 0 || values[0] > values[1] || values[1] == 0 || values[1] > NOISE_OF_MAX)
        return "noise is in 0 to all of 1 to 1000000 ticks";
    faults->noise = (uint32_t)values[0];
    faults->noise_of = (uint32_t)values[1];
    faults->noise_key = key;
    return NULL;
}

static const char *show_food(struct body_faults *faults, int32_t away_mm)
{
    if (away_mm < 0 || away_mm > BEACON_MAX_MM)
        return "food is seen up to 8191 mm away";
    faults->false_beacon_mm = (uint16_t)away_mm;
    return NULL;
}

/* Sets lag, slack, slip or latency; returns the allowed range if the number is not in it. */
static const char *loosen(struct body_faults *faults, enum body_fault fault, int32_t much)
{
    if (much < 0 || much > FORMS[fault].most)
        return FORMS[fault].range;
    if (fault == BODY_FAULT_LAG)
        faults->lag_ms = (uint16_t)much;
    else
        *(fault == BODY_FAULT_SLACK ? &faults->slack_deg
          : fault == BODY_FAULT_SLIP ? &faults->slip_percent : &faults->latency_ticks) = (uint8_t)much;
    return NULL;
}

static void stick(uint8_t *stuck, uint8_t *other, int32_t sensor)
{
    *stuck = (uint8_t)(*stuck | 1u << sensor);
    *other = (uint8_t)(*other & ~(1u << sensor));
}

static const char *change(struct body_faults *faults, enum body_fault fault, const int32_t values[], uint64_t key)
{
    switch (fault) {
    case BODY_FAULT_NOISE:
        return make_noise(faults, values, key);
    case BODY_FAULT_WEAK_MOTOR:
        return weaken(faults, values[0], values[1]);
    case BODY_FAULT_ODOMETER:
        return miscount(faults, values[0], values[1]);
    case BODY_FAULT_FALSE_BEACON:
        return show_food(faults, values[0]);
    case BODY_FAULT_LAG:
    case BODY_FAULT_SLACK:
    case BODY_FAULT_SLIP:
    case BODY_FAULT_LATENCY:
        return loosen(faults, fault, values[0]);
    case BODY_FAULT_DARK_WALL:
        faults->dark_wall = true;
        return NULL;
    case BODY_FAULT_WEAK_BATTERY:
        faults->weak_battery = true;
        return NULL;
    case BODY_FAULT_SWAP_MOTORS:
        faults->swapped = !faults->swapped;
        return NULL;
    case BODY_FAULT_MIRROR:
        faults->mirrored = !faults->mirrored;
        return NULL;
    case BODY_FAULT_STUCK_ON:
        stick(&faults->stuck_on, &faults->stuck_off, values[0]);
        return NULL;
    case BODY_FAULT_STUCK_OFF:
        stick(&faults->stuck_off, &faults->stuck_on, values[0]);
        return NULL;
    case BODY_FAULT_SWAP_ODOMETERS:
        faults->odometers_swapped = !faults->odometers_swapped;
        return NULL;
    case BODY_FAULT_REPAIR:
    default:
        *faults = (struct body_faults){0};
        return NULL;
    }
}

const char *body_faults_add(struct body_faults *faults, const char *what, uint32_t seed, uint32_t robot)
{
    size_t len = strcspn(what, ":");
    int32_t fault = find(what, len, NAMES, FAULTS), values[VALUES_MAX] = {0};

    if (fault < 0)
        return "there is no such fault";
    if (!read_details(what + len, FORMS[fault].details, values))
        return FORMS[fault].meant;
    return change(faults, (enum body_fault)fault, values, body_faults_mix((uint64_t)seed * ROBOTS_A_SEED + robot));
}
