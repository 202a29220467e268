/* tests/unit/test_moments.c -- when it is in a study, and where the sun then stands. Moments in
 * seconds are those of Python's datetime; clock changes those of the IANA data base.
 */
#include "sim/moments.h"

#include "tests/study_text.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static arena memory;
static notices said;
static lux_error err;

static int prepare(void **state)
{
    (void)state;
    said = (notices){ .a = &memory };
    err  = (lux_error){ 0 };
    return 0;
}

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

/* ---- series ---------------------------------------------------------------------------------- */

static const char places[][2][24] = {
    { "Europe/Moscow", "55.7558N 37.6173E" }, { "Europe/Berlin", "52.52N 13.405E" },
    { "America/New_York", "40.71N 74W" },     { "Australia/Lord_Howe", "31.55S 159.08E" },
    { "Asia/Kathmandu", "27.7N 85.32E" },     { "UTC", "51.48N 0E" }
};
typedef enum where { MOSCOW, BERLIN, NEW_YORK, LORD_HOWE, KATHMANDU, GREENWICH } where;

static const moment *series(where at, const char *when, int *count)
{
    char text[400];
    snprintf(text, sizeof text,
             "lux4: 1\nsite: {place: %s, zone: %s}\nsky: {model: clear}\nwhen: {%s}\n",
             places[at][1], places[at][0], when);
    const study *s = study_of_text(&memory, NULL, text);
    return moments_of(&memory, s, &s->when, count, &said, &err);
}

typedef struct clock_case {
    where at;
    const char *when;
    int count;
    double first, apart; /* s */
} clock_case;

/* However clocks jump, what they show from hour to hour is a steady row of moments. */
TEST(a_series_is_steady_through_clock_changes)
{
    static const clock_case cases[] = {
        { BERLIN, "date: 2026-03-29, from: 00:00, to: 04:00", 4, 1774738800, 3600 },
        { BERLIN, "date: 2026-10-25, from: 00:00, to: 04:00", 6, 1792879200, 3600 },
        { BERLIN, "date: 2026-10-25, from: 00:00, to: 04:00, step: 30", 11, 1792879200, 1800 },
        { MOSCOW, "date: 2010-03-28, from: 00:00, to: 04:00", 4, 1269723600, 3600 },
        { MOSCOW, "date: 2010-10-31, from: 00:00, to: 04:00", 6, 1288468800, 3600 },
        { NEW_YORK, "date: 2026-11-01, from: 00:00, to: 03:00", 5, 1793505600, 3600 },
        { LORD_HOWE, "date: 2026-04-05, from: 01:00, to: 03:00, step: 15", 11, 1775311200, 900 },
        { LORD_HOWE, "date: 2026-10-04, from: 01:00, to: 03:00, step: 15", 7, 1791037800, 900 },
        { KATHMANDU, "date: 2026-06-21, from: 12:00, to: 14:00, step: 20", 7, 1782022500, 1200 },
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        int count       = 0;
        const moment *m = series(cases[i].at, cases[i].when, &count);
        assert_non_null(m);
        if (count != cases[i].count)
            fail_msg("%s: %d moments, not %d", cases[i].when, count, cases[i].count);
        for (int k = 0; k < count; k++)
            if (m[k].at != cases[i].first + k * cases[i].apart)
                fail_msg("%s: number %d is %s", cases[i].when, k, m[k].text);
    }
}

TEST(hours_that_clocks_show_twice_are_told_apart_by_their_offset)
{
    int count;
    const moment *m = series(BERLIN, "date: 2026-10-25, from: 02:00, to: 03:00", &count);
    assert_int_equal(count, 3);
    assert_string_equal(m[0].text, "2026-10-25T02:00+02:00");
    assert_string_equal(m[1].text, "2026-10-25T02:00+01:00");
    assert_string_equal(m[2].text, "2026-10-25T03:00+01:00");
    assert_int_equal(m[1].local.hour, 2);
    assert_int_equal(said.count, 0);
}

TEST(hours_that_clocks_skip_are_noticed)
{
    int count;
    assert_non_null(series(BERLIN, "date: 2026-03-29, from: 00:00, to: 04:00", &count));
    assert_int_equal(said.count, 1);
    assert_string_equal(said.first->text,
                        "job/office.yaml:4:7: clocks are put forward: 1 time that they skip is "
                        "left out (2026-03-29T02:00)");
}

TEST(an_hour_that_is_skipped_alone_leaves_no_series)
{
    int count;
    assert_null(series(BERLIN, "date: 2026-03-29, from: 02:30", &count));
    assert_string_equal(err.text, "job/office.yaml:4:7: a series without a single moment");
}

static void assert_day(const moment *m, int year, int month, int day)
{
    if (m->local.year != year || m->local.month != month || m->local.day != day)
        fail_msg("%s, not %d-%d-%d", m->text, year, month, day);
}

TEST(days_weeks_and_months_keep_their_time_of_day)
{
    int count;
    const moment *m = series(GREENWICH, "date: 2028-02-28..2028-03-01, from: 12:00", &count);
    assert_int_equal(count, 3);
    assert_day(&m[1], 2028, 2, 29);

    m = series(BERLIN, "date: 2026-03-01..2026-04-04, from: 09:30, every: week", &count);
    assert_int_equal(count, 5);
    assert_day(&m[4], 2026, 3, 29);
    for (int k = 0; k < count; k++)
        assert_true(m[k].local.hour == 9 && m[k].local.minute == 30);

    m = series(GREENWICH, "date: 2026-11-21..2027-02-20, from: 12:00, every: month", &count);
    assert_int_equal(count, 3); /* the 21st of February is after the last date */
    assert_day(&m[2], 2027, 1, 21);
    assert_int_equal(said.count, 0);
}

TEST(months_without_the_day_are_left_out_and_noticed)
{
    static const int thirty_first[] = { 1, 3, 5, 7, 8, 10, 12 };
    int count;
    const moment *m =
        series(GREENWICH, "date: 2026-01-31..2026-12-31, from: 12:00, every: month", &count);
    assert_int_equal(count, 7);
    for (int k = 0; k < 7; k++)
        assert_day(&m[k], 2026, thirty_first[k], 31);
    assert_int_equal(said.count, 1);
    assert_string_equal(said.first->text,
                        "job/office.yaml:4:7: months without a day 31 are left out: 5");

    /* 49 months, of which the Februaries of 2029, 2030 and 2031 have no 29th */
    m = series(GREENWICH, "date: 2028-02-29..2032-02-29, from: 12:00, every: month", &count);
    assert_int_equal(count, 46);
    assert_day(&m[45], 2032, 2, 29);
}

TEST(steps_that_are_no_doubles_meet_the_last_time)
{
    int count; /* 20 s */
    const moment *m = series(
        GREENWICH, "date: 2026-01-01, from: 12:00, to: 12:10, step: 0.3333333333333333", &count);
    assert_int_equal(count, 31);
    assert_int_equal(m[30].local.minute, 10);
    assert_true(m[1].at - m[0].at == 20.0);
    assert_string_equal(m[1].text, "2026-01-01T12:00:20+00:00");
}

TEST(there_are_ten_thousand_moments_and_no_more)
{
    int count;
    assert_non_null(
        series(GREENWICH, "date: 2026-01-01..2028-09-26, from: 08:00, to: 17:00", &count));
    assert_int_equal(count, MOST_MOMENTS);
    assert_null(series(GREENWICH, "date: 2026-01-01..2028-09-27, from: 08:00, to: 17:00", &count));
    assert_string_equal(err.text, "job/office.yaml:4:7: a series of more than 10000 moments");
}

TEST(a_single_time_is_a_series_of_one)
{
    int count;
    const study *s  = study_of_text(&memory, NULL,
                                    "lux4: 1\nsite: {place: 55.7558N 37.6173E, zone: "
                                     "Europe/Moscow}\nwhen: 2026-06-21T10:00\n");
    const moment *m = moments_of(&memory, s, &s->when, &count, &said, &err);
    assert_int_equal(count, 1);
    assert_true(m->at == 1782025200.0);
    assert_string_equal(m->text, "2026-06-21T10:00+03:00");
}

/* ---- one moment ------------------------------------------------------------------------------ */

static moment moment_in(const char *text)
{
    moment m;
    const study *s = study_of_text(&memory, NULL, text);
    if (!moment_of(s, &m, &err))
        fail_msg("%s", err.text);
    return m;
}

TEST(the_sun_is_where_sun_at_puts_it_by_true_north)
{
    static const struct {
        const char *text;
        double x, y, z;
    } suns[] = {
        { "sky: {model: clear, sun_at: {azimuth: 90, elevation: 30}}\n", 0.75, 0, 0.5 },
        { "site: {place: 0N 0E, north: 90}\n"
          "sky: {model: clear, sun_at: {azimuth: 90, elevation: 30}}\n",
          0, -0.75, 0.5 },
        { "sky: {model: clear, sun_at: {azimuth: 180, elevation: 0}}\n", 0, -1, 0 },
    };
    for (int i = 0; i < 3; i++) {
        char text[300];
        snprintf(text, sizeof text, "lux4: 1\n%s", suns[i].text);
        moment m = moment_in(text);
        assert_true(m.sun_known && isnan(m.at));
        assert_string_equal(m.text, "");
        /* Squares of the level parts; floats */
        assert_near((double)m.to_sun.x * fabs((double)m.to_sun.x), suns[i].x, 1e-6);
        assert_near((double)m.to_sun.y * fabs((double)m.to_sun.y), suns[i].y, 1e-6);
        assert_near(m.to_sun.z, suns[i].z, 1e-6);
    }
}

TEST(air_lifts_a_low_sun)
{
    moment m = moment_in("lux4: 1\nsite: {place: 51.48N 0E, zone: UTC}\nsky: {model: clear}\n"
                         "when: 2026-03-20T06:20\n");
    assert_true(m.sun.apparent_elevation_deg > m.sun.elevation_deg + 0.1);
    assert_near(m.to_sun.z, sin(m.sun.apparent_elevation_deg * M_PI / 180.0), 1e-6);
    assert_true(m.to_sun.x > 0.9f); /* in the east on the day of equinox */
}

TEST(a_sky_that_does_not_look_at_the_sun_needs_no_time)
{
    moment m = moment_in("lux4: 1\nsky: {model: overcast, horizontal: 10000}\n");
    assert_true(isnan(m.at) && !m.sun_known);
    m = moment_in("lux4: 1\nsky: {panorama: {file: a.exr}}\n");
    assert_false(m.sun_known);
    m = moment_in("lux4: 1\nsky: {cie: {type: 3}, horizontal: 1, sun: off}\nwhen: "
                  "2026-06-21T10:00\n"); /* which no zone makes a moment */
    assert_true(isnan(m.at));
}

TEST(what_is_missing_to_find_the_sun_is_named)
{
    static const char *const table[][2] = {
        { "sky: {model: clear}\n",
          "2:6: the sky model `clear` needs to know where the sun stands: `site` with its `place`, "
          "and `when`, or `sun_at` of the sky" },
        { "sky: {model: overcast}\n",
          "2:6: the sky model `overcast` needs to know where the sun stands: `site` with its "
          "`place`, and `when`, or `sun_at` of the sky" },
        { "sky: {cie: {type: 2}, horizontal: 5}\nwhen: 2026-06-21T10:00Z\n",
          "2:6: the sky model `cie` needs to know where the sun stands: `site` with its `place`, "
          "or `sun_at` of the sky" },
        { "sky: {model: clear, sun: off, horizontal: 5}\nsite: {place: 0N 0E}\n",
          "2:6: the sky model `clear` needs to know where the sun stands: `when`, as "
          "2026-06-21T10:00, or `sun_at` of the sky" },
        { "sky: {model: clear}\nsite: {place: 0N 0E}\nwhen: 2026-06-21T10:00\n",
          "4:7: a local time needs the `zone` of `site`, as Europe/Moscow, or its own offset, as "
          "2026-06-21T10:00+03:00" },
        { "sky: {model: clear}\nwhen: {date: 2026-06-21, from: 08:00, to: 18:00}\n",
          "3:7: `when` is a series of times, which `lux4 daylight` runs; here one is needed, as "
          "2026-06-21T08:00" },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        char text[400], wanted[400];
        moment m;
        snprintf(text, sizeof text, "lux4: 1\n%s", table[i][0]);
        snprintf(wanted, sizeof wanted, "job/office.yaml:%s", table[i][1]);
        assert_false(moment_of(study_of_text(&memory, NULL, text), &m, &err));
        assert_string_equal(err.text, wanted);
        assert_int_equal(err.code, ERR_ARGUMENT);
    }
}

TEST(a_series_needs_a_zone_and_a_sun_that_moves)
{
    static const char *const table[][2] = {
        { "when: {date: 2026-06-21, from: 08:00}\n",
          "2:7: a series of times needs `site` with its `zone`, as Europe/Moscow or +03:00" },
        { "when: {date: 2026-06-21, from: 08:00}\nsite: {place: 0N 0E}\n",
          "3:7: a series of times needs `site` with its `zone`, as Europe/Moscow or +03:00" },
        { "site: {place: 0N 0E, zone: UTC}\n",
          " a series of times needs `when`, as {date: 2026-03-21, from: \"08:00\", to: "
          "\"18:00\", step: 60}" },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        char text[400], wanted[400];
        int count;
        snprintf(text, sizeof text, "lux4: 1\n%s", table[i][0]);
        snprintf(wanted, sizeof wanted, "job/office.yaml:%s", table[i][1]);
        const study *s = study_of_text(&memory, NULL, text);
        assert_null(moments_of(&memory, s, &s->when, &count, &said, &err));
        assert_string_equal(err.text, wanted);
    }
}

TEST(times_that_clocks_never_show_or_show_twice_are_refused_with_both_readings)
{
    moment m;
    static const char *const frame =
        "lux4: 1\nsite: {place: 52.52N 13.405E, zone: Europe/Berlin}\nwhen: %s\n";
    char text[200];
    snprintf(text, sizeof text, frame, "2026-10-25T02:30");
    assert_false(moment_of(study_of_text(&memory, NULL, text), &m, &err));
    assert_int_equal(strncmp(err.text, "job/office.yaml:3:7: ", 21), 0);
    assert_non_null(strstr(err.text, "2026-10-25T02:30+02:00"));
    assert_non_null(strstr(err.text, "2026-10-25T02:30+01:00"));
    snprintf(text, sizeof text, frame, "2026-03-29T02:30");
    assert_false(moment_of(study_of_text(&memory, NULL, text), &m, &err));
    assert_int_equal(strncmp(err.text, "job/office.yaml:3:7: ", 21), 0);
    snprintf(text, sizeof text, frame, "2026-10-25T02:30+01:00");
    assert_true(moment_of(study_of_text(&memory, NULL, text), &m, &err));
    assert_true(m.at == 1792891800.0);
}

/* ---- texts of options ------------------------------------------------------------------------ */

TEST(options_are_read_as_when_is)
{
    civil_time first, last;
    int minute;
    assert_true(when_read_dates("2026-03-21..2026-06-21", "--date", &first, &last, &err));
    assert_true(first.month == 3 && last.month == 6 && last.day == 21);
    assert_true(when_read_dates("2026-03-21", "--date", &first, &last, &err));
    assert_true(last.month == 3);
    assert_true(when_read_minute("23:59", "--to", &minute, &err));
    assert_int_equal(minute, 1439);
    assert_false(when_read_minute("8:00", "--from", &minute, &err));
    assert_string_equal(err.text, "--from: expected a time from 00:00 to 23:59, found `8:00`");
    static const char *const dates[] = { "",
                                         "..",
                                         "2026-03-21..",
                                         "2026-03-21...2026-03-22",
                                         "2026-03-21..2026-03-22..2026-03-23",
                                         "2026-03-21 and then a good deal more than a date has" };
    for (int i = 0; i < 6; i++) {
        assert_false(when_read_dates(dates[i], "--date", &first, &last, &err));
        assert_int_equal(strncmp(err.text, "--date: ", 8), 0);
    }
}

#define WHOLE(test) cmocka_unit_test_setup_teardown(test, prepare, forget)

int main(void)
{
    const struct CMUnitTest tests[] = {
        WHOLE(a_series_is_steady_through_clock_changes),
        WHOLE(hours_that_clocks_show_twice_are_told_apart_by_their_offset),
        WHOLE(hours_that_clocks_skip_are_noticed),
        WHOLE(an_hour_that_is_skipped_alone_leaves_no_series),
        WHOLE(days_weeks_and_months_keep_their_time_of_day),
        WHOLE(months_without_the_day_are_left_out_and_noticed),
        WHOLE(steps_that_are_no_doubles_meet_the_last_time),
        WHOLE(there_are_ten_thousand_moments_and_no_more),
        WHOLE(a_single_time_is_a_series_of_one),
        WHOLE(the_sun_is_where_sun_at_puts_it_by_true_north),
        WHOLE(air_lifts_a_low_sun),
        WHOLE(a_sky_that_does_not_look_at_the_sun_needs_no_time),
        WHOLE(what_is_missing_to_find_the_sun_is_named),
        WHOLE(a_series_needs_a_zone_and_a_sun_that_moves),
        WHOLE(times_that_clocks_never_show_or_show_twice_are_refused_with_both_readings),
        WHOLE(options_are_read_as_when_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
