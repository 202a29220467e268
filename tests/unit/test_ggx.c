/* tests/unit/test_ggx.c -- facets against closed forms and quadrature, and their tables.
 *
 * Called with the word `table` it prints materials/ggx_table.c.
 */
#include "core/sampler.h"
#include "materials/ggx.h"
#include "tests/ggx_twin.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double pi = 3.14159265358979324;

/* ---- the tables -------------------------------------------------------------------------------
 */

static void print_numbers(const char *name, const char *size, const float *number, int count)
{
    printf("\nconst float %s[%s] = {", name, size);
    for (int i = 0; i < count; i++) {
        char text[32];
        snprintf(text, sizeof text, "%.5g", (double)number[i]);
        printf("%s%s%sf,", i % 8 ? " " : "\n    ", text, strpbrk(text, ".e") ? "" : ".0");
    }
    printf("\n};\n");
}

static float rounded(double a)
{
    char text[32];
    snprintf(text, sizeof text, "%.5g", a);
    return strtof(text, NULL);
}

/* The means are those of the tables that are linked: a first run fills these, a second one them. */
static int print_table(void)
{
    static float loss[GGX_PLACES], schlick[GGX_PLACES], mean[2][GGX_MEANS];
    for (int i = 0; i < GGX_PLACES; i++) {
        double alpha     = pow(ggx_twin_root(i / GGX_COLUMNS), 4.0);
        double m         = ggx_twin_cosine(alpha, i % GGX_COLUMNS);
        ggx_twin_share s = ggx_twin_integral(alpha, m, 800, 200);
        loss[i]          = rounded(s.loss);
        schlick[i]       = rounded(s.schlick);
    }
    for (int i = 0; i < GGX_MEANS; i++) {
        double alpha     = pow(ggx_twin_root((double)i / GGX_MEAN_STEPS), 4.0);
        ggx_twin_share s = ggx_twin_mean(alpha);
        mean[0][i]       = rounded(s.loss);
        mean[1][i]       = rounded(s.schlick);
    }
    printf("/* materials/ggx_table.c -- what meets several facets: see ggx.h. Printed by "
           "tests/unit/test_ggx.c,\n * whose tests work it out again. */\n"
           "#include \"materials/ggx.h\"\n\n/* clang-format off */\n");
    print_numbers("ggx_loss", "GGX_PLACES", loss, GGX_PLACES);
    print_numbers("ggx_schlick", "GGX_PLACES", schlick, GGX_PLACES);
    print_numbers("ggx_mean_loss", "GGX_MEANS", mean[0], GGX_MEANS);
    print_numbers("ggx_mean_schlick", "GGX_MEANS", mean[1], GGX_MEANS);
    return 0;
}

/* Half as fine as when they were made, which is good for 4e-5; every 17th place. */
TEST(tables_are_the_integrals_that_they_stand_for)
{
    for (int i = 5; i < GGX_PLACES; i += 17) {
        double alpha     = pow(ggx_twin_root(i / GGX_COLUMNS), 4.0);
        double m         = ggx_twin_cosine(alpha, i % GGX_COLUMNS);
        ggx_twin_share s = ggx_twin_integral(alpha, m, 400, 100);
        assert_true(fabs((double)ggx_loss[i] - s.loss) <= 4e-5);
        assert_true(fabs((double)ggx_schlick[i] - s.schlick) <= 4e-5);
    }
    for (int i = 0; i < GGX_MEANS; i += 3) {
        ggx_twin_share s = ggx_twin_mean(pow(ggx_twin_root((double)i / GGX_MEAN_STEPS), 4.0));
        assert_near(ggx_mean_loss[i], s.loss, 1e-4); /* five digits */
        assert_near(ggx_mean_schlick[i], s.schlick, 1e-4);
    }
}

static vggx surface(double alpha) { return vggx_of(vsplat((float)sqrt(alpha)), ALL_LANES); }

static ggx_twin_share share_of(const vggx *g, double m)
{
    vggx_share s = vggx_shares(g, vsplat((float)m), ALL_LANES);
    return (ggx_twin_share){ (double)lane(s.loss, 0), (double)lane(s.schlick, 0) };
}

/* With alpha = 1, D = 1/pi and V = 1 / (2 (m_o + m_i)): loss = m log(1 + 1/m), whose mean is
 * (4 log 2 - 1) / 3. The tables are good for 5e-4. */
TEST(the_loss_of_the_roughest_surface_is_its_closed_form)
{
    vggx g = surface(1.0);
    for (double m = 1.0; m > 1e-5; m *= 0.83)
        assert_true(fabs(share_of(&g, m).loss - m * log1p(1.0 / m)) < 5e-4);
    assert_near(lane(g.mean.loss, 0), (4.0 * log(2.0) - 1.0) / 3.0, 5e-4);
}

/* Facets of a smooth one all but face n: (1 - m)^5, whose mean is 1/21, and no loss.
 * The tables are good for 5e-4. */
TEST(the_smoothest_surface_is_nearly_a_mirror)
{
    vggx g = surface(0.0);
    for (double m = 0.1; m <= 1.0; m += 0.05) {
        assert_true(fabs(share_of(&g, m).schlick - pow(1.0 - m, 5.0)) < 1e-3);
        assert_true(fabs(share_of(&g, m).loss) < 1e-4);
    }
    assert_near(lane(g.mean.schlick, 0), 1.0 / 21.0, 2e-3); /* 1e-4 of all light */
    assert_true(lane(g.mean.loss, 0) < 2e-5f);
}

TEST(between_places_the_tables_are_good_for_6e_4)
{
    double worst = 0.0;
    for (uint32_t n = 0; n < 600; n++) {
        double root      = ggx_twin_root((GGX_ROWS - 1) * (hash_u32(2 * n) * 0x1p-32));
        double alpha     = pow(root, 4.0);
        double m         = ggx_twin_cosine(alpha, 31.0 * (hash_u32(2 * n + 1) * 0x1p-32));
        vggx g           = surface(alpha);
        ggx_twin_share s = ggx_twin_integral(alpha, m, 160, 48), got = share_of(&g, m);
        worst            = fmax(worst, fabs(got.loss - s.loss));
        worst            = fmax(worst, fabs(got.schlick - s.schlick));
        ggx_twin_share t = ggx_twin_lookup(alpha, m);
        assert_true(fabs(t.loss - got.loss) < 2e-6);
        assert_true(fabs(t.schlick - got.schlick) < 2e-6);
    }
    assert_true(worst < 6e-4);
}

/* The mean that is tabulated is that of what is looked up, at any roughness. */
TEST(means_fit_what_they_are_the_mean_of)
{
    for (double x = 0.03; x < GGX_ROWS - 1; x += 0.37) {
        double alpha        = pow(ggx_twin_root(x), 4.0);
        vggx g              = surface(alpha);
        ggx_twin_share mean = ggx_twin_mean(alpha);
        assert_near(lane(g.mean.loss, 0), mean.loss, 2e-3); /* between places, for the smoothest */
        assert_near(lane(g.mean.schlick, 0), mean.schlick, 2e-4);
    }
}

/* ---- facets -----------------------------------------------------------------------------------
 */

static const double alphas[] = { 0.001, 0.01, 0.1, 0.4, 1.0 };
enum { ALPHAS = sizeof alphas / sizeof *alphas };

/* Facets' angle t from n: tan t = alpha (e^x - 1), so that there are as many steps below alpha as
 * in each of the decades above. The weight is that of solid angles, over 2 pi. */
typedef struct angle_step {
    double sin, cos, weight;
} angle_step;

enum { ANGLES = 4000 };

static angle_step angle_at(double alpha, int k)
{
    double most = log(1.0 + 1e7 / alpha), x = most * (k + 0.5) / ANGLES;
    double tan = alpha * (exp(x) - 1.0), c = 1.0 / sqrt(1.0 + tan * tan), s = tan * c;
    return (angle_step){ s, c, s * c * c * alpha * exp(x) * most / ANGLES }; /* sin t dt */
}

static double density(const vggx *g, angle_step t)
{
    vfloat d = vggx_density(g, vsplat((float)(t.sin * t.sin)), vsplat((float)(t.cos * t.cos)));
    return (double)lane(d, 0);
}

/* Their areas, seen from above, cover the surface. */
TEST(facets_project_to_the_whole_surface)
{
    for (int a = 0; a < ALPHAS; a++) {
        vggx g     = surface(alphas[a]);
        double sum = 0.0;
        for (int k = 0; k < ANGLES; k++) {
            angle_step t = angle_at(alphas[a], k);
            sum += 2.0 * pi * t.weight * t.cos * density(&g, t);
        }
        assert_near(sum, 1.0, 1e-4);
    }
}

/* And so from every other direction: what is seen of facets adds up to the surface's projected
 * area (Smith's masking function is what makes it so). */
TEST(seen_facets_project_to_the_surface_from_everywhere)
{
    enum { TURNS = 512 };
    static const double cosines[] = { 0.001, 0.05, 0.3, 0.8, 1.0 };
    for (int a = 0; a < ALPHAS; a++)
        for (int c = 0; c < 5; c++) {
            vggx g   = surface(alphas[a]);
            double m = cosines[c], across = sqrt(1.0 - m * m), sum = 0.0;
            for (int k = 0; k < ANGLES; k += 4) {
                angle_step t = angle_at(alphas[a], k);
                double turn  = 0.0;
                for (int j = 0; j < TURNS; j++)
                    turn += fmax(m * t.cos + across * t.sin * cos(2.0 * pi * j / TURNS), 0.0);
                vfloat pdf = vggx_facet_pdf(&g, vsplat((float)density(&g, t)), vsplat((float)m));
                sum += 4.0 * t.weight * 4.0 * (double)lane(pdf, 0) * turn * 2.0 * pi / TURNS;
            }
            assert_near(sum, 1.0, 1e-3);
        }
}

static vfloat even(uint32_t n, uint32_t seed)
{
    vuint bits = vhash_combine(vsplat_uint(seed), vunsigned(vlane_index()) + n);
    return vto_float(vsigned(bits >> 8)) * 0x1p-24f;
}

/* In bins even in the logarithm of the cosine; by Simpson's rule over each. */
TEST(cosines_of_lost_light_follow_their_pdf)
{
    enum { BINS = 64, SAMPLES = 1 << 17 };
    for (int a = 0; a < ALPHAS; a++) {
        vggx g              = surface(alphas[a]);
        double least        = log(alphas[a] * 0.02);
        int count[BINS + 1] = { 0 };
        double expected[BINS + 1], rest = SAMPLES;
        for (uint32_t n = 0; n < SAMPLES; n += LANES) {
            vfloat m = vggx_draw_lossy(&g, even(n, 3));
            for (int k = 0; k < LANES; k++) {
                double x = log((double)lane(m, k)) / least; /* 0 at m = 1 */
                count[x < 1.0 ? (int)(x * BINS) : BINS]++;
            }
        }
        for (int b = 0; b < BINS; b++) {
            double sum = 0.0;
            for (int k = 0; k <= 8; k++) {
                double m = exp(least * (b + k / 8.0) / BINS);
                sum += (k == 0 || k == 8 ? 1
                        : k % 2          ? 4
                                         : 2) /
                       24.0 * 2.0 * pi * m * (double)lane(vggx_lossy_pdf(&g, vsplat((float)m)), 0);
            }
            expected[b] = SAMPLES * sum * -least / BINS;
            rest -= expected[b];
        }
        expected[BINS] = rest;
        assert_true(rest >= 0.0 && chi_square_test(expected, count, BINS + 1) > 1e-4);
    }
}

/* Grazing to the bit, straight above, at the edges of the square. */
TEST(drawn_facets_are_unit_and_face_who_sees_them)
{
    static const float z[] = { 0.0f, 1e-30f, 1e-7f, 1e-3f, 0.5f, 1.0f };
    static const float u[] = { 0.0f, 0x1p-24f, 0.25f, 0.5f, 0.9f, 0x1.fffffep-1f };
    for (int n = 0; n < 6 * 6 * 6 * ALPHAS; n++) {
        vggx g   = surface(alphas[n % ALPHAS]);
        float up = z[n / ALPHAS % 6], across = sqrtf(1.0f - up * up);
        vvec3 wo = vspread((vec3){ 0.6f * across, -0.8f * across, up });
        vvec3 h =
            vggx_draw_facet(&g, wo, vsplat(u[n / ALPHAS / 6 % 6]), vsplat(u[n / ALPHAS / 36]));
        assert_true(vall(vabs(vdot(h, h) - 1.0f) < 1e-6f));
        assert_true(vall((h.z > 0.0f) & (vdot(h, wo) > -1e-6f)));
    }
}

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "table") == 0)
        return print_table();
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_are_the_integrals_that_they_stand_for),
        cmocka_unit_test(the_loss_of_the_roughest_surface_is_its_closed_form),
        cmocka_unit_test(the_smoothest_surface_is_nearly_a_mirror),
        cmocka_unit_test(between_places_the_tables_are_good_for_6e_4),
        cmocka_unit_test(means_fit_what_they_are_the_mean_of),
        cmocka_unit_test(facets_project_to_the_whole_surface),
        cmocka_unit_test(seen_facets_project_to_the_surface_from_everywhere),
        cmocka_unit_test(cosines_of_lost_light_follow_their_pdf),
        cmocka_unit_test(drawn_facets_are_unit_and_face_who_sees_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
