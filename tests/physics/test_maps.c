/* tests/physics/test_maps.c -- illumination maps: energy, cavities, walls, threads and files. */
#include "core/color.h"
#include "sim/illumination_map.h"
#include "tests/lab.h"
#include "tests/test.h"

#include <stdio.h>
#include <string.h>

static const map_options usual = {
    .seed = 1, .threads = 2, .particles = 1 << 19, .accuracy = 0.02, .deadline = HUGE_VAL
};

static const illumination_map *map_of(lab *l, const scene *s, const map_options *o)
{
    lux_error err             = { 0 };
    const illumination_map *m = illumination_map_new(&l->a, s, o, &err);
    if (!m)
        fail_msg("%s", err.text);
    return m;
}

/* What lies at the end of a ray, or nowhere: mean over all sets, lux, of the first channel. */
static bool lux_at(const scene *s, const illumination_map *m, dvec3 from, dvec3 way, double *fine)
{
    vec3 o = scene_place(s, from), d = d3_to_float(way);
    vray ray     = { vspread(o), vspread(d), vsplat(INFINITY) };
    vmask active = ALL_LANES;
    vhit hit;
    world_first_hit(s->world, &ray, &active, 1, RAYS_COHERENT, &hit);
    if (lane(hit.instance, 0) < 0)
        return false;
    vsurface at;
    world_surface(s->world, &hit, active, &at);
    vmask front = vdot(at.normal, ray.direction) < 0.0f;
    double sum  = 0.0;
    for (int set = 0; set < SCRAMBLES; set++) {
        vrgb e, c;
        vmask known =
            illumination_map_look(m, &hit, front, vsplat_int(set), -1, active, &e, &c);
        if (!(vbits(known) & 1))
            return false;
        sum += (double)lane(e.x, 0);
    }
    *fine = LUMENS_PER_WATT * sum / SCRAMBLES;
    return true;
}

static void assert_balanced(const illumination_map *m)
{
    map_figures f = illumination_map_figures(m);
    assert_near((double)f.absorbed.x + (double)f.escaped.x + (double)f.dropped.x,
                (double)f.emitted.x, 1e-5);
    assert_near((double)f.absorbed.z + (double)f.escaped.z + (double)f.dropped.z,
                (double)f.emitted.z, 1e-5);
}

/* The mean over the inside of a box [0, size]^3, by places spread evenly. */
static double mean_of_cube(const scene *s, const illumination_map *m, double size, int n)
{
    double sum = 0.0;
    int count  = 0;
    for (int face = 0; face < 6; face++)
        for (int i = 0; i < n * n; i++) {
            double u = (i % n + 0.5) / n * size, v = (i / n + 0.5) / n * size, e = 0.0;
            double at[3] = { u, u, u }, way[3] = { 0, 0, 0 };
            at[(face / 2 + 1) % 3] = u, at[(face / 2 + 2) % 3] = v;
            at[face / 2]  = 0.5 * size;
            way[face / 2] = face % 2 ? 1.0 : -1.0;
            bool known    = lux_at(s, m, (dvec3){ at[0], at[1], at[2] },
                                   (dvec3){ way[0], way[1], way[2] }, &e);
            sum += e;
            count += known;
        }
    assert_true(count > 6 * n * n * 9 / 10);
    return sum / count;
}

static void cube(double rho, double tolerance)
{
    lab l;
    lab_open(&l);
    char text[256];
    snprintf(text, sizeof text,
             "lux4: 1\nroom: {size: [4, 4, 4], reflectance: %g}\n"
             "lights: [{type: point, at: [2, 2, 2], lumens: 10000}]\n",
             rho);
    const scene *s            = lab_scene(&l, text);
    const illumination_map *m = map_of(&l, s, &usual);
    map_figures f = illumination_map_figures(m);
    printf("rho %g: %lld particles %lld rays %lld cells %lld bytes %.3f s\n", rho,
           (long long)f.particles, (long long)f.rays, (long long)f.cells, (long long)f.bytes, f.seconds);
    assert_balanced(m);
    double r = (double)(float)rho;
    double got = mean_of_cube(s, m, 4, 40), want= r * 10000.0 / (96.0 * (1.0 - r));
    printf("mean %g want %g (%.3f%%)\n", got, want, 100*(got/want-1));
    assert_near(got, want, tolerance);
    lab_close(&l);
}

TEST(a_cube_of_20_percent_has_the_light_of_its_balance) { cube(0.2, 0.005); }
TEST(a_cube_of_80_percent_has_the_light_of_its_balance) { cube(0.8, 0.005); }
TEST(a_cube_of_99_percent_has_the_light_of_its_balance) { cube(0.99, 0.01); }

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_of_20_percent_has_the_light_of_its_balance),
        cmocka_unit_test(a_cube_of_80_percent_has_the_light_of_its_balance),
        cmocka_unit_test(a_cube_of_99_percent_has_the_light_of_its_balance),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
