/* tests/unit/test_photometry_write.c -- webs written and read again, in both formats. */
#include "tests/eulumdat_sheet.h"

#include <unistd.h>

static const photometry *again(const photometry *p, const char *path, reading *out)
{
    memset(out, 0, sizeof *out);
    out->n.a = &out->a;
    if (!photometry_write(p, path, &out->n, &out->err))
        fail_msg("%s", out->err.text);
    out->p = photometry_read(&out->a, path, &out->n, &out->err);
    if (!out->p)
        fail_msg("%s", out->err.text);
    unlink(path);
    return out->p;
}

/* The same light in all directions, the same opening in space, and what else is kept. */
static void assert_same(const photometry *a, const photometry *b)
{
    for (int c = 0; c < 360; c += 9)
        for (int g = 0; g <= 180; g += 5)
            assert_near(photometry_candela(b, c, g), photometry_candela(a, c, g), 1e-6);
    assert_near(b->luminaire_lumens, a->luminaire_lumens, 1e-6);
    assert_near(b->lamp_lumens, a->lamp_lumens, 1e-6);
    assert_near(b->watts, a->watts, 1e-6);
    assert_int_equal(b->symmetry, a->symmetry);
    assert_int_equal(b->absolute, a->absolute);
    bool turned = a->length_along_deg != b->length_along_deg;
    assert_near(b->length, turned ? a->width : a->length, 1e-6);
    assert_near(b->width, turned ? a->length : a->width, 1e-6);
    assert_near(b->height, a->height, 1e-6);
    assert_string_equal(b->manufacturer, a->manufacturer);
    assert_string_equal(b->name, a->name);
    assert_string_equal(b->catalog, a->catalog);
    assert_string_equal(b->lamp, a->lamp);
}

TEST(from_one_format_to_the_other_and_back_light_and_opening_stay)
{
    ldt t    = plain;
    t.planes = "8", t.angles = EIGHT, t.opening = "1200\n300\n20\n20\n20\n20";
    const char *symmetry[] = { "0", "1", "2", "3", "4" };
    for (int i = 0; i < 5; i++) {
        t.symmetry = symmetry[i];
        t.values   = "9\n1\n1\n9\n1\n2\n9\n1\n3\n9\n1\n4\n9\n1\n5\n9\n1\n6\n9\n1\n7\n9\n1\n8";
        t.sets     = i % 2 ? ONE_SET : "1\n-1\nLED\n500\n\n\n5\n";
        reading ies, ldt_;
        assert_non_null(read_ldt(t));
        const photometry *b = again(r.p, "build/round_trip.ies", &ies);
        assert_same(r.p, b);
        assert_int_equal(b->format, PHOTOMETRY_LM63_2002);
        assert_near(b->length, 0.3, 1e-6); /* along C0 what was the width */
        const photometry *c = again(b, "build/round_trip.ldt", &ldt_);
        assert_same(b, c);
        assert_same(r.p, c);
        assert_near(c->length, 1.2, 1e-6);
        assert_int_equal(c->opening, OPENING_BOX);
        arena_clear(&ies.a);
        arena_clear(&ldt_.a);
    }
}

TEST(a_web_without_planes_on_the_axes_is_written_whole)
{
    const float plane[] = { 30, 150, 270 }, gamma[] = { 10, 170 };
    const float candela[] = { 1, 2, 3, 4, 5, 6 };
    photometry p          = { .plane_count = 3,
                              .gamma_count = 2,
                              .plane_deg   = plane,
                              .gamma_deg   = gamma,
                              .candela     = candela,
                              .absolute    = true };
    p.luminaire_lumens    = photometry_flux(&p, 0, 180);
    p.manufacturer = p.name = p.catalog = p.lamp = "";
    reading out;
    assert_same(&p, again(&p, "build/round_trip.ies", &out));
    arena_clear(&out.a);
    p.length_along_deg = 90.0f;
    assert_same(&p, again(&p, "build/round_trip.ldt", &out));
    arena_clear(&out.a);
}

TEST(round_openings_keep_their_shape_in_lm_63)
{
    const opening_shape shapes[] = { OPENING_POINT,          OPENING_LINE,
                                     OPENING_RECTANGLE,      OPENING_BOX,
                                     OPENING_DISC,           OPENING_VERTICAL_CYLINDER,
                                     OPENING_SPHERE,         OPENING_CYLINDER_ALONG,
                                     OPENING_CYLINDER_ACROSS };
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++) {
        assert_non_null(read_ldt(plain));
        photometry p = *r.p;
        p.opening = shapes[i], p.length_along_deg = 0.0f;
        if (i > 0)
            p.length = 0.5f;
        if (i > 1)
            p.width = 0.4f;
        if (i == 3 || i > 4)
            p.height = 0.3f;
        reading out;
        assert_int_equal(again(&p, "build/round_trip.ies", &out)->opening, shapes[i]);
        assert_same(&p, out.p);
        /* LM-63 has no line: once said when it is written, once when it is read */
        assert_int_equal(out.n.count, shapes[i] == OPENING_LINE ? 2 : 0);
        arena_clear(&out.a);
    }
}

/* A line along C0 is across in EULUMDAT, whose width of 0 would make the other one round. */
TEST(lines_keep_their_direction_in_eulumdat)
{
    for (int along = 0; along <= 90; along += 90) {
        assert_non_null(read_ldt(plain));
        photometry p = *r.p;
        p.opening = OPENING_LINE, p.length = 0.5f, p.length_along_deg = (float)along;
        reading out;
        again(&p, "build/round_trip.ldt", &out);
        assert_int_equal(out.p->opening, along == 90 ? OPENING_RECTANGLE : OPENING_LINE);
        assert_near(out.p->length, along == 90 ? 0.5 : 0.0, 1e-6);
        assert_near(out.p->width, along == 90 ? 0.001 : 0.5, 1e-6);
        assert_int_equal(out.n.count, along == 90 ? 1 : 0);
        arena_clear(&out.a);
    }
}

TEST(what_a_format_has_no_word_for_is_said)
{
    const float angle[2] = { 0, 90 }, factor[2] = { 1, 0.5f };
    ldt t     = plain;
    t.opening = "1200\n300\n10\n20\n10\n20";
    assert_non_null(read_ldt(t));
    photometry p = *r.p;
    p.tilt_count = 2, p.tilt_geometry = 3, p.tilt_deg = angle, p.tilt_factor = factor;
    p.name = "A name that is longer than the 78 bytes which a line of EULUMDAT holds, and by a few "
             "more words";
    reading out;
    again(&p, "build/round_trip.ldt", &out);
    assert_int_equal(out.p->tilt_count, 0);
    assert_int_equal(strlen(out.p->name), 78);
    assert_true(out.p->side_height[0] == 0.01f && out.p->side_height[1] == 0.02f);
    assert_int_equal(out.n.count, 3); /* the tilt, the label; and uneven heights when read */
    arena_clear(&out.a);

    again(&p, "build/round_trip.ies", &out);
    assert_string_equal(out.p->name, p.name);
    assert_int_equal(out.p->tilt_count, 2);
    assert_int_equal(out.p->tilt_geometry, 3);
    assert_near(photometry_tilt_factor(out.p, 45), 0.75, 1e-7);
    assert_string_equal(out.n.first->text, "build/round_trip.ies: LM-63 has one height of the "
                                           "opening: 0.02 m, the greatest");
    assert_int_equal(out.n.count, 1);
    arena_clear(&out.a);
}

TEST(only_names_that_say_a_format_are_written)
{
    lux_error err = { 0 };
    assert_non_null(read_ldt(plain));
    assert_false(photometry_write(r.p, "build/web.txt", NULL, &err));
    assert_string_equal(err.text, "build/web.txt: expected a name that ends in .ies or .ldt");
    assert_false(photometry_write(r.p, "build/no/such/folder/web.ies", NULL, &err));
    assert_int_equal(err.code, ERR_IO);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(from_one_format_to_the_other_and_back_light_and_opening_stay),
        cmocka_unit_test(a_web_without_planes_on_the_axes_is_written_whole),
        cmocka_unit_test(round_openings_keep_their_shape_in_lm_63),
        cmocka_unit_test(lines_keep_their_direction_in_eulumdat),
        cmocka_unit_test(what_a_format_has_no_word_for_is_said),
        cmocka_unit_test(only_names_that_say_a_format_are_written),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
