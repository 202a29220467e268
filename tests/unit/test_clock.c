/* tests/unit/test_clock.c -- sky/clock.h; offsets are those of the IANA data base. */
#include "sky/clock.h"
#include "tests/moment.h"

#include <string.h>

static arena room;
static lux_error err;

static const clock_zone *zone(const char *name)
{
    const clock_zone *z = clock_zone_new(&room, name, &err);
    if (!z)
        fail_msg("%s: %s", name, err.text);
    return z;
}

static int clear(void **state __attribute__((unused)))
{
    arena_clear(&room);
    return 0;
}

/* ---- texts ---------------------------------------------------------------------------------- */

static void check_text(const char *text, const char *as_utc)
{
    char printed[CLOCK_TEXT];
    clock_print(printed, NULL, moment_of(text));
    assert_string_equal(printed, as_utc);
}

TEST(texts_of_iso_8601_are_read)
{
    check_text("2026-06-21T10:00Z", "2026-06-21T10:00Z");
    check_text("2026-06-21 10:00Z", "2026-06-21T10:00Z");
    check_text("20260621T1000Z", "2026-06-21T10:00Z");
    check_text("2026-06-21T10:00:30.4+03:00", "2026-06-21T07:00:30Z");
    check_text("2026-06-21T10:00:30,6+03:00", "2026-06-21T07:00:31Z");
    check_text("20260621T100030-0330", "2026-06-21T13:30:30Z");
    check_text("2026-06-21T10:00-08", "2026-06-21T18:00Z");
    check_text("2026-01-01T00:00+05:45", "2025-12-31T18:15Z");
    check_text("1900-01-01T00:00+02:30:17", "1899-12-31T21:29:43Z");
    check_text("2026-12-31T23:59:59.99999999999999999999Z", "2027-01-01T00:00Z");

    clock_text t;
    assert_true(clock_read(&t, "2024-02-29", &err));
    assert_true(!t.has_time && !t.has_offset && t.time.month == 2 && t.time.day == 29);
}

TEST(what_is_no_time_is_refused_with_a_reason)
{
    const struct {
        const char *text, *why;
    } bad[] = { { "", "is no date" },
                { "2026", "is no date" },
                { "2026-06-21T", "is no date" },
                { "2026-06-21T10", "is no date" },
                { "2026-06-21T10:0", "is no date" },
                { "2026-06-21T10:00:", "is no date" },
                { "2026-06-21T10:00:30.Z", "is no date" },
                { "2026-06-21T10:00 ", "is no date" },
                { "2026-06-21T10:00+16:00", "is no date" },
                { "2026-06-21T10:00+03:60", "is no date" },
                { "2026-06-21Z", "is no date" },
                { "21.06.2026", "is no date" },
                { "2026-06-2\n", "is no date" },
                { "99999999999999", "is no date" },
                { "2026-02-29", "no such day" },
                { "2100-02-29", "no such day" },
                { "2026-00-10", "no such day" },
                { "2026-13-01", "no such day" },
                { "2026-04-31", "no such day" },
                { "2026-04-00", "no such day" },
                { "1899-12-31", "1900 to 2100" },
                { "2101-01-01", "1900 to 2100" },
                { "2026-06-21T24:00", "next day" },
                { "2026-06-21T25:00", "00:00 to 23:59" },
                { "2026-06-21T10:60", "00:00 to 23:59" },
                { "2016-12-31T23:59:60Z", "leap second" },
                { "2016-12-31T23:59:61Z", "0 to 59" } };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        clock_text t;
        if (clock_read(&t, bad[i].text, &err) || !strstr(err.text, bad[i].why))
            fail_msg("%s: %s", bad[i].text, err.text);
        assert_null(strchr(err.text, '\n'));
    }
}

/* ---- the calendar --------------------------------------------------------------------------- */

TEST(the_calendar_and_its_reverse_agree_on_every_day)
{
    double moment = clock_from_civil(&(civil_time){ 1890, 1, 1, 0, 0, 0.0 });
    assert_true(moment == -29219.0 * 86400.0); /* 80 years of 365 days and 19 leap days */
    civil_time before = clock_local(NULL, moment - 86400.0);
    for (; before.year < 2111; moment += 86400.0) {
        civil_time t = clock_local(NULL, moment);
        assert_true(clock_from_civil(&t) == moment);
        bool next_day = t.day == before.day + 1 && t.month == before.month;
        bool first    = t.day == 1 && before.day >= 28 && t.month == before.month % 12 + 1;
        assert_true(next_day || first);
        before = t;
    }
    assert_true(clock_from_civil(&(civil_time){ 2000, 3, 1, 12, 34, 56.5 }) == 951914096.5);
}

TEST(a_moment_a_hair_before_midnight_is_a_time_of_day)
{
    civil_time t = clock_local(NULL, -1e-13);
    assert_true(t.hour < 24 && t.minute < 60 && t.second < 60.0);
    assert_int_equal(clock_local(NULL, (double)NAN).year, 0);
    assert_int_equal(clock_local(NULL, (double)INFINITY).year, 0);
    char text[CLOCK_TEXT];
    clock_print(text, NULL, (double)NAN);
    assert_string_equal(text, "");
}

/* ---- zones ---------------------------------------------------------------------------------- */

static void check_offset(const char *name, const char *moment, double hours)
{
    int offset = clock_offset(zone(name), moment_of(moment));
    if (offset != (int)lround(hours * 3600.0))
        fail_msg("%s at %s is %d s ahead", name, moment, offset);
}

TEST(zones_have_their_offsets)
{
    check_offset("UTC", "2026-06-21T10:00Z", 0.0);
    check_offset("Europe/Moscow", "2026-06-21T10:00Z", 3.0);
    check_offset("Europe/Moscow", "2012-06-21T10:00Z", 4.0);
    check_offset("Europe/Moscow", "1900-06-21T10:00Z", 2.0 + 30.0 / 60.0 + 17.0 / 3600.0);
    check_offset("Europe/Berlin", "1947-06-01T00:00Z", 3.0); /* double summer time */
    check_offset("Europe/Berlin", "2099-07-01T00:00Z", 2.0);
    check_offset("America/New_York", "2026-01-01T00:00Z", -5.0);
    check_offset("Asia/Kolkata", "2026-01-01T00:00Z", 5.5);
    check_offset("Asia/Kathmandu", "2026-01-01T00:00Z", 5.75);
    check_offset("Australia/Lord_Howe", "2026-01-01T00:00Z", 11.0);
    check_offset("Australia/Lord_Howe", "2026-07-01T00:00Z", 10.5);
    check_offset("Pacific/Chatham", "2026-01-01T00:00Z", 13.75);
    check_offset("Pacific/Kiritimati", "2026-01-01T00:00Z", 14.0);
    check_offset("Pacific/Apia", "2011-12-30T09:59:59Z", -10.0);
    check_offset("Pacific/Apia", "2011-12-30T10:00:00Z", 14.0);
    check_offset("+03:00", "2026-01-01T00:00Z", 3.0);
    check_offset("-0330", "2026-01-01T00:00Z", -3.5);
    check_offset("Z", "2026-01-01T00:00Z", 0.0);
    check_offset("-08", "1900-01-01T00:00Z", -8.0);
}

static void check_refused(const char *name, const char *says)
{
    if (clock_zone_new(&room, name, &err) || !strstr(err.text, says))
        fail_msg("%s: %s", name, err.text);
    assert_null(strchr(err.text, '\n'));
}

TEST(a_misspelt_zone_names_the_nearest)
{
    check_refused("Europe/Mosow", "did you mean Europe/Moscow?");
    check_refused("europe/moscow", "did you mean Europe/Moscow?");
    check_refused("Moscow", "did you mean Europe/Moscow?");
    check_refused("kathmandu", "did you mean Asia/Kathmandu?");
    check_refused("America/NewYork", "did you mean America/New_York?");
}

TEST(what_is_no_zone_is_refused)
{
    check_refused("", "is expected");
    check_refused("zzzzzzzzzzzzzzzzzzzz", "is expected");
    check_refused("+25:00", "unknown time zone");
    check_refused("+3", "unknown time zone");
    check_refused("+03:00x", "unknown time zone");
    check_refused("GMT+3", "unknown time zone");
    check_refused("PST", "unknown time zone");
    check_refused("Etc/Unknown", "unknown time zone");
    check_refused("\xff\x01\n%s%n", "unknown time zone");
    static char text[100001];
    memset(text, 'A', sizeof text - 1);
    check_refused(text, "...");
}

TEST(a_zone_without_memory_is_an_error)
{
    arena empty     = { 0 };
    memory_is_out   = true;
    const void *got = clock_zone_new(&empty, "Europe/Moscow", &err);
    memory_is_out   = false;
    assert_null(got);
    assert_int_equal(err.code, ERR_MEMORY);
}

/* ---- clocks put forward and back ------------------------------------------------------------ */

static int moments(const char *name, const char *text, double moment[2])
{
    clock_text t;
    assert_true(clock_read(&t, text, &err));
    return clock_moments(zone(name), &t.time, moment);
}

TEST(times_are_shown_once_or_twice_or_never)
{
    double m[2];
    assert_int_equal(moments("Europe/Berlin", "2026-06-21T10:00", m), 1);
    assert_true(m[0] == moment_of("2026-06-21T08:00Z"));
    assert_int_equal(moments("Europe/Berlin", "2026-03-29T01:59:59", m), 1);
    assert_int_equal(moments("Europe/Berlin", "2026-03-29T02:00", m), 0);
    assert_int_equal(moments("Europe/Berlin", "2026-03-29T02:59:59", m), 0);
    assert_int_equal(moments("Europe/Berlin", "2026-03-29T03:00", m), 1);
    assert_int_equal(moments("Europe/Berlin", "2026-10-25T01:59:59", m), 1);
    assert_int_equal(moments("Europe/Berlin", "2026-10-25T03:00", m), 1);
    assert_int_equal(moments("Europe/Berlin", "2026-10-25T02:00", m), 2);
    assert_true(m[0] == moment_of("2026-10-25T00:00Z") && m[1] == m[0] + 3600.0);
    assert_int_equal(moments("Australia/Lord_Howe", "2026-04-05T01:45", m), 2);
    assert_true(m[1] == m[0] + 1800.0);
    assert_int_equal(moments("Pacific/Apia", "2011-12-30T12:00", m), 0); /* no such date there */
}

TEST(every_hour_of_a_zone_comes_back_from_what_its_clocks_show)
{
    const char *names[] = { "Europe/Berlin", "America/Sao_Paulo", "Pacific/Apia", "Africa/Monrovia",
                            "Australia/Lord_Howe" };
    for (int i = 0; i < 5; i++) {
        const clock_zone *z = zone(names[i]);
        for (double t = -2208988800.0; t < 4133894400.0; t += 100000.0 + 7.0) {
            double m[2];
            civil_time shown = clock_local(z, t);
            int count        = clock_moments(z, &shown, m);
            assert_true(count >= 1 && (m[0] == t || (count == 2 && m[1] == t)));
            assert_true(count == 1 || m[1] > m[0]);
        }
    }
}

static void check_unclear(const char *name, const char *text, const char *a, const char *b)
{
    clock_text t;
    double m;
    assert_true(clock_read(&t, text, &err));
    if (clock_moment(name ? zone(name) : NULL, &t, &m, &err) || !strstr(err.text, a) ||
        !strstr(err.text, b))
        fail_msg("%s", err.text);
}

TEST(a_time_that_is_shown_twice_or_never_is_refused_with_both_readings)
{
    check_unclear("Europe/Berlin", "2026-10-25T02:30", "2026-10-25T02:30+02:00",
                  "2026-10-25T02:30+01:00");
    check_unclear("Europe/Berlin", "2026-03-29T02:30", "2026-03-29T02:00+01:00",
                  "2026-03-29T03:00+02:00");
    check_unclear("Pacific/Apia", "2011-12-30", "2011-12-30T00:00-10:00", "2011-12-31T00:00+14:00");
    check_unclear(NULL, "2026-10-25T02:30", "2026-10-25T02:30Z", "no zone");
}

TEST(an_offset_of_the_text_rules_over_the_zone)
{
    clock_text t;
    double m;
    assert_true(clock_read(&t, "2026-10-25T02:30+01:00", &err));
    assert_true(clock_moment(zone("Europe/Berlin"), &t, &m, &err));
    assert_true(m == moment_of("2026-10-25T01:30Z"));
    assert_true(clock_moment(NULL, &t, &m, &err));
}

TEST(moments_are_printed_as_clocks_show_them)
{
    char text[CLOCK_TEXT];
    clock_print(text, zone("Asia/Kathmandu"), moment_of("2026-06-21T10:00Z"));
    assert_string_equal(text, "2026-06-21T15:45+05:45");
    clock_print(text, zone("-03:30"), moment_of("2026-06-21T10:00:59.6Z"));
    assert_string_equal(text, "2026-06-21T06:31-03:30");
    clock_print(text, zone("Europe/Moscow"), moment_of("1900-01-01T10:00:01Z"));
    assert_string_equal(text, "1900-01-01T12:30:18+02:30:17");
    clock_print(text, zone("UTC"), moment_of("2026-06-21T10:00:07Z"));
    assert_string_equal(text, "2026-06-21T10:00:07+00:00");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(texts_of_iso_8601_are_read),
        cmocka_unit_test(what_is_no_time_is_refused_with_a_reason),
        cmocka_unit_test(the_calendar_and_its_reverse_agree_on_every_day),
        cmocka_unit_test(a_moment_a_hair_before_midnight_is_a_time_of_day),
        cmocka_unit_test(zones_have_their_offsets),
        cmocka_unit_test(a_misspelt_zone_names_the_nearest),
        cmocka_unit_test(what_is_no_zone_is_refused),
        cmocka_unit_test(a_zone_without_memory_is_an_error),
        cmocka_unit_test(times_are_shown_once_or_twice_or_never),
        cmocka_unit_test(every_hour_of_a_zone_comes_back_from_what_its_clocks_show),
        cmocka_unit_test(a_time_that_is_shown_twice_or_never_is_refused_with_both_readings),
        cmocka_unit_test(an_offset_of_the_text_rules_over_the_zone),
        cmocka_unit_test(moments_are_printed_as_clocks_show_them),
    };
    return cmocka_run_group_tests(tests, NULL, clear);
}
