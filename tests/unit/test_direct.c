/* tests/unit/test_direct.c -- one light drawn of many, against all of them asked. */
#include "core/color.h"
#include "sim/direct.h"
#include "tests/folder.h"
#include "tests/test.h"

#include <stdio.h>

enum { PACKETS = 256 / LANES, SAMPLES = 256, SETS = 64 };

/* Points above and below the place in the middle, in an open room: of all kinds of sides. */
static const scene *lamps_around(arena *a, const char *more)
{
    char text[2048];
    snprintf(text, sizeof text,
             "lux4: 1\nroom: {size: [6, 6, 4], reflectance: 0.5}\n"
             "grids: [{name: g, on: room, height: 1, spacing: 1}]\nlights:\n"
             "  - {type: point, at: [[1, 1, 3], [2, 5, 0.5], [5, 2, 1]], lumens: 1000}\n"
             "  - {type: disk, at: [3, 3, 0.2], aim: [0, 0, 1], radius: 0.3, lumens: 800}\n%s",
             more);
    return scene_of_text(a, text);
}

static double weigh(const direct_pick *pick, const vsurface *at, bool all_around, double *square)
{
    double sum      = 0.0;
    vfloat cosine   = vmax(vdot(pick->wi, at->normal), vsplat(0.0f));
    vfloat response = all_around ? vsplat(1.0f) : cosine;
    vfloat e        = vrgb_luminance(pick->e) * response;
    for (int i = 0; i < LANES; i++) {
        sum += (double)lane(e, i);
        *square += (double)lane(e, i) * (double)lane(e, i);
    }
    return sum;
}

/* 5 standard deviations of the mean, of independent sets of numbers. */
static void one_stands_for_all(const char *more, bool all_around)
{
    arena a           = { 0 };
    const scene *s    = lamps_around(&a, more);
    direct_scratch *w = direct_scratch_new(&a, NULL);
    vec3 p            = scene_place(s, (dvec3){ 3, 2.5, 2 });
    double all = 0.0, one = 0.0, square = 0.0, unused = 0.0, sets = 0.0;
    vsurface at[PACKETS];
    vmask active[PACKETS];
    vsample4 u[PACKETS];
    static direct_pick picks[PACKETS];
    direct_batch b = {
        .at = at, .active = active, .u = u, .packets = PACKETS, .all_around = all_around
    };
    for (uint32_t set = 0; set < SETS; set++) {
        for (int k = 0; k < PACKETS; k++) {
            at[k]     = (vsurface){ .position = vspread(p),
                                    .normal   = vspread((vec3){ 0.6f, 0, 0.8f }),
                                    .error    = vsplat(1e-6f) };
            active[k] = ALL_LANES;
            u[k]      = vsobol4(vunsigned(vlane_index() + k * LANES), vsplat_uint(set));
        }
        double mean = 0.0;
        direct_one(s, w, &b, picks);
        for (int k = 0; k < PACKETS; k++)
            mean += weigh(&picks[k], &at[k], all_around, &unused) / SAMPLES;
        one += mean / SETS;
        square += mean * mean / SETS;
        for (int l = 0; l < s->light_count && set < 8; l++) {
            direct_lamp(s, w, l, &b, picks);
            for (int k = 0; k < PACKETS; k++)
                all += weigh(&picks[k], &at[k], all_around, &unused) / (8.0 * SAMPLES);
        }
        sets += 1.0;
    }
    double spread = sqrt(fmax(square - one * one, 0.0) / sets);
    if (!(fabs(one - all) <= 5.0 * spread + 1e-4 * all))
        fail_msg("one of all gives %g +- %g, all give %g", one, spread, all);
    arena_clear(&a);
}

#define MANY                                                                                       \
    "  - {type: cosine, lumens: 300, at: [[1, 1, 3], [1, 2, 3], [1, 3, 3], [1, 4, 3], [2, 1, 3], " \
    "[2, 2, 3], [2, 3, 3], [2, 4, 3], [5, 5, 3]]}\n"                                               \
    "  - {type: cosine, lumens: 300, aim: [0, 0, 1], at: [[1, 5, 1], [4, 4, 1]]}\n"

TEST(one_of_few_lamps_stands_for_all) { one_stands_for_all("", false); }
TEST(one_of_few_lamps_stands_for_those_below_the_horizon_too) { one_stands_for_all("", true); }
TEST(one_of_many_lamps_stands_for_all) { one_stands_for_all(MANY, false); }
TEST(one_of_many_lamps_stands_for_those_below_the_horizon_too) { one_stands_for_all(MANY, true); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_of_few_lamps_stands_for_all),
        cmocka_unit_test(one_of_few_lamps_stands_for_those_below_the_horizon_too),
        cmocka_unit_test(one_of_many_lamps_stands_for_all),
        cmocka_unit_test(one_of_many_lamps_stands_for_those_below_the_horizon_too),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
