/* tests/unit/test_study_daylight.c -- `site`, `when` and `sky` of a study: what good ones come to,
 * and what is said of each way to break them.
 */
#include "tests/study_text.h"
#include "tests/test.h"

#include <string.h>

static arena memory;

static const study *good(const char *text) { return study_of_text(&memory, NULL, text); }

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

#define L "lux4: 1\n"

/* ---- site ------------------------------------------------------------------------------------ */

TEST(a_study_without_daylight_says_so)
{
    const study *s = good(L);
    assert_false(s->site.given || s->when.given || s->sky.given);
    s = good(L "sky: {model: none}\n");
    assert_true(s->sky.given && s->sky.model == STUDY_SKY_NONE);
}

TEST(a_site_has_a_place_a_height_a_zone_and_its_north)
{
    const study *s = good(L "site: {altitude: 150, place: \"55.7558N 37.6173E\", north: -30,\n"
                            "       zone: Europe/Moscow}\n");
    assert_true(s->site.given);
    assert_near(s->site.at.latitude_deg, 55.7558, 1e-12); /* decimals to a double */
    assert_near(s->site.at.longitude_deg, 37.6173, 1e-12);
    assert_true(s->site.at.altitude_m == 150.0 && s->site.north_deg == -30.0);
    assert_string_equal(s->site.zone_name, "Europe/Moscow");
    assert_int_equal(clock_offset(s->site.zone, 1.8e9), 3 * 3600);
    assert_int_equal(s->site.where.line, 2);
    assert_int_equal(s->site.where.column, 7);
}

TEST(all_but_the_place_of_a_site_may_be_left_out)
{
    const study *s = good(L "site: {place: 55.7558N 37.6173E}\n");
    assert_true(s->site.at.altitude_m == 0.0 && s->site.north_deg == 0.0);
    assert_null(s->site.zone);
    assert_null(s->site.zone_name);
}

TEST(each_key_of_a_site_is_checked_where_it_stands)
{
    static const broken_study table[] = {
        { "site: Moscow", "2:7: expected a mapping (key: value), found `Moscow`" },
        { "site: {zone: UTC}", "2:7: a site needs the key `place`" },
        { "site: {place: 0N 0E, altitud: 1}",
          "2:22: unknown key `altitud`: did you mean `altitude`?" },
        { "site: {place: 0N 0E, altitude: 9001}",
          "2:32: expected an altitude from -500 to 9000 m, found `9001`" },
        { "site: {place: 0N 0E, altitude: -501}",
          "2:32: expected an altitude from -500 to 9000 m, found `-501`" },
        { "site: {place: 0N 0E, altitude: high}", "2:32: expected a number, found `high`" },
        { "site: {place: 0N 0E, north: 361}",
          "2:29: expected an angle from -360 to 360 degrees, found `361`" },
        { "site: {place: 0N 0E, north: .nan}", "2:29: expected a number, found `.nan`" },
        { "site: {place: [55, 37]}", "2:15: expected a text, found a list of 2" },
        { "site: {place: }", "2:15: expected a text, found nothing" },
        { "site: {place: 0N 0E, zone: []}", "2:28: expected a text, found a list of 0" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

/* What the makers of places and zones say stands behind the line and column. */
static void assert_refused_at(const char *text, const char *at)
{
    lux_error err = { 0 };
    assert_null(study_parse(&memory, "s.yaml", NULL, text, strlen(text), NULL, &err));
    if (strncmp(err.text, at, strlen(at)) != 0 || !err.text[strlen(at)])
        fail_msg("`%s`, not at %s", err.text, at);
    assert_null(strpbrk(err.text, "\n\r"));
}

TEST(places_and_zones_that_are_none_are_named_with_their_line)
{
    assert_refused_at(L "site: {place: nowhere}\n", "s.yaml:2:15: ");
    assert_refused_at(L "site: {place: 91N 0E}\n", "s.yaml:2:15: ");
    assert_refused_at(L "site:\n  place: 1N 2E\n  zone: Europe/Moskow\n", "s.yaml:4:9: ");
    assert_refused_at(L "site: {place: 1N 2E, zone: '+25:00'}\n", "s.yaml:2:28: ");
}

/* ---- when ------------------------------------------------------------------------------------ */

TEST(a_moment_may_have_an_offset_and_may_be_quoted)
{
    static const char *const texts[] = { L "when: 2026-06-21T10:30\n", L "when: 2026-06-21 10:30\n",
                                         L "when: \"2026-06-21T10:30\"\n",
                                         L "when: 2026-06-21T10:30+05:45\n" };
    for (int i = 0; i < 4; i++) {
        const study_when *w = &good(texts[i])->when;
        assert_true(w->given && !w->series && w->at.has_time);
        assert_int_equal(w->at.time.year, 2026);
        assert_int_equal(w->at.time.month, 6);
        assert_int_equal(w->at.time.day, 21);
        assert_int_equal(w->at.time.hour, 10);
        assert_int_equal(w->at.time.minute, 30);
        assert_true(w->at.has_offset == (i == 3));
    }
}

TEST(where_no_zone_is_given_the_offset_of_the_time_is_the_zone)
{
    const study *s = good(L "when: 2026-06-21T10:30+05:45\n");
    assert_int_equal(clock_offset(s->site.zone, 0.0), (5 * 60 + 45) * 60);
    s = good(L "when: 2026-06-21T10:30-03:30\nsite: {place: 0N 0E}\n");
    assert_int_equal(clock_offset(s->site.zone, 0.0), -(3 * 60 + 30) * 60);
    s = good(L "when: 2026-06-21T10:30Z\nsite: {place: 0N 0E, zone: '+02:00'}\n");
    assert_int_equal(clock_offset(s->site.zone, 0.0), 2 * 3600);
}

TEST(a_series_has_dates_and_times_of_day)
{
    const study_when *w =
        &good(L "when: {date: 2026-03-21, from: \"08:00\", to: 18:30, step: 90}\n")->when;
    assert_true(w->given && w->series && w->step_min == 90.0 && w->every == EVERY_DAY);
    assert_int_equal(w->from_min, 480);
    assert_int_equal(w->to_min, 18 * 60 + 30);
    assert_int_equal(w->first.month, 3);
    assert_int_equal(w->last.day, 21);

    w = &good(L "when: {date: 2026-01-31..2027-02-28, from: 12:00, every: month}\n")->when;
    assert_true(w->every == EVERY_MONTH && w->step_min == 60.0);
    assert_int_equal(w->to_min, 720); /* once a day */
    assert_int_equal(w->last.year, 2027);
}

TEST(each_key_of_a_time_is_checked_where_it_stands)
{
    static const broken_study table[] = {
        { "when: 2026-06-21",
          "2:7: expected a date with its time, as 2026-06-21T12:00, found `2026-06-21` (a day's "
          "series is {date: 2026-06-21, from: \"08:00\", to: \"18:00\"})" },
        { "when: []", "2:7: expected a text, found a list of 0" },
        { "when: {}", "2:7: a series of times needs the key `date`" },
        { "when: {date: 2026-06-21}", "2:7: a series of times needs the key `from`" },
        { "when: {date: 2026-06-21, from: 8}",
          "2:32: time of day: expected a time from 00:00 to 23:59, found `8`" },
        { "when: {date: 2026-06-21, from: \"24:00\"}",
          "2:32: time of day: expected a time from 00:00 to 23:59, found `24:00`" },
        { "when: {date: 2026-06-21, from: \"08:60\"}",
          "2:32: time of day: expected a time from 00:00 to 23:59, found `08:60`" },
        { "when: {date: 2026-06-21, from: 18:00, to: 08:00}",
          "2:43: expected `from` <= `to` on one day, found 18:00 and 08:00" },
        { "when: {date: 2026-06-21, from: 08:00, to: 18:00, step: 0}",
          "2:56: expected a number > 0, found `0`" },
        { "when: {date: 2026-06-21, from: 08:00, to: 18:00, step: 1441}",
          "2:56: expected minutes, from 1/60 to 1440, found `1441`" },
        { "when: {date: 2026-06-21, from: 08:00, to: 18:00, step: 0.01}",
          "2:56: expected minutes, from 1/60 to 1440, found `0.01`" },
        { "when: {date: 2026-06-21, from: 08:00, step: 60}", "2:45: `step` needs `from` and `to`" },
        { "when: {date: 2026-06-21, from: 08:00, every: week}",
          "2:46: `every` needs two dates, as 2026-01-21..2026-12-21" },
        { "when: {date: 2026-06-21..2026-07-21, from: 08:00, every: year}",
          "2:58: expected day or week or month, found `year`" },
        { "when: {date: 2026-06-21..2026-06-20, from: 08:00}",
          "2:14: date: expected the earlier date first, found `2026-06-21..2026-06-20`" },
        { "when: {date: 2026-06-21T10:00, from: 08:00}",
          "2:14: date: expected a date without a time, found `2026-06-21T10:00`" },
        { "when: {date: 2026-06-21, form: 08:00}",
          "2:26: unknown key `form`: did you mean `from`?" },
        { "when: 2026-06-21T10:00\nsky: {model: clear, sun_at: {azimuth: 0, elevation: 9}}",
          "2:7: `when` does not go with `sun_at`, which stands in its place" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
    assert_refused_at(L "when: 2026-02-29T10:00\n", "s.yaml:2:7: ");
    assert_refused_at(L "when: 2026-06-21T24:00\n", "s.yaml:2:7: ");
    assert_refused_at(L "when: 2026-06-30T23:59:60Z\n", "s.yaml:2:7: ");
    assert_refused_at(L "when: {date: 1899-12-30..1900-01-02, from: 12:00}\n",
                      "s.yaml:2:14: date: ");
    assert_refused_at(L "when: noon\n", "s.yaml:2:7: ");
    assert_refused_at(L "when: {date: 2026-02-29, from: 08:00}\n", "s.yaml:2:14: date: ");
    assert_refused_at(L "when: {date: 2026-02-01.., from: 08:00}\n", "s.yaml:2:14: date: ");
}

/* ---- sky ------------------------------------------------------------------------------------- */

TEST(models_of_the_cie_are_types)
{
    static const struct {
        const char *text, *name;
        int type;
    } skies[] = {
        { L "sky: {model: uniform}\n", "uniform", 0 },
        { L "sky: {model: overcast}\n", "overcast", 16 },
        { L "sky: {model: intermediate}\n", "intermediate", 7 },
        { L "sky: {model: clear}\n", "clear", 12 },
        { L "sky: {model: cie, type: 5}\n", "cie", 5 },
        { L "sky: {model: cie, cie: {type: 15}}\n", "cie", 15 },
        { L "sky: {cie: {type: 1}}\n", "cie", 1 },
    };
    for (size_t i = 0; i < sizeof skies / sizeof *skies; i++) {
        const study_sky *k = &good(skies[i].text)->sky;
        assert_true(k->given && k->model == STUDY_SKY_CIE);
        assert_int_equal(k->type, skies[i].type);
        assert_string_equal(k->name, skies[i].name);
    }
}

TEST(what_a_sky_is_not_given_has_its_default)
{
    const study_sky *k = &good(L "sky: {model: clear}\n")->sky;
    assert_true(k->sun == STUDY_SUN_MODEL && k->turbidity == 3.0 && !k->sun_at_given);
    assert_true(isnan(k->horizontal) && isnan(k->sun_illuminance) && isnan(k->dew_point_c));
    assert_true(k->ground.x == 0.2f && k->ground.y == 0.2f && k->ground.z == 0.2f);
    assert_true(isnan(k->scale) && k->rotate_deg == 0.0 && !k->file);
}

TEST(a_sky_is_read_field_by_field)
{
    const study_sky *k =
        &good(L "sky: {model: clear, sun: point, turbidity: 4.5, horizontal: 9000,\n"
                "      sun_illuminance: 70000, ground: [0.1, 0.2, 0.3],\n"
                "      sun_at: {azimuth: 200, elevation: 41}}\n")
             ->sky;
    assert_true(k->sun == STUDY_SUN_POINT && k->turbidity == 4.5 && k->horizontal == 9000.0);
    assert_true(k->sun_illuminance == 70000.0 && k->ground.z == 0.3f && k->sun_at_given);
    assert_true(k->sun_azimuth_deg == 200.0 && k->sun_elevation_deg == 41.0);
    static const struct {
        const char *text;
        study_sun sun;
    } suns[] = { { L "sky: {model: clear, sun: off}\n", STUDY_SUN_OFF },
                 { L "sky: {model: uniform, sun: on, turbidity: 2}\n", STUDY_SUN_ON },
                 { L "sky: {model: clear, sun: disk}\n", STUDY_SUN_DISK } };
    for (int i = 0; i < 3; i++)
        assert_int_equal(good(suns[i].text)->sky.sun, suns[i].sun);
}

TEST(perez_and_panorama_have_keys_of_their_own_flat_or_nested)
{
    static const char *const perez[] = {
        L "sky: {model: perez, direct_normal: 0, diffuse_horizontal: 90, dew_point: -3}\n",
        L "sky: {perez: {direct_normal: 0, diffuse_horizontal: 90, dew_point: -3}}\n",
        L "sky: {model: perez, direct_normal: 0, perez: {diffuse_horizontal: 90, dew_point: -3}}\n"
    };
    for (int i = 0; i < 3; i++) {
        const study_sky *k = &good(perez[i])->sky;
        assert_true(k->model == STUDY_SKY_PEREZ && k->direct_normal == 0.0);
        assert_true(k->diffuse_horizontal == 90.0 && k->dew_point_c == -3.0);
    }
    static const char *const maps[] = { L "sky: {model: panorama, file: a.exr, rotate: 90}\n",
                                        L "sky: {panorama: {file: a.exr, rotate: 90}}\n" };
    for (int i = 0; i < 2; i++) {
        const study_sky *k = &good(maps[i])->sky;
        assert_true(k->model == STUDY_SKY_PANORAMA && k->rotate_deg == 90.0);
        assert_string_equal(k->file, "job/a.exr");
        assert_true(isnan(k->scale) && isnan(k->horizontal));
    }
    assert_true(good(L "sky: {panorama: {file: /a, horizontal: 8e3}}\n")->sky.horizontal == 8e3);
    assert_true(good(L "sky: {panorama: {file: /a}, scale: 2}\n")->sky.scale == 2.0);
}

TEST(keys_of_a_sky_are_checked_where_they_stand)
{
    static const broken_study table[] = {
        { "sky: none", "2:6: expected a mapping (key: value), found `none`" },
        { "sky: {}", "2:6: a sky needs the key `model`" },
        { "sky: {sun: on}", "2:6: a sky needs the key `model`" },
        { "sky: {model: cloudy}",
          "2:14: expected none or uniform or overcast or intermediate or clear or cie or perez or "
          "panorama, found `cloudy`" },
        { "sky: {model: cie}", "2:6: this sky needs the key `type`" },
        { "sky: {model: cie, type: 0}",
          "2:25: expected a type of ISO 15469, a whole number from 1 to 15, found `0`" },
        { "sky: {model: cie, type: 16}",
          "2:25: expected a type of ISO 15469, a whole number from 1 to 15, found `16`" },
        { "sky: {cie: {type: 1.5}}",
          "2:19: expected a type of ISO 15469, a whole number from 1 to 15, found `1.5`" },
        { "sky: {cie: 5}", "2:12: expected a mapping (key: value), found `5`" },
        { "sky: {model: clear, sun: bright}",
          "2:26: expected off or on or disk or point, found `bright`" },
        { "sky: {model: clear, turbidity: 0.9}",
          "2:32: expected a turbidity (Linke's) from 1 to 20, found `0.9`" },
        { "sky: {model: clear, turbidity: 21}",
          "2:32: expected a turbidity (Linke's) from 1 to 20, found `21`" },
        { "sky: {model: clear, horizontal: -1}",
          "2:33: expected lux, a number from 0 to 1e6, found `-1`" },
        { "sky: {model: clear, sun_illuminance: 1e7}",
          "2:38: expected lux, a number from 0 to 1e6, found `1e7`" },
        { "sky: {model: clear, ground: 1.1}", "2:29: expected a number from 0 to 1, found `1.1`" },
        { "sky: {model: clear, sun_at: 5}", "2:29: expected a mapping (key: value), found `5`" },
        { "sky: {model: clear, sun_at: {azimuth: 5}}", "2:29: `sun_at` needs the key `elevation`" },
        { "sky: {model: clear, sun_at: {azimuth: 5, elevation: 91}}",
          "2:53: expected an angle from -90 to 90 degrees, found `91`" },
        { "sky: {model: clear, sun_at: {azimuth: 500, elevation: 9}}",
          "2:39: expected an angle from -360 to 360 degrees, found `500`" },
        { "sky: {model: perez, direct_normal: 5}",
          "2:6: this sky needs the key `diffuse_horizontal`" },
        { "sky: {perez: {diffuse_horizontal: 5}}", "2:6: this sky needs the key `direct_normal`" },
        { "sky: {perez: {diffuse_horizontal: 0}}", "2:35: expected a number > 0, found `0`" },
        { "sky: {perez: {direct_normal: 2001}}",
          "2:30: expected W/m^2, a number from 0 to 2000, found `2001`" },
        { "sky: {perez: {dew_point: 60}}",
          "2:26: expected a temperature from -100 to 50 C, found `60`" },
        { "sky: {model: panorama}", "2:6: this sky needs the key `file`" },
        { "sky: {panorama: {file: a, scale: 0}}", "2:34: expected a number > 0, found `0`" },
        { "sky: {panorama: {file: a, horizontal: 0}}", "2:39: expected a number > 0, found `0`" },
        { "sky: {model: panorama, file: a, horizontal: 0}",
          "2:45: expected lux, a number > 0, found `0`" },
        { "sky: {panorama: {file: a, rotate: x}}", "2:35: expected a number, found `x`" },
        { "sky: {model: clear, tubidity: 2}",
          "2:21: unknown key `tubidity`: did you mean `turbidity`?" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

TEST(keys_that_contradict_or_mean_nothing_are_refused)
{
    static const broken_study table[] = {
        { "sky: {model: cie, type: 5,\n      cie: {type: 6}}",
          "3:19: `type` stands in line 2 already" },
        { "sky: {model: clear, cie: {type: 5}}",
          "2:33: `type` means nothing to the sky model `clear`" },
        { "sky: {model: clear, cie: {}}", "2:26: `cie` means nothing to the sky model `clear`" },
        { "sky: {cie: {type: 5}, perez: {}}",
          "2:30: `perez` means nothing to the sky model `cie`" },
        { "sky: {model: overcast, type: 5}",
          "2:30: `type` means nothing to the sky model `overcast`" },
        { "sky: {model: uniform, turbidity: 2}",
          "2:34: `turbidity` means nothing to the sky model `uniform` without a sun" },
        { "sky: {model: cie, type: 12, sun: on, file: a}",
          "2:44: `file` means nothing to the sky model `cie`" },
        { "sky: {model: clear, sun: off, sun_illuminance: 5}",
          "2:48: `sun_illuminance` means nothing where the sun is off" },
        { "sky: {perez: {direct_normal: 1, diffuse_horizontal: 1}, horizontal: 5}",
          "2:69: `horizontal` means nothing to the sky model `perez`" },
        { "sky: {perez: {direct_normal: 1, diffuse_horizontal: 1}, turbidity: 5}",
          "2:68: `turbidity` means nothing to the sky model `perez`" },
        { "sky: {panorama: {file: a}, ground: 0.2}",
          "2:36: `ground` means nothing to the sky model `panorama`" },
        { "sky: {panorama: {file: a}, sun_at: {azimuth: 1, elevation: 1}}",
          "2:36: `sun_at` means nothing to the sky model `panorama`" },
        { "sky: {panorama: {file: a, scale: 1}, horizontal: 5}",
          "2:50: a panorama takes `scale` or `horizontal`, not both" },
    };
    ALL_REFUSED(table, ERR_FORMAT);
}

/* ---- variants -------------------------------------------------------------------------------- */

#define CLEAR L "sky: {model: clear, turbidity: 4}\nwhen: 2026-06-21T10:00\nvariants:\n"

TEST(a_variant_puts_the_sky_out_whatever_keys_it_has)
{
    const study *s = study_of_text(&memory, "evening", CLEAR "  evening: {sky: {model: none}}\n");
    assert_int_equal(s->sky.model, STUDY_SKY_NONE);
}

TEST(a_variant_changes_time_and_sky)
{
    const study *s =
        study_of_text(&memory, "v", CLEAR "  v: {when: 2026-12-21T12:00, sky: {turbidity: 6}}\n");
    assert_int_equal(s->when.at.time.month, 12);
    assert_true(s->sky.turbidity == 6.0 && s->sky.type == 12);
    s = study_of_text(&memory, "v",
                      CLEAR "  v: {when: ~, sky: {sun_at: {azimuth: 0, elevation: 9}}}\n");
    assert_true(s->sky.sun_at_given && !s->when.given);
}

TEST(a_variant_is_told_how_to_take_a_key_out)
{
    assert_study_refused(NULL, CLEAR "  v: {sky: {model: overcast}}\n", ERR_FORMAT,
                         "2:32: with the variant `v`: `turbidity` means nothing to the sky model "
                         "`overcast` without a sun (`turbidity: ~` in the variant takes it out)");
    assert_study_refused(NULL, CLEAR "  v: {sky: {sun_at: {azimuth: 0, elevation: 9}}}\n",
                         ERR_FORMAT,
                         "3:7: with the variant `v`: `when` does not go with `sun_at`, which "
                         "stands in its place (`when: ~` in the variant takes it out)");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(a_study_without_daylight_says_so, forget),
        cmocka_unit_test_teardown(a_site_has_a_place_a_height_a_zone_and_its_north, forget),
        cmocka_unit_test_teardown(all_but_the_place_of_a_site_may_be_left_out, forget),
        cmocka_unit_test_teardown(each_key_of_a_site_is_checked_where_it_stands, forget),
        cmocka_unit_test_teardown(places_and_zones_that_are_none_are_named_with_their_line, forget),
        cmocka_unit_test_teardown(a_moment_may_have_an_offset_and_may_be_quoted, forget),
        cmocka_unit_test_teardown(where_no_zone_is_given_the_offset_of_the_time_is_the_zone,
                                  forget),
        cmocka_unit_test_teardown(a_series_has_dates_and_times_of_day, forget),
        cmocka_unit_test_teardown(each_key_of_a_time_is_checked_where_it_stands, forget),
        cmocka_unit_test_teardown(models_of_the_cie_are_types, forget),
        cmocka_unit_test_teardown(what_a_sky_is_not_given_has_its_default, forget),
        cmocka_unit_test_teardown(a_sky_is_read_field_by_field, forget),
        cmocka_unit_test_teardown(perez_and_panorama_have_keys_of_their_own_flat_or_nested, forget),
        cmocka_unit_test_teardown(keys_of_a_sky_are_checked_where_they_stand, forget),
        cmocka_unit_test_teardown(keys_that_contradict_or_mean_nothing_are_refused, forget),
        cmocka_unit_test_teardown(a_variant_puts_the_sky_out_whatever_keys_it_has, forget),
        cmocka_unit_test_teardown(a_variant_changes_time_and_sky, forget),
        cmocka_unit_test_teardown(a_variant_is_told_how_to_take_a_key_out, forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
