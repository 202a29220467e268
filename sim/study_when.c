/* sim/study_when.c -- when it is: `when` of a study, one moment or a series. */
#include "sim/moments.h"
#include "sim/study_read.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool pass_on(const study_reader *r, const yaml_node_t *value, const lux_error *why)
{
    return study_node_failed(r, value, why->code, "%s", why->text);
}

/* ---- one moment ------------------------------------------------------------------------------ */

static bool read_moment(const study_reader *r, const yaml_node_t *value, study_when *w)
{
    const char *text;
    lux_error why = { 0 };
    if (!study_read_text(r, value, &text))
        return false;
    if (!clock_read(&w->at, text, &why))
        return pass_on(r, value, &why);
    if (w->at.has_time)
        return true;
    return study_node_failed(r, value, ERR_FORMAT,
                             "expected a date with its time, as %sT12:00, found %s (a day's "
                             "series is {date: %s, from: \"08:00\", to: \"18:00\"})",
                             text, study_node_found(value).text, text);
}

/* ---- a series -------------------------------------------------------------------------------- */

static bool read_dates(const study_reader *r, const yaml_node_t *value, void *record)
{
    study_when *w = record;
    const char *text;
    lux_error why = { 0 };
    if (!study_read_text(r, value, &text))
        return false;
    return when_read_dates(text, "date", &w->first, &w->last, &why) || pass_on(r, value, &why);
}

static bool read_minute(const study_reader *r, const yaml_node_t *value, void *field)
{
    const char *text;
    lux_error why = { 0 };
    if (!study_read_text(r, value, &text))
        return false;
    return when_read_minute(text, "time of day", field, &why) || pass_on(r, value, &why);
}

static bool read_step(const study_reader *r, const yaml_node_t *value, void *field)
{
    double minutes;
    if (!study_read_positive(r, value, &minutes))
        return false;
    *(double *)field = minutes;
    return (minutes >= 1.0 / 60.0 && minutes <= 1440.0) ||
           study_unexpected(r, value, "minutes, from 1/60 to 1440");
}

static bool read_every(const study_reader *r, const yaml_node_t *value, void *field)
{
    static const study_word words[] = {
        [EVERY_DAY]   = { "day", STUDY_OPTIONAL },
        [EVERY_WEEK]  = { "week", STUDY_OPTIONAL },
        [EVERY_MONTH] = { "month", STUDY_OPTIONAL },
    };
    int i = study_read_word(r, value, words, sizeof words / sizeof *words, sizeof *words);
    if (i >= 0)
        *(study_every *)field = (study_every)i;
    return i >= 0;
}

static const study_key when_table[] = {
    { "date", STUDY_REQUIRED, read_dates, 0 },
    { "from", STUDY_REQUIRED, read_minute, offsetof(study_when, from_min) },
    { "to", STUDY_OPTIONAL, read_minute, offsetof(study_when, to_min) },
    { "step", STUDY_OPTIONAL, read_step, offsetof(study_when, step_min) },
    { "every", STUDY_OPTIONAL, read_every, offsetof(study_when, every) },
};
static const study_keys when_keys = STUDY_KEYS("a series of times", when_table);

static bool same_date(const civil_time *a, const civil_time *b)
{
    return a->year == b->year && a->month == b->month && a->day == b->day;
}

static bool series_is_whole(const study_reader *r, const yaml_node_t *map, study_when *w)
{
    const yaml_node_t *to = study_map_value(r, map, "to"), *step = study_map_value(r, map, "step"),
                      *every = study_map_value(r, map, "every");
    if (step && !to)
        return study_node_failed(r, step, ERR_FORMAT, "`step` needs `from` and `to`");
    if (!to)
        w->to_min = w->from_min; /* once a day */
    if (w->to_min < w->from_min)
        return study_node_failed(r, to, ERR_FORMAT,
                                 "expected `from` <= `to` on one day, found %02d:%02d and "
                                 "%02d:%02d",
                                 w->from_min / 60, w->from_min % 60, w->to_min / 60,
                                 w->to_min % 60);
    return !every || !same_date(&w->first, &w->last) ||
           study_node_failed(r, every, ERR_FORMAT,
                             "`every` needs two dates, as %04d-01-21..%04d-12-21", w->first.year,
                             w->first.year);
}

bool study_read_when(const study_reader *r, const yaml_node_t *value, void *field)
{
    study_when w = { .where    = study_node_where(value),
                     .given    = true,
                     .series   = value->type == YAML_MAPPING_NODE,
                     .step_min = 60.0 };
    if (w.series ? !study_read_map(r, value, &when_keys, &w) || !series_is_whole(r, value, &w)
                 : !read_moment(r, value, &w))
        return false;
    *(study_when *)field = w;
    return true;
}

/* Where a place has no zone, the time's own offset is the zone. */
bool study_finish_when(study *s, arena *a, lux_error *err)
{
    const study_when *w = &s->when;
    if (w->given && s->sky.sun_at_given)
        return study_failed(s, w->where, err, ERR_FORMAT,
                            "`when` does not go with `sun_at`, which stands in its place%s",
                            s->variant ? " (`when: ~` in the variant takes it out)" : "");
    if (!w->given || w->series || !w->at.has_offset || s->site.zone)
        return true;
    int minutes = abs(w->at.offset) / 60;
    char text[16];
    snprintf(text, sizeof text, "%c%02d:%02d", w->at.offset < 0 ? '-' : '+', minutes / 60 % 100,
             minutes % 60);
    s->site.zone = clock_zone_new(a, text, err);
    return s->site.zone != NULL;
}
