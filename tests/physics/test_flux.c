/* tests/physics/test_flux.c -- what leaves a lamp arrives at the box around it: CIE 171:2006, 5.4,
 * for every kind of light, and for luminaires with an opening of every shape.
 *
 *     flux = sum of E_i A_i        over sensors on the box's walls, that look at the lamp
 *
 * within 0.2 %: sensors in the middle of their cells are off by 1/24 of the cell's area times the
 * slopes of E at the walls' edges, and what is sampled, by its noise over the root of their number.
 */
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>

/* Grids on the walls of a cube of `side` about the origin, looking in. */
static char *walls_of_cube(lab *l, double side, double spacing)
{
    double h         = 0.5 * side;
    char *text       = text_of(&l->a, "grids:\n");
    const char *name = "abcdef";
    for (int wall = 0; wall < 6; wall++) {
        int i = wall / 2, j = (i + 1) % 3, k = (i + 2) % 3, flip = wall % 2;
        double at[] = { -h, -h, -h }, u[3] = { 0 }, v[3] = { 0 };
        at[i]           = flip ? h : -h;
        u[flip ? k : j] = side;
        v[flip ? j : k] = side;
        text            = text_of(&l->a,
                                  "%s  - {name: %c, origin: [%g, %g, %g], u: [%g, %g, %g], v: [%g, %g, %g], "
                                             "spacing: %g}\n",
                                  text, name[wall], at[0], at[1], at[2], u[0], u[1], u[2], v[0], v[1], v[2],
                                  spacing);
    }
    return text;
}

static double flux_through_cube(lab *l, const char *lamps, double side, double spacing)
{
    const scene *s =
        lab_scene(l, text_of(&l->a, "lux4: 1\n%s\n%s", lamps, walls_of_cube(l, side, spacing)));
    double flux = 0.0;
    for (int g = 0; g < 6; g++) {
        grid_result r;
        lux_error err = { 0 };
        run_options o = { .accuracy = 0.2, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
        if (!grid_run(&l->a, s, &s->study->grids[g], &o, &r, &err))
            fail_msg("%s", err.text);
        flux += r.average * side * side;
    }
    return flux;
}

static void assert_flux(const char *what, double got, double want)
{
    if (!(fabs(got - want) <= 2e-3 * want))
        fail_msg("%s: %.6g lm arrive of %.6g: %+.2g %%", what, got, want,
                 100.0 * (got / want - 1.0));
}

/* Alone, by closed forms; and among things, sampled */
static void light_arrives(const char *lamp, double spacing)
{
    for (int shaded = 0; shaded < 2; shaded++) {
        lab l;
        lab_open(&l);
        lab_speck(&l, "speck.gltf");
        char *text = text_of(&l.a, "%slights: [%s]", shaded ? "scene: speck.gltf\n" : "", lamp);
        assert_flux(lamp, flux_through_cube(&l, text, 4.0, spacing), 10000.0);
        lab_close(&l);
    }
}

TEST(the_flux_of_a_point_arrives)
{
    light_arrives("{type: point, at: [0.3, -0.2, 0.1], lumens: 10000}", 0.1);
}
TEST(the_flux_of_a_cone_arrives)
{
    light_arrives("{type: cone, at: [0.3, -0.2, 0.1], aim: [1, 2, -3], lumens: 10000, inner: 20, "
                  "outer: 50}",
                  0.05);
}
TEST(the_flux_of_a_cosine_arrives)
{
    light_arrives("{type: cosine, at: [0.3, -0.2, 0.1], aim: [1, 2, -3], lumens: 10000, "
                  "exponent: 10}",
                  0.1);
}
TEST(the_flux_of_a_line_arrives)
{
    light_arrives("{type: linear, from: [-0.5, 0.3, 0.4], to: [0.7, 0.1, -0.2], lumens: 10000}",
                  0.2);
}
TEST(the_flux_of_a_disk_arrives)
{
    light_arrives("{type: disk, at: [0.3, -0.2, 0.1], aim: [1, 2, -3], radius: 0.5, "
                  "lumens: 10000}",
                  0.25);
}
TEST(the_flux_of_a_rectangle_arrives)
{
    light_arrives("{type: rect, at: [0.3, -0.2, 0.1], aim: [1, 2, -3], up: [1, 0, 0], "
                  "size: [1.2, 0.3], lumens: 10000}",
                  0.25);
}

/* ---- luminaires ------------------------------------------------------------------------------ */

/* cos gamma (2 + cos 2C) or thereabouts below, half of it above: planes 0, 45, 90 of a quadrant. */
#define ANGLES "0 15 30 45 60 75 90 105 120 135 150 165 180\n0 45 90\n"
#define DOWN   "600 560 470 350 220 90 20 "
static const char candelas[] = DOWN "60 110 150 180 190 200\n"
                                    "600 580 510 410 290 140 20 60 110 150 180 190 200\n"
                                    "600 600 560 480 350 180 20 60 110 150 180 190 200\n";

static const struct {
    const char *shape, *size; /* width, length, height in m, by LM-63-2002 */
} openings[] = {
    { "point", "0 0 0" },
    { "rectangle", "0.3 1.2 0" },
    { "box", "0.3 1.2 0.1" },
    { "disc", "-0.6 -0.6 0" },
    { "vertical cylinder", "-0.4 -0.4 0.5" },
    { "sphere", "-0.5 -0.5 -0.5" },
    { "ellipsoid", "-0.7 -0.5 -0.3" },
    { "cylinder along", "-0.2 1.2 -0.2" },
    { "cylinder across", "1.2 -0.2 -0.2" },
    { "vertical disc", "-0.5 0 -0.5" },
    { "line", "0 1.2 0" },
};

/* Aimed askew and turned: the far field as the file has it, whatever the opening. */
TEST(the_flux_of_luminaires_of_every_shape_arrives)
{
    for (size_t i = 0; i < sizeof openings / sizeof *openings; i++)
        for (int shaded = 0; shaded < 2; shaded++) {
            lab l;
            lab_open(&l);
            lab_speck(&l, "speck.gltf");
            lab_write(&l, "lamp.ies",
                      "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 13 3 1 2 %s\n1 1 0\n" ANGLES "%s",
                      openings[i].size, candelas);
            char *text = text_of(&l.a,
                                 "%sluminaires: [{photometry: lamp.ies, at: [0.1, -0.2, 0.1], "
                                 "aim: [1, 2, -6], rotate: 30, lumens: 3000}]",
                                 shaded ? "scene: speck.gltf\n" : "");
            assert_flux(openings[i].shape, flux_through_cube(&l, text, 4.0, 0.25), 3000.0);
            lab_close(&l);
        }
}

/* As the file says, without `lumens`: EULUMDAT, in cd a kilolumen of the lamp. Even candelas of 50
 * / klm and 2000 lm of lamps: 100 cd, and 400 pi lm. */
TEST(the_flux_of_an_eulumdat_file_arrives)
{
    static const char *const opening[] = { "1200\n300\n0\n0\n0\n0", "400\n0\n0\n0\n0\n0",
                                           "1200\n300\n80\n80\n80\n80", "0\n0\n0\n0\n0\n0" };
    for (size_t i = 0; i < sizeof opening / sizeof *opening; i++) {
        lab l;
        lab_open(&l);
        lab_write(&l, "lamp.ldt",
                  "Company\n1\n1\n1\n0\n3\n90\nReport\nName\nNumber\nfile.ldt\ndate\n500\n400\n30\n"
                  "%s\n50\n62.83\n1\n0\n1\n1\nLED\n2000\n3000\n80\n40\n"
                  "0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n90\n180\n50\n50\n50\n",
                  opening[i]);
        assert_flux(
            opening[i],
            flux_through_cube(&l, "luminaires: [{photometry: lamp.ldt, at: [0, 0, 0]}]", 4.0, 0.25),
            400.0 * M_PI);
        lab_close(&l);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_flux_of_a_point_arrives),
        cmocka_unit_test(the_flux_of_a_cone_arrives),
        cmocka_unit_test(the_flux_of_a_cosine_arrives),
        cmocka_unit_test(the_flux_of_a_line_arrives),
        cmocka_unit_test(the_flux_of_a_disk_arrives),
        cmocka_unit_test(the_flux_of_a_rectangle_arrives),
        cmocka_unit_test(the_flux_of_luminaires_of_every_shape_arrives),
        cmocka_unit_test(the_flux_of_an_eulumdat_file_arrives),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
