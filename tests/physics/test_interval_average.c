/* tests/physics/test_interval_average.c -- the interval of a grid's average holds the truth as
 * often as claimed, whatever its sensors share, and is not much wider than that takes.
 *
 * Of 32 intervals 5 may miss the truth, of 12 that take longer 3, of 6 1: where 95 % hold it, more
 * miss once in 220, 450 and 30 times; where half of them do, as few once in 17,000, 14 and 9. The
 * truths are closed forms.
 */
#include "core/color.h"
#include "tests/box.h"
#include "tests/folder.h"
#include "tests/gltf_text.h"
#include "tests/lab.h"
#include "tests/slab.h"
#include "tests/test.h"

static double mean_half_width(const grid_result *r)
{
    double sum = 0.0;
    for (int k = 0; k < r->sensor_count; k++)
        sum += r->half_width[k];
    return sum / r->sensor_count;
}

typedef struct trials {
    int seeds, most_missed;
    transport by;
    double accuracy, truth; /* truth: lx */
    double most;            /* of the mean half width of sensors, that of the average, on average */
} trials;

static void assert_covered(const scene *s, const study_grid *g, const trials *t)
{
    int missed   = 0;
    double share = 0.0;
    for (uint32_t seed = 1; seed <= (uint32_t)t->seeds; seed++) {
        arena run     = { 0 };
        run_options o = { .accuracy  = t->accuracy,
                          .deadline  = HUGE_VAL,
                          .seed      = seed,
                          .threads   = 1,
                          .transport = t->by };
        grid_result r;
        assert_true(grid_run(&run, s, g, &o, &r, NULL));
        double off = fabs(r.average - t->truth) - 1e-5 * t->truth; /* sums are of floats */
        missed += off > r.average_half_width;
        share += r.average_half_width / mean_half_width(&r) / t->seeds;
        assert_true(r.average_half_width <= mean_half_width(&r) * (1.0 + 1e-9));
        arena_clear(&run);
    }
    if (missed > t->most_missed || share > t->most)
        fail_msg("of %d intervals %d miss; they are %g of a sensor's", t->seeds, missed, share);
}

/* L = L_e / (1 - rho) everywhere, as in test_interval.c. */
TEST(intervals_of_averages_in_a_glowing_box_hold_the_truth)
{
    arena a           = { 0 };
    const vec3 rho[3] = { { 0.6f, 0.6f, 0.6f }, { 0.6f, 0.6f, 0.6f }, { 0.6f, 0.6f, 0.6f } };
    const vec3 le[3]  = { { 1, 1, 1 }, { 1, 1, 1 }, { 1, 1, 1 } };
    const scene *s    = box_scene(&a, (dvec3){ 4, 3, 2.5 }, rho, le, true);
    study_grid g      = {
             .name = "g", .origin = { 0, 0, 0.8 }, .u = { 4, 0, 0 }, .v = { 0, 3, 0 }, .spacing = 0.5
    };
    double truth = M_PI * LUMENS_PER_WATT / (1.0 - (double)0.6f);
    assert_covered(s, &g, &(trials){ 32, 5, TRANSPORT_PATH, 0.2, truth, 0.3 });
    arena_clear(&a);
}

/* The wall of a cube with a lamp in the middle: direct light is summed, and of what is reflected
 * there is rho / (1 - rho) of what all walls get, on average (CIE 171:2006, 5.8). */
TEST(intervals_of_averages_by_maps_hold_the_truth)
{
    arena a        = { 0 };
    const scene *s = scene_of_text(
        &a, "lux4: 1\nroom: {size: [4, 4, 4], reflectance: 0.5}\n"
            "lights: [{type: point, at: [2, 2, 2], lumens: 9600}]\n"
            "grids: [{name: face, origin: [4, 0, 0], u: [0, 0, 4], v: [0, 4, 0], spacing: 0.5}]\n");
    grid_result direct;
    grid_of_scene(&a, s, 0, &(run_options){ .direct_only = true }, &direct);
    double truth = direct.average + 100.0;
    assert_covered(s, s->study->grids, &(trials){ 12, 3, TRANSPORT_MAPS, 0.3, truth, 0.6 });
    arena_clear(&a);
}

/* Light that falls askew on a block of glass goes on as it came, less what both faces reflect. All
 * sensors have it from one map. */
TEST(intervals_of_averages_of_focused_light_hold_the_truth)
{
    static const char glass[] =
        "\"name\":\"Lens\",\"pbrMetallicRoughness\":{\"metallicFactor\":0,\"roughnessFactor\":0},"
        "\"extensions\":{\"KHR_materials_transmission\":{\"transmissionFactor\":1},"
        "\"KHR_materials_volume\":{\"thicknessFactor\":1}}";
    lab l;
    lab_open(&l);
    quad block[6];
    quads_of_box((dvec3){ -4, -4, 1 }, (dvec3){ 4, 4, 2 }, block);
    lab_quads(&l, "block.gltf", block, 6, glass);
    const scene *s = lab_scene(
        &l, "lux4: 1\nscene: block.gltf\n"
            "lights: [{type: parallel, aim: [1, 0, -1], illuminance: 1000, at: [-2, 0, 3], "
            "radius: 1}]\n"
            "grids: [{name: g, origin: [0.1, -0.3, 0.6], u: [0.6, 0, 0], v: [0, 0.6, 0], spacing: "
            "0.3}]\n");
    slab pane    = slab_of(1.5, 1.0, M_SQRT1_2);
    double truth = 1000.0 * M_SQRT1_2 * pane.passed;
    assert_covered(s, s->study->grids, &(trials){ 6, 1, TRANSPORT_PATH, 0.5, truth, 1.0 });
    lab_close(&l);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(intervals_of_averages_in_a_glowing_box_hold_the_truth),
        cmocka_unit_test(intervals_of_averages_by_maps_hold_the_truth),
        cmocka_unit_test(intervals_of_averages_of_focused_light_hold_the_truth),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
