/* sky/clock_text.c -- see clock.h: dates and times as ISO 8601 writes them. */
#include "core/text.h"
#include "sky/clock_parts.h"

#include <string.h>

enum { FIRST_YEAR = 1900, LAST_YEAR = 2100 };

/* So many digits, all of them or nothing. */
static bool read_digits(const char **p, int count, int *out)
{
    int n = 0;
    for (int i = 0; i < count; i++) {
        char c = (*p)[i];
        if (c < '0' || c > '9')
            return false;
        n = 10 * n + (c - '0');
    }
    *p += count;
    *out = n;
    return true;
}

static bool read_char(const char **p, const char *any)
{
    bool is = **p && strchr(any, **p);
    *p += is;
    return is;
}

/* YYYY-MM-DD or YYYYMMDD */
static bool read_date(const char **p, civil_time *t)
{
    if (!read_digits(p, 4, &t->year))
        return false;
    bool dashes = read_char(p, "-");
    return read_digits(p, 2, &t->month) && (!dashes || read_char(p, "-")) &&
           read_digits(p, 2, &t->day);
}

/* HH:MM, HHMM, HH:MM:SS, HHMMSS, and of seconds any fraction */
static bool read_time(const char **p, civil_time *t)
{
    int whole = 0;
    if (!read_digits(p, 2, &t->hour))
        return false;
    bool colons = read_char(p, ":");
    if (!read_digits(p, 2, &t->minute))
        return false;
    if (colons ? !read_char(p, ":") : **p < '0' || **p > '9')
        return true;
    if (!read_digits(p, 2, &whole))
        return false;
    t->second = whole;
    if (read_char(p, ".,")) {
        int digit;
        if (**p < '0' || **p > '9')
            return false;
        for (double unit = 0.1; read_digits(p, 1, &digit); unit *= 0.1)
            t->second += unit * digit;
        if (whole < 60 && t->second >= whole + 1.0) /* .999... of more digits than doubles have */
            t->second = whole + 0x1.fffffp-1;
    }
    return true;
}

bool clock_read_offset(const char **p, int *offset)
{
    int hours, minutes = 0, seconds = 0, sign = **p == '-' ? -1 : 1;
    *offset = 0;
    if (read_char(p, "Zz"))
        return true;
    if (!read_char(p, "+-") || !read_digits(p, 2, &hours))
        return false;
    bool colon = read_char(p, ":");
    if ((colon || (**p >= '0' && **p <= '9')) && !read_digits(p, 2, &minutes))
        return false;
    if (colon && read_char(p, ":") && !read_digits(p, 2, &seconds))
        return false;
    *offset = sign * (hours * 3600 + minutes * 60 + seconds);
    return hours < 16 && minutes < 60 && seconds < 60;
}

static bool date_is(const civil_time *t)
{
    if (t->month < 1 || t->month > 12 || t->day < 1)
        return false;
    civil_time day   = { .year = t->year, .month = t->month, .day = t->day };
    civil_time again = clock_local(NULL, clock_from_civil(&day));
    return again.month == t->month && again.day == t->day;
}

/* What is wrong with numbers that stand where they should, or NULL. */
static const char *wrong_with(const civil_time *t)
{
    if (!date_is(t))
        return "no such day in the calendar";
    if (t->year < FIRST_YEAR || t->year > LAST_YEAR)
        return "a year from 1900 to 2100 is expected";
    if (t->hour == 24)
        return "24:00 is 00:00 of the next day: write that";
    if (t->hour > 23 || t->minute > 59)
        return "a time from 00:00 to 23:59 is expected";
    if (t->second >= 60.0 && t->second < 61.0)
        return "leap seconds are not counted (every day has 86,400 s here): 59 or the next minute "
               "is expected";
    if (t->second >= 61.0)
        return "seconds from 0 to 59 are expected";
    return NULL;
}

bool clock_read(clock_text *out, const char *text, lux_error *err)
{
    char quote[TEXT_QUOTE];
    clock_text t  = { 0 };
    const char *p = text;

    bool reads = read_date(&p, &t.time);
    if (reads && *p) {
        t.has_time = read_char(&p, "Tt ") && read_time(&p, &t.time);
        reads      = t.has_time;
        if (reads && *p) {
            t.has_offset = clock_read_offset(&p, &t.offset);
            reads        = t.has_offset && !*p;
        }
    }
    if (!reads)
        return failed(err, ERR_ARGUMENT,
                      "\"%s\" is no date or time of ISO 8601: 2026-06-21, 2026-06-21T10:00 or "
                      "2026-06-21T10:00:30+03:00 is expected",
                      text_quote(quote, text));

    const char *wrong = wrong_with(&t.time);
    if (wrong)
        return failed(err, ERR_ARGUMENT, "\"%s\": %s", text_quote(quote, text), wrong);
    *out = t;
    return true;
}
