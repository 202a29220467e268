/* sky/clock_zone_icu.c -- see clock.h: the zones of the IANA data base, out of ICU.
 *
 * All changes of the offset within the years of clock.h are asked for once and put into a table,
 * so that nothing of ICU outlives this.
 */
#include "core/text.h"
#include "sky/clock_parts.h"

#include <math.h>
#include <string.h>
#include <strings.h>
#include <unicode/ucal.h>
#include <unicode/uenum.h>
#include <unicode/ustring.h>

enum {
    MOST_CHANGES =
        1000, /* daylight saving time in all 201 years has 402, double summer time more */
    MOST_NAME = 63,
};

static const double FIRST_MOMENT = -2209075200.0; /* 1899-12-31 */
static const double LAST_MOMENT  = 4133980800.0;  /* 2101-01-01 */

/* ---- names ---------------------------------------------------------------------------------- */

/* Whether the data base has the name: not ICU's own three letters (its PST is a place, its IST in
 * India), nor its place holder. */
static bool name_of_iana(const char *name)
{
    static const char three[] = "CET EET EST GMT HST MET MST PRC ROC ROK UCT UTC WET";
    return (strlen(name) != 3 || strstr(three, name)) && strcmp(name, "Etc/Unknown") != 0 &&
           strncmp(name, "SystemV/", 8) != 0;
}

/* How far a wrong name is from a right one, or from what stands behind its slash: "Moscow". */
static int name_distance(const char *wrong, const char *right)
{
    const char *slash = strrchr(right, '/');
    int whole         = text_distance(wrong, right);
    int city          = slash ? 1 + text_distance(wrong, slash + 1) : whole;
    if (!strcasecmp(wrong, right))
        whole = 0;
    if (slash && !strcasecmp(wrong, slash + 1))
        city = 1;
    return city < whole ? city : whole;
}

/* Whether `name` is a zone; if not, `nearest` (MOST_NAME + 1 bytes) is the one most like it, or
 * empty where none is half right. */
static bool name_find(const char *name, char *nearest)
{
    UErrorCode status = U_ZERO_ERROR;
    bool found        = false;
    int best          = (int)(strnlen(name, 31) + 1) / 2 + 1;
    UEnumeration *all = ucal_openTimeZoneIDEnumeration(UCAL_ZONE_TYPE_ANY, NULL, NULL, &status);
    nearest[0]        = 0;
    for (const char *n; !found && (n = uenum_next(all, NULL, &status)) && U_SUCCESS(status);) {
        if (!name_of_iana(n) || strlen(n) > MOST_NAME)
            continue;
        found        = !strcmp(n, name);
        int distance = name_distance(name, n);
        if (distance < best) {
            best = distance;
            strcpy(nearest, n);
        }
    }
    uenum_close(all);
    return found;
}

static bool failed_name(const char *text, const char *nearest, lux_error *err)
{
    char quote[TEXT_QUOTE];
    text_quote(quote, text);
    if (nearest[0])
        return failed(err, ERR_ARGUMENT, "unknown time zone \"%s\": did you mean %s?", quote,
                      nearest);
    return failed(err, ERR_ARGUMENT,
                  "unknown time zone \"%s\": a name of the IANA data base, as Europe/Moscow, or an "
                  "offset, as +03:00, is expected",
                  quote);
}

/* ---- changes -------------------------------------------------------------------------------- */

static int offset_of(UCalendar *c, double moment, UErrorCode *status)
{
    ucal_setMillis(c, moment * 1000.0, status);
    int ms = ucal_get(c, UCAL_ZONE_OFFSET, status) + ucal_get(c, UCAL_DST_OFFSET, status);
    return (int)lround(ms / 1000.0);
}

/* All changes; how many, or 0 where ICU fails or there are more. */
static int changes_list(UCalendar *c, clock_change change[MOST_CHANGES])
{
    UErrorCode status = U_ZERO_ERROR;
    UDate next;
    change[0] = (clock_change){ -(double)INFINITY, offset_of(c, FIRST_MOMENT, &status) };
    int count = 1;
    while (ucal_getTimeZoneTransitionDate(c, UCAL_TZ_TRANSITION_NEXT, &next, &status) &&
           U_SUCCESS(status) && next / 1000.0 < LAST_MOMENT) {
        clock_change new = { next / 1000.0, offset_of(c, next / 1000.0, &status) };
        if (new.offset == change[count - 1].offset)
            continue;
        if (count == MOST_CHANGES)
            return 0;
        change[count++] = new;
    }
    return U_SUCCESS(status) ? count : 0;
}

static const clock_zone *zone_new(arena *a, const clock_change *change, int count, lux_error *err)
{
    clock_zone *z      = arena_new(a, clock_zone, err);
    clock_change *kept = arena_array(a, clock_change, (size_t)count, err);
    if (!z || !kept)
        return NULL;
    memcpy(kept, change, (size_t)count * sizeof *kept);
    *z = (clock_zone){ kept, count };
    return z;
}

const clock_zone *clock_zone_new(arena *a, const char *text, lux_error *err)
{
    int offset;
    const char *end = text;
    if (clock_read_offset(&end, &offset) && !*end)
        return zone_new(a, &(clock_change){ -(double)INFINITY, offset }, 1, err);

    char nearest[MOST_NAME + 1];
    if (!name_find(text, nearest))
        return failed_name(text, nearest, err), NULL;

    UChar name[MOST_NAME + 1];
    UErrorCode status = U_ZERO_ERROR;
    clock_change change[MOST_CHANGES];
    u_uastrcpy(name, text);
    UCalendar *c = ucal_open(name, -1, "", UCAL_GREGORIAN, &status);
    int count    = U_SUCCESS(status) ? changes_list(c, change) : 0;
    ucal_close(c);
    if (!count)
        return failed(err, ERR_IO, "time zone %s: ICU cannot give its changes (%s)", text,
                      u_errorName(status));
    return zone_new(a, change, count, err);
}
