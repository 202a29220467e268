/* tests/physics/test_asked_and_found.c -- light that is asked for and light that rays find make up
 * the whole together, also where one of the two does not see it: behind solids that refract, and
 * past the body of a lamp.
 */
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>

static const dvec3 up = { 0, 0, 1 };

/* A solid of n = 1.5; `absorbs` is its attenuation distance and colour, "" for none. */
static char *solid_of(lab *l, const char *absorbs)
{
    char *text = arena_array(&l->a, char, 400, NULL);
    snprintf(
        text, 400,
        "\"name\":\"Solid\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":"
        "0},\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
        "\"KHR_materials_volume\":{\"thicknessFactor\":1%s}}",
        absorbs);
    return text;
}

/* What passes one face of n = 1.5, unpolarised (Fresnel). */
static double passes_face(double cosine)
{
    const double n = 1.5;
    double inner   = sqrt(1.0 - (1.0 - cosine * cosine) / (n * n));
    double s       = (cosine - n * inner) / (cosine + n * inner);
    double p       = (n * cosine - inner) / (n * cosine + inner);
    return 1.0 - 0.5 * (s * s + p * p);
}

/* A glowing square of 4 m, 1 m above: by quadrature of L cos^2 / r^2 (1 - F)^2, as the light is
 * taken to pass the plate straight. */
TEST(a_plate_of_glass_takes_nothing_from_a_glow_but_what_it_reflects)
{
    enum { STEPS = 400 };
    lab l;
    lab_open(&l);
    quad plate[6], glow = { { { -2, -2, 1 }, { -2, 2, 1 }, { 2, 2, 1 }, { 2, -2, 1 } } };
    quads_of_box((dvec3){ -9, -9, 0.5 }, (dvec3){ 9, 9, 0.52 }, plate);
    lab_quads(&l, "plate.gltf", plate, 6, solid_of(&l, ""));
    lab_quads(&l, "glow.gltf", &glow, 1, lab_glow(&l, 1000.0));
    double want = 0.0, step = 4.0 / STEPS;
    for (int i = 0; i < STEPS * STEPS; i++) {
        double x = -2.0 + step * (i % STEPS + 0.5), y = -2.0 + step * (i / STEPS + 0.5);
        double r2 = x * x + y * y + 1.0, cosine = 1.0 / sqrt(r2);
        want += 1000.0 * cosine * cosine / r2 * pow(passes_face(cosine), 2.0) * step * step;
    }
    const lab_probe p = { { 0, 0, 0 }, up };
    for (int direct = 0; direct < 2; direct++) {
        grid_result r;
        lab_measure(&l, "scene: [plate.gltf, glow.gltf]\n", NULL, &p, 1,
                    &(run_options){ .accuracy = 0.01, .threads = 1, .direct_only = direct }, &r);
        lab_check("below a plate", &r, &want, 1e-3, 0.01);
    }
    lab_close(&l);
}

/* From within one plate of glass to a lamp within another: 10 cm of each, both faces between. */
TEST(light_from_solid_to_solid_is_absorbed_in_both)
{
    lab l;
    lab_open(&l);
    quad low[6], high[6];
    char *made_of = solid_of(&l, ",\"attenuationDistance\":0.1,\"attenuationColor\":[0.5,0.5,0.5]");
    quads_of_box((dvec3){ -3, -3, -0.1 }, (dvec3){ 3, 3, 0.1 }, low);
    quads_of_box((dvec3){ -3, -3, 0.9 }, (dvec3){ 3, 3, 1.1 }, high);
    lab_quads(&l, "low.gltf", low, 6, made_of);
    lab_quads(&l, "high.gltf", high, 6, made_of);
    const lab_probe p = { { 0, 0, 0 }, up };
    grid_result r;
    lab_measure(&l,
                "scene: [low.gltf, high.gltf]\n"
                "lights: [{type: point, at: [0, 0, 1], intensity: 1000}]\n",
                NULL, &p, 1, &(run_options){ .threads = 1, .direct_only = true }, &r);
    /* Shadow rays end some 15 um before a lamp, which take 1e-4 of absorption with them */
    assert_near(r.illuminance[0], 1000.0 * 0.96 * 0.96 * 0.5 * 0.5, 2e-4);
    lab_close(&l);
}

/* A lamp of 1 m square in a shade that hides it from below: its photometry holds the shade, and
 * what a floor shines back must not depend on whether rays look for the lamp as well. */
static double above_floor(lab *l, const char *floor_is, double *half)
{
    char yaml[500];
    snprintf(yaml, sizeof yaml,
             "room: {size: [4, 4, 3], reflectance: 0.3}\nscene: shade.gltf\n"
             "materials: [{match: \"room: floor\", %s}, {match: Shade, reflectance: 0}]\n"
             "luminaires: [{photometry: lamp.ies, nodes: Lamp}]\n",
             floor_is);
    const lab_probe p = { { 1.2, 1.5, 1.0 }, { 0, 0, -1 } };
    grid_result r;
    lab_measure(l, yaml, NULL, &p, 1, &(run_options){ .accuracy = 0.01, .threads = 1 }, &r);
    *half = r.half_width[0];
    return r.illuminance[0];
}

TEST(lamps_with_bodies_shine_on_what_is_not_matt_as_on_what_is)
{
    lab l;
    lab_open(&l);
    quad shade[6];
    quads_of_box((dvec3){ -0.6, -0.6, -0.05 }, (dvec3){ 0.6, 0.6, 0.05 }, shade);
    lab_write(
        &l, "shade.gltf",
        "{\"asset\":{\"version\":\"2.0\"},\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{\"name\":"
        "\"Lamp\",\"mesh\":0,\"translation\":[2,2.2,-2]}],\"materials\":[{\"name\":\"Shade\"}],"
        "%s}",
        lab_mesh(&l, shade, 6, NULL, 0));
    lab_write(&l, "lamp.ies",
              "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 1 1 2 1 1 0\n1 1 10\n0 45 90\n0\n900 640 0\n");
    double half[2], matt = above_floor(&l, "reflectance: 0.8", &half[0]);
    double lobe = above_floor(&l, "reflectance: 0.8, specular: 0.000001, exponent: 100", &half[1]);
    if (!(fabs(matt - lobe) <= 1.5 * (half[0] + half[1])))
        fail_msg("%.5g lx +- %.2g of a matt floor, %.5g +- %.2g of one with a lobe", matt, half[0],
                 lobe, half[1]);
    assert_true(matt > 10.0);
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_plate_of_glass_takes_nothing_from_a_glow_but_what_it_reflects),
        cmocka_unit_test(light_from_solid_to_solid_is_absorbed_in_both),
        cmocka_unit_test(lamps_with_bodies_shine_on_what_is_not_matt_as_on_what_is),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
