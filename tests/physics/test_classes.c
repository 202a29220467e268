/* tests/physics/test_classes.c -- every way of light is of one class, and none is lost.
 *
 * A lamp with extent can be found by rays alone, with no mirror image asked for and no particle
 * sent: as much light, by chance, as all classes together.
 */
#include "tests/folder.h"
#include "tests/gltf_text.h"
#include "tests/lab_sphere.h"
#include "tests/slab.h"
#include "tests/test.h"
#include "tests/transports.h"

static const double stretch = 4.0728 / 2.1314; /* 95 to 99.9 %, t of 15 degrees of freedom */

static void assert_adds_up(const grid_result *r)
{
    double sum = 0.0, halves = 0.0;
    for (int c = 0; c < LIGHT_CLASSES; c++) {
        sum += r->classes[c].average;
        halves += r->classes[c].half_width;
    }
    /* What is all but nothing is not told as less than nothing; sums are of floats */
    assert_true(fabs(sum - r->average) <= 1e-5 * r->average);
    assert_true(halves >= 0.0);
}

/* ---- a lamp of size in a room with all there is ---------------------------------------------- */

static const char glass[] =
    "\"name\":\"Lens\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0},"
    "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
    "\"KHR_materials_volume\":{\"thicknessFactor\":1}}";

#define LIT                                                                                        \
    "room: {size: [4, 3, 2.6], reflectance: 0.5}\n"                                                \
    "scene: [mirror.gltf, pane.gltf, lens.gltf, ball.gltf]\n"                                      \
    "lights: [{type: rect, at: [2, 1.5, 2.5], aim: [0, 0, -1], size: [1.2, 0.8], lumens: 3000}]\n" \
    "materials:\n"                                                                                 \
    "  - {match: Mirror, mirror: 0.9}\n"                                                           \
    "  - {match: Pane, transmittance: 0.7}\n"                                                      \
    "  - {match: Ball, mirror: 0.8}\n"                                                             \
    "grids: [{name: g, points: probes.csv}]\n"

enum { N = 6 };

static const scene *room_of_all(lab *l)
{
    quad mirror = {
        { { 0.01, 0.3, 0.2 }, { 0.01, 2.7, 0.2 }, { 0.01, 2.7, 2 }, { 0.01, 0.3, 2 } }
    };
    quad pane = { { { 2.6, 0.5, 0 }, { 2.6, 2.5, 0 }, { 2.6, 2.5, 1.4 }, { 2.6, 0.5, 1.4 } } };
    lab_quads(l, "mirror.gltf", &mirror, 1, "\"name\":\"Mirror\"");
    lab_quads(l, "pane.gltf", &pane, 1, "\"name\":\"Pane\"");
    lab_sphere(l, "lens.gltf", (dvec3){ 1.5, 1.5, 1.2 }, 0.4, 24, glass);
    lab_sphere(l, "ball.gltf", (dvec3){ 3.3, 2.2, 0.5 }, 0.3, 24, "\"name\":\"Ball\"");
    lab_write(l, "probes.csv",
              "x,y,z,nx,ny,nz\n1.5,1.5,0.02,0,0,1\n1.0,1.2,0.02,0,0,1\n0.5,2,0.8,0,0,1\n"
              "3,1,0.4,0,0,1\n2.9,1.9,0.6,1,0,0\n2,0.4,1.2,0,0.6,0.8\n");
    return lab_scene(l, "lux4: 1\n" LIT);
}

static void measure(lab *l, const scene *s, transport by, bool brute, grid_result *r)
{
    scene plain      = *s;
    plain.lamps_hide = !brute; /* a map of focused light is made all the same */
    if (brute)                 /* all that rays find by chance */
        plain.mirror_images = NULL;
    grid_of_scene(&l->a, &plain, 0,
                  &(run_options){ .accuracy     = 0.05,
                                  .seed         = brute ? 5 : 3,
                                  .only_samples = brute ? 1 << 14 : 0,
                                  .threads      = 2,
                                  .transport    = by },
                  r);
    assert_int_equal(r->sensor_count, N);
    assert_adds_up(r);
}

TEST(images_focused_light_and_paths_are_together_what_rays_find_by_chance)
{
    lab l;
    lab_open(&l);
    const scene *s = room_of_all(&l);
    assert_non_null(s->mirror_images);
    assert_true(s->by_lamps.focused > SHARE_THAT_MATTERS);
    grid_result brute, r;
    measure(&l, s, TRANSPORT_PATH, true, &brute);
    for (int t = 0; t < TRANSPORTS; t++) {
        measure(&l, s, transports[t], false, &r);
        for (int k = 0; k < N; k++) {
            double joint = stretch * hypot(r.half_width[k], brute.half_width[k]);
            if (!(fabs(r.illuminance[k] - brute.illuminance[k]) <= joint))
                fail_msg("sensor %d, transport %d: %g +- %g, by chance %g +- %g", k, transports[t],
                         r.illuminance[k], r.half_width[k], brute.illuminance[k],
                         brute.half_width[k]);
        }
        double share[LIGHT_CLASSES];
        for (int c = 0; c < LIGHT_CLASSES; c++)
            share[c] = r.classes[c].average / r.average;
        assert_true(share[CLASS_MIRRORED] > 0.01 && share[CLASS_FOCUSED] > 0.01);
        assert_near(r.classes[CLASS_DIRECT].average, brute.classes[CLASS_DIRECT].average, 0.01);
    }
    lab_close(&l);
}

/* ---- panes to and fro ------------------------------------------------------------------------ */

/* All of the south and the north wall is glass. Sunlight sinks by 1 m on its way through the room:
 * a third of it falls on the floor, R of the rest comes back from the north pane, of which as much
 * falls on the floor, and R of what is then left comes back from the south pane: on each place of
 * the floor, beside the sun itself, (R + R^2) of it. */
TEST(two_panes_send_the_sun_to_and_fro)
{
    lab l;
    lab_open(&l);
    const double high = atan(1.0 / 6.0);
    const scene *s    = lab_scene(
           &l,
           text_of(&l.a,
                   "lux4: 1\nroom: {size: [4, 6, 3], reflectance: 0.5, windows: [\n"
                      "  {wall: south, at: [0.001, 0.001], size: [3.998, 2.998], transmittance: 0.8},\n"
                      "  {wall: north, at: [0.001, 0.001], size: [3.998, 2.998], transmittance: "
                      "0.8}]}\nsky: {model: clear, horizontal: 1000, sun_illuminance: 80000, "
                      "sun_at: {azimuth: 180, elevation: %.12g}}\ngrids: [{name: g, on: room, "
                      "height: 0.01, spacing: 1}]\n",
                   high * 180 / M_PI));
    grid_result r;
    slab pane = slab_of(1.52, slab_inner(1.52, 0.8), cos(high));
    double R = pane.reflected, sun = 80000.0 * sin(high) * pane.passed;
    for (int t = 0; t < TRANSPORTS; t++) {
        grid_of_scene(&l.a, s, 0,
                      &(run_options){ .accuracy = 0.05, .seed = 1, .transport = transports[t] },
                      &r);
        assert_adds_up(&r);
        double off = fabs(r.classes[CLASS_MIRRORED].average - (R + R * R) * sun);
        assert_true(off <= stretch * r.classes[CLASS_MIRRORED].half_width + 0.003 * R * sun);
        assert_true(r.classes[CLASS_FOCUSED].average == 0.0);
    }
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(images_focused_light_and_paths_are_together_what_rays_find_by_chance),
        cmocka_unit_test(two_panes_send_the_sun_to_and_fro),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
