/* tests/physics/test_panes.c -- light through panes of glass and holes, as shadow rays and paths
 * have it together: against the slab's transmittance, integrated over what glows.
 */
#include "core/color.h"
#include "sim/render.h"
#include "tests/gltf_text.h"
#include "tests/slab.h"
#include "tests/test.h"

static const dvec3 up = { 0, 0, 1 }, down = { 0, 0, -1 };

/* ---- what is seen through level panes -------------------------------------------------------- */

typedef struct through {
    dvec3 normal; /* of the sensor */
    double n, inner[3];
    int panes;       /* 1, or 2 in a row */
    int reflections; /* to and fro between them */
} through;

/* As luminance, cosine and all, of 1 cd/m^2 */
static double passes(const void *context, dvec3 wi)
{
    static const double share[3] = { 0.2126, 0.7152, 0.0722 };
    const through *t             = context;
    double sum                   = 0.0;
    for (int c = 0; c < 3; c++) {
        slab s = slab_of(t->n, t->inner[c], fabs(wi.z));
        sum += share[c] * pow(s.passed, t->panes) * pow(s.reflected, 2 * t->reflections);
    }
    return sum * fmax(d3_dot(wi, t->normal), 0.0);
}

enum { N = 6 };

static void sensors(lab_probe p[N])
{
    for (int i = 0; i < N; i++)
        p[i] = (lab_probe){ { 0.5 + i, 1 + 0.4 * i, 0.1 }, up };
    p[1].normal = (dvec3){ 0.6, 0, 0.8 };
    p[4].normal = (dvec3){ -1, 0, 0.2 };
    for (int i = 0; i < N; i++)
        p[i].normal = d3_scale(p[i].normal, 1.0 / d3_length(p[i].normal));
}

#define DARK        "room: {size: [6, 4, 3], reflectance: 0}\n"
#define GLASS(more) "materials: [{match: Glass, " more "}]\n"

/* A glowing square of that size at z = 2.5, above what `pane` holds. */
static void glow_through(const quad *pane, int quads, const char *materials, const through *like,
                         double size, double accuracy)
{
    lab l;
    lab_open(&l);
    quad glow = quad_level(2.2, 1.7, 2.5, size);
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 3000.0));
    lab_quads(&l, "pane.gltf", pane, quads, "\"name\":\"Glass\"");
    lab_probe p[N];
    double want[N] = { 0 };
    sensors(p);
    for (int i = 0; i < N; i++)
        for (int k = 0; k <= like->reflections; k++) {
            through t     = *like;
            t.normal      = p[i].normal;
            t.reflections = k;
            /* Each passage to and fro lets the square stand twice the gap higher */
            quad image = quad_level(2.2, 1.7, 2.5 + 2.0 * 0.05 * k, size);
            want[i] += 3000.0 * quad_integral(&image, p[i].at, 20, passes, &t);
        }
    grid_result r;
    lab_measure(&l, text_of(&l.a, DARK "scene: [glow.gltf, pane.gltf]\n%s", materials), NULL, p, N,
                &(run_options){ .accuracy = accuracy }, &r);
    lab_check("through panes", &r, want, 1e-4, accuracy);
    if (!like->reflections)
        for (int i = 0; i < N; i++)
            assert_near(r.direct[i], r.illuminance[i], 1e-6);
    assert_null(r.left_to_chance);
    lab_close(&l);
}

static through clear_pane(double n, double r, double g, double b)
{
    return (through){ .n     = n,
                      .inner = { slab_inner(n, r), slab_inner(n, g), slab_inner(n, b) },
                      .panes = 1 };
}

TEST(a_glowing_square_shines_through_a_pane_by_angle)
{
    quad pane = quad_level(3, 2, 1.5, 20);
    through t = clear_pane(1.52, 0.8, 0.8, 0.8);
    glow_through(&pane, 1, GLASS("transmittance: 0.8"), &t, 1.0, 0.005);
}

TEST(coloured_glass_tints_what_shines_through)
{
    quad pane = quad_level(3, 2, 1.5, 20);
    through t = clear_pane(1.6, 0.2, 0.6, 0.85);
    glow_through(&pane, 1, GLASS("transmittance: [0.2, 0.6, 0.85], ior: 1.6"), &t, 1.0, 0.005);
}

TEST(a_closed_box_of_glass_is_one_pane)
{
    quad pane[6];
    quads_of_box((dvec3){ -7, -8, 1.5 }, (dvec3){ 13, 12, 1.51 }, pane);
    through t = clear_pane(1.52, 0.8, 0.8, 0.8);
    glow_through(pane, 6, GLASS("transmittance: 0.8, pane: box"), &t, 1.0, 0.005);
}

/* T^2 / (1 - R^2): what goes to and fro between them is found by paths alone. */
TEST(double_glazing_passes_what_goes_to_and_fro_as_well)
{
    quad pane[2]  = { quad_level(3, 2, 1.5, 20), quad_level(3, 2, 1.55, 20) };
    through t     = clear_pane(1.7, 0.85, 0.85, 0.85);
    t.panes       = 2;
    t.reflections = 6;
    glow_through(pane, 2, GLASS("transmittance: 0.85, ior: 1.7"), &t, 3.0, 0.01);
}

/* ---- holes ----------------------------------------------------------------------------------- */

TEST(what_is_a_quarter_there_lets_three_quarters_through)
{
    lab l;
    lab_open(&l);
    quad glow = quad_level(2.2, 1.7, 2.5, 1), veil = quad_level(3, 2, 1.5, 20);
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 3000.0));
    lab_quads(&l, "veil.gltf", &veil, 1,
              "\"name\":\"Veil\",\"alphaMode\":\"BLEND\",\"pbrMetallicRoughness\":{"
              "\"baseColorFactor\":[0,0,0,0.25],\"metallicFactor\":0,\"roughnessFactor\":1}");
    lab_probe p[N];
    double want[N];
    sensors(p);
    for (int i = 0; i < N; i++) {
        dvec3 d = d3_sub((dvec3){ 4, 2, 2.5 }, p[i].at);
        want[i] = 0.75 * (3000.0 * polygon_lux(glow.corner, 4, p[i].at, p[i].normal) +
                          500.0 * fmax(d3_dot(d, p[i].normal), 0.0) / pow(d3_dot(d, d), 1.5));
    }
    grid_result r;
    lab_measure(&l,
                DARK "scene: [glow.gltf, veil.gltf]\n"
                     "lights: [{type: point, at: [4, 2, 2.5], intensity: 500}]\n",
                NULL, p, N, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("veil", &r, want, 1e-4, 0.01);
    lab_close(&l);
}

/* ---- many, and in awkward places ------------------------------------------------------------- */

/* Straight on through any number: T^n under parallel light. */
TEST(forty_panes_pass_what_each_lets_through)
{
    static const int counts[] = { 1, 7, 8, 9, 17, 40 };
    for (int i = 0; i < 6; i++) {
        lab l;
        lab_open(&l);
        quad pane[40];
        for (int k = 0; k < counts[i]; k++)
            pane[k] = quad_level(0, 0, 1 + 0.1 * k, 10);
        lab_quads(&l, "pane.gltf", pane, counts[i], "\"name\":\"Glass\"");
        const lab_probe p = { { 0.1, 0.3, 0 }, up };
        grid_result r;
        lab_measure(&l,
                    "scene: pane.gltf\nmaterials: [{match: Glass, transmittance: 0.9}]\n"
                    "lights: [{type: parallel, aim: [0, 0, -1], illuminance: 1000}]\n",
                    NULL, &p, 1, &(run_options){ .direct_only = true }, &r);
        /* a float's rounding a pane, and the transmittance's own, taken so often */
        assert_near(r.illuminance[0], 1000.0 * pow(0.9, counts[i]), 3e-7 * (1 + counts[i]));
        lab_close(&l);
    }
}

static void look_along(lab *l, const char *yaml, double accuracy, view_result *out)
{
    const scene *s = lab_scene(l, yaml);
    lux_error err  = { 0 };
    run_options o  = { .accuracy = accuracy, .deadline = HUGE_VAL, .seed = 1, .threads = 1 };
    if (!view_run(&l->a, s, &s->study->views[0], &o, out, &err))
        fail_msg("%s", err.text);
}

/* Mean luminance of the picture, and what its pixels' intervals make of it. */
static double mean_of(const view_result *r, int channel, double *half)
{
    double sum = 0.0, squares = 0.0;
    int n = r->width * r->height;
    for (int i = 0; i < n; i++) {
        sum += LUMENS_PER_WATT * (double)r->radiance[channel][i];
        squares += (double)r->half_width[i] * (double)r->half_width[i];
    }
    *half = sqrt(squares) / n;
    return sum / n;
}

/* n panes that absorb nothing: T / (T + n R), a flux that is the same between all of them. Seen
 * straight on before an even glow, black behind the eye. */
TEST(a_stack_of_panes_shows_the_glow_behind_it)
{
    static const int counts[] = { 1, 9, 33 };
    const double t            = slab_of(1.52, 1.0, 1.0).passed;
    for (int i = 0; i < 3; i++) {
        lab l;
        lab_open(&l);
        quad pane[33], glow = quad_level(0, 0, 0, 50);
        for (int k = 0; k < counts[i]; k++)
            pane[k] = quad_level(0, 0, 1 + 0.1 * k, 50);
        lab_quads(&l, "pane.gltf", pane, counts[i], "\"name\":\"Glass\"");
        lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 1000.0));
        view_result r;
        look_along(&l,
                   text_of(&l.a,
                           "lux4: 1\nscene: [pane.gltf, glow.gltf]\n"
                           "materials: [{match: Glass, transmittance: %.9g}]\n"
                           "views: [{name: v, projection: orthographic, eye: [0, 0, 9], target: "
                           "[0, 0, 0], width: 1, size: [5, 5]}]\n",
                           t),
                   0.1, &r);
        double half, mean = mean_of(&r, 1, &half);
        double want = 1000.0 * t / (t + counts[i] * (1.0 - t));
        if (!(fabs(mean - want) <= 1e-4 * want + 2.0 * half) || !(half < 0.03 * want))
            fail_msg("%d panes: %.6g cd/m^2 +- %.2g, not %.6g", counts[i], mean, half, want);
        lab_close(&l);
    }
}

/* On the glass itself each side has what falls on it. */
TEST(sensors_on_a_pane_have_the_light_of_their_side)
{
    lab l;
    lab_open(&l);
    quad glow = quad_level(2.2, 1.7, 2.5, 1), pane = quad_level(3, 2, 1.5, 20);
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 3000.0));
    lab_quads(&l, "pane.gltf", &pane, 1, "\"name\":\"Glass\"");
    const lab_probe p[] = { { { 3.1, 2.3, 1.5 }, up }, { { 3.1, 2.3, 1.5 }, down } };
    const dvec3 lamp    = { 3.5, 2, 0.5 };
    dvec3 d             = d3_sub(lamp, p[1].at);
    double want[2]      = { 3000.0 * polygon_lux(glow.corner, 4, p[0].at, up),
                            200.0 * -d.z / pow(d3_dot(d, d), 1.5) };
    grid_result r;
    lab_measure(
        &l,
        DARK "scene: [glow.gltf, pane.gltf]\n" GLASS(
            "transmittance: 0.8") "lights: [{type: point, at: [3.5, 2, 0.5], intensity: 200}]\n",
        NULL, p, 2, &(run_options){ .accuracy = 0.01 }, &r);
    lab_check("on the glass", &r, want, 1e-4, 0.01);
    lab_close(&l);
}

/* Glass on a board: what is opaque stays so, wherever the rounding puts the glass. */
TEST(glass_that_lies_in_something_opaque_lets_no_lamp_through)
{
    lab l;
    lab_open(&l);
    quad pane  = quad_level(3, 2, 1.5, 20);
    quad board = { { { 13, 12, 1.5 }, { -7, 12, 1.5 }, { -7, -8, 1.5 }, { 13, -8, 1.5 } } };
    lab_quads(&l, "pane.gltf", &pane, 1, "\"name\":\"Glass\"");
    lab_quads(&l, "board.gltf", &board, 1, "\"name\":\"Black\"");
    lab_probe p[N];
    sensors(p);
    grid_result r;
    lab_measure(&l,
                DARK "scene: [pane.gltf, board.gltf]\nmaterials: [{match: Black, reflectance: 0},\n"
                     "  {match: Glass, transmittance: 0.8}]\n"
                     "lights: [{type: point, at: [4, 2, 2.5], intensity: 500}]\n",
                NULL, p, N, &(run_options){ .accuracy = 0.02 }, &r);
    for (int i = 0; i < N; i++)
        assert_near(r.illuminance[i], 0.0, 1e-9);
    lab_close(&l);
}

/* The globe of a lamp is part of its photometry: its own light passes as if it were not there,
 * and that of others as glass lets it. */
TEST(the_glass_of_a_luminaire_tints_the_light_of_others_alone)
{
    lab l;
    lab_open(&l);
    quad side[6];
    quads_of_box((dvec3){ -0.2, -0.2, -0.2 }, (dvec3){ 0.2, 0.2, 0.2 }, side);
    lab_write(&l, "lamp.gltf",
              "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"name\":"
              "\"Lamp\",\"mesh\":0,\"translation\":[3,2,-2]}],\"materials\":[{\"name\":\"Glass\"}],"
              "%s}",
              lab_mesh(&l, side, 6, NULL, 0));
    lab_write(&l, "lamp.ies",
              "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 2 1 1 2 0 0 0\n1 1 10\n0 180\n0\n100 100\n");
    const lab_probe p[] = { { { 3, 2, 0 }, up }, { { 1, 3, 0.5 }, up } };
    double t            = slab_of(1.52, slab_inner(1.52, 0.7), 1.0).passed;
    dvec3 own = d3_sub((dvec3){ 3, 2, 2 }, p[1].at), other = d3_sub((dvec3){ 3, 2, 2.5 }, p[1].at);
    /* The other lamp stands straight above the first: two faces lie before sensor 0, none before 1
     */
    double want[] = { 100.0 / 4.0 + t * t * 400.0 / 6.25,
                      100.0 * own.z / pow(d3_dot(own, own), 1.5) +
                          400.0 * other.z / pow(d3_dot(other, other), 1.5) };
    grid_result r;
    lab_measure(
        &l,
        DARK "scene: lamp.gltf\n" GLASS(
            "transmittance: 0.7") "luminaires: [{photometry: lamp.ies, nodes: Lamp}]\n"
                                  "lights: [{type: point, at: [3, 2, 2.5], intensity: 400}]\n",
        NULL, p, 2, &(run_options){ .direct_only = true }, &r);
    for (int i = 0; i < 2; i++)
        assert_near(r.illuminance[i], want[i], 1e-5);
    lab_close(&l);
}

/* ---- solids ---------------------------------------------------------------------------------- */

static const char solid_glass[] =
    "\"name\":\"Solid\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0},"
    "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
    "\"KHR_materials_volume\":{\"thicknessFactor\":1,\"attenuationDistance\":0.5,"
    "\"attenuationColor\":[0.5,0.5,0.5]}}";

/* Square on, nothing is bent: (1 - F)^2 exp(-s d) of parallel light, once and straight. */
TEST(a_solid_absorbs_over_its_thickness)
{
    lab l;
    lab_open(&l);
    quad solid[6];
    quads_of_box((dvec3){ -5, -5, 1 }, (dvec3){ 5, 5, 1.25 }, solid);
    lab_quads(&l, "solid.gltf", solid, 6, solid_glass);
    const lab_probe p[] = { { { 0.1, 0.3, 0 }, up }, { { 0.1, 0.3, 1.1 }, up } };
    grid_result r;
    lab_measure(&l,
                "scene: solid.gltf\n"
                "lights: [{type: parallel, aim: [0, 0, -1], illuminance: 1000}]\n",
                NULL, p, 2, &(run_options){ .direct_only = true }, &r);
    assert_near(r.illuminance[0], 1000.0 * 0.96 * 0.96 * sqrt(0.5), 1e-5);
    assert_near(r.illuminance[1], 1000.0 * 0.96 * pow(0.5, 0.3), 1e-5); /* 15 cm deep */
    lab_close(&l);
}

/* Square on, from the eye, all passages within add up: the slab of n = 1.5. */
TEST(a_glow_is_seen_through_a_solid_as_through_a_slab)
{
    lab l;
    lab_open(&l);
    quad solid[6], glow = quad_level(0, 0, 0, 50);
    quads_of_box((dvec3){ -5, -5, 1 }, (dvec3){ 5, 5, 1.25 }, solid);
    lab_quads(&l, "solid.gltf", solid, 6, solid_glass);
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 1000.0));
    view_result r;
    look_along(&l,
               "lux4: 1\nscene: [solid.gltf, glow.gltf]\n"
               "views: [{name: v, projection: orthographic, eye: [0, 0, 9], target: [0, 0, 0], "
               "width: 1, size: [16, 16]}]\n",
               0.05, &r);
    double half, mean = mean_of(&r, 1, &half), want = 1000.0 * slab_of(1.5, sqrt(0.5), 1.0).passed;
    if (!(fabs(mean - want) <= 1e-4 * want + 2.0 * half) || !(half < 0.01 * want))
        fail_msg("%.6g cd/m^2 +- %.2g, not %.6g", mean, half, want);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_glowing_square_shines_through_a_pane_by_angle),
        cmocka_unit_test(coloured_glass_tints_what_shines_through),
        cmocka_unit_test(a_closed_box_of_glass_is_one_pane),
        cmocka_unit_test(double_glazing_passes_what_goes_to_and_fro_as_well),
        cmocka_unit_test(what_is_a_quarter_there_lets_three_quarters_through),
        cmocka_unit_test(forty_panes_pass_what_each_lets_through),
        cmocka_unit_test(a_stack_of_panes_shows_the_glow_behind_it),
        cmocka_unit_test(sensors_on_a_pane_have_the_light_of_their_side),
        cmocka_unit_test(glass_that_lies_in_something_opaque_lets_no_lamp_through),
        cmocka_unit_test(the_glass_of_a_luminaire_tints_the_light_of_others_alone),
        cmocka_unit_test(a_solid_absorbs_over_its_thickness),
        cmocka_unit_test(a_glow_is_seen_through_a_solid_as_through_a_slab),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
