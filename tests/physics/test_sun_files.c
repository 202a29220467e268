/* tests/physics/test_sun_files.c -- the sun of tables at hand: JPL's Horizons 1900 ... 2100, and
 * sunrises of the US Naval Observatory. */
#include "tests/moment.h"

#include <stdio.h>
#include <string.h>

static FILE *table;

static bool open_table(const char *path)
{
    table = fopen(path, "r");
    return table != NULL;
}

typedef struct deviation {
    double most, sum;
    int count;
} deviation;

static void deviate(deviation *d, double off)
{
    d->most = fmax(d->most, off);
    d->sum += off;
    d->count++;
}

static const char MONTHS[] = "JanFebMarAprMayJunJulAugSepOctNovDec";

/* " 1900-Jan-01 00:00 A   " and six numbers, of which the last are refracted azimuth, elevation */
static bool horizons_line(const char *line, double *moment, double *azimuth, double *elevation)
{
    civil_time t = { 0 };
    char month[4];
    double ra, dec, ra_seen, dec_seen;
    if (strlen(line) < 24 ||
        sscanf(line, " %4d-%3s-%2d %2d:%2d", &t.year, month, &t.day, &t.hour, &t.minute) != 5 ||
        sscanf(line + 22, "%lf %lf %lf %lf %lf %lf", &ra, &dec, &ra_seen, &dec_seen, azimuth,
               elevation) != 6)
        return false;
    const char *found = strstr(MONTHS, month);
    if (!found)
        return false;
    t.month = 1 + (int)(found - MONTHS) / 3;
    *moment = clock_from_civil(&t);
    return true;
}

/* Horizons refracts as our formula does at 1010 hPa and 10 C, and takes UT1 as it was: up to 0.8 s
 * from UTC, which is 0.0033 degrees. Before 1962 its time is UT1, and so is ours: what is left
 * there are delta T and rounding, to 0.0001 degrees. */
TEST(it_is_where_jpl_says_for_two_centuries)
{
    if (!open_table("../shared/data/sun/astronomy__Sun.txt"))
        skip();
    const site s      = { 29.0, -81.0, 10.0 };
    const sun_air air = { 1010.0, 10.0 };
    deviation early = { 0 }, all = { 0 };
    for (char line[256]; fgets(line, sizeof line, table);) {
        double moment, azimuth, elevation;
        sun_place p;
        if (!horizons_line(line, &moment, &azimuth, &elevation) || elevation < 0.0)
            continue;
        assert_true(sun_at(&s, &air, moment, &p, NULL));
        double off = sky_angle_deg(p.azimuth_deg, p.apparent_elevation_deg, azimuth, elevation);
        deviate(moment < -252460800.0 ? &early : &all, off); /* 1962 */
    }
    fclose(table);
    print_message("to 1962: %d, most %.5f, mean %.5f; from then on: %d, most %.5f, mean %.5f\n",
                  early.count, early.most, early.sum / early.count, all.count, all.most,
                  all.sum / all.count);
    assert_true(early.count > 300 && all.count > 800);
    assert_true(early.most < 0.001 && all.most < 0.004);
}

typedef struct event {
    site s;
    double moment;
    bool rises;
} event;

/* "Sun -81 29 2019-01-01T12:19Z r": longitude, latitude; tables begin in 1700, we in 1900 */
static bool event_line(const char *line, event *e)
{
    char time[32], kind;
    *e = (event){ 0 };
    if (sscanf(line, "Sun %lf %lf %31s %c", &e->s.longitude_deg, &e->s.latitude_deg, time, &kind) !=
            4 ||
        strcmp(time, "1900") < 0)
        return false;
    e->moment = moment_of(time);
    e->rises  = kind == 'r';
    return true;
}

/* In the zone of the place's own hour, so that dates have one of each. Rounded to the minute, and
 * with parallax: two seconds at 61 degrees. At 89 and 90, where the sun takes hours to rise, tables
 * give what was rounded there. One of three, for the time it takes. */
TEST(it_rises_and_sets_when_tables_say)
{
    if (!open_table("../shared/data/sun/astronomy__riseset.txt"))
        skip();
    deviation seconds = { 0 };
    int lines         = 0;
    for (char line[256]; fgets(line, sizeof line, table);) {
        event e;
        char zone[16];
        if (!event_line(line, &e) || fabs(e.s.latitude_deg) > 61.0 || lines++ % 3)
            continue;
        int hour = (int)lround(e.s.longitude_deg / 15.0);
        snprintf(zone, sizeof zone, "%+03d:00", hour);
        civil_time t = clock_local(NULL, e.moment + hour * 3600.0);
        sun_day d    = sun_on(&e.s, zone, t.year, t.month, t.day);
        double off   = (e.rises ? d.sunrise : d.sunset) - e.moment;
        if (!(fabs(off) < 35.0))
            fail_msg("%s: off by %g s", line, off);
        deviate(&seconds, fabs(off));
    }
    fclose(table);
    print_message("%d, most %.1f s, mean %.1f s\n", seconds.count, seconds.most,
                  seconds.sum / seconds.count);
    assert_true(seconds.count > 700);
}

/* Latitude, longitude, the eve, and when the sun stood at -18, -12 and -6 degrees, on its way up
 * and down; by the minute, in which it moves by 0.23 degrees: rounded or cut. */
TEST(twilight_is_when_tables_say)
{
    const double want[] = { -18.0, -12.0, -6.0, -6.0, -12.0, -18.0 };
    if (!open_table("../shared/data/sun/astronomy__twilight.txt"))
        skip();
    int lines = 0;
    double latitude, longitude;
    char at[7][32];
    while (fscanf(table, "%lf %lf %31s %31s %31s %31s %31s %31s %31s", &latitude, &longitude, at[0],
                  at[1], at[2], at[3], at[4], at[5], at[6]) == 9) {
        for (int i = 0; i < 6; i++) {
            sun_place p = sun_bare(latitude, longitude, moment_of(at[1 + i]));
            if (!(fabs(p.elevation_deg - want[i]) < 0.23))
                fail_msg("%s: %g, not %g", at[1 + i], p.elevation_deg, want[i]);
        }
        lines++;
    }
    fclose(table);
    assert_int_equal(lines, 6);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(it_is_where_jpl_says_for_two_centuries),
        cmocka_unit_test(it_rises_and_sets_when_tables_say),
        cmocka_unit_test(twilight_is_when_tables_say),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
