/* tests/unit/test_emission_places.c -- light as it sets out crosses squares close to a lamp, and
 * far from suns, as sensors there find that ask for it.
 */
#include "sky/sun_light.h"
#include "tests/sources.h"
#include "tests/test.h"
#include "tests/webs.h"

/* ---- where from ------------------------------------------------------------------------------ */

enum { SETS = 16, EACH = 1 << 13, SIDE = 24 };

/* A square sensor near the lamp: what crosses it, by particles and as asked for there. */
typedef struct square {
    vec3 centre, u, v, n; /* m: to the middles of its sides; unit */
} square;

static const square squares[] = {
    { { 0.25f, 0.1f, -0.1f }, { 0.25f, 0, 0 }, { 0, 0.25f, 0 }, { 0, 0, 1 } },
    { { -0.5f, 0.2f, 0.1f }, { 0, 0.2f, 0 }, { 0, 0, 0.2f }, { 1, 0, 0 } },
    { { 0.3f, 0.2f, 1.0f }, { 0.3f, 0, 0 }, { 0, 0.3f, 0 }, { 0, 0, -1 } },
};
enum { SQUARES = sizeof squares / sizeof *squares };

static vfloat crossing(const square *q, const vlight_ray *r)
{
    vfloat down = -vdot(r->direction, vspread(q->n));
    vvec3 to    = vsub(r->origin, vspread(q->centre));
    vfloat dist = vdot(to, vspread(q->n)) / down;
    vvec3 place = valong(to, r->direction, dist);
    vmask met   = (down > 0.0f) & (dist > 0.0f) &
                (vabs(vdot(place, vspread(q->u))) <= v3_dot(q->u, q->u)) &
                (vabs(vdot(place, vspread(q->v))) <= v3_dot(q->v, q->v));
    return vkeep(met, r->flux.y);
}

/* W, of 2^13 particles of each of 16 sets. */
static double by_particles(const light *l, const square *q, double *error)
{
    double sum = 0.0, squared = 0.0;
    for (int set = 0; set < SETS; set++) {
        double of = 0.0;
        for (int i = 0; i < EACH; i += LANES) {
            vmask lit;
            vlight_ray r = source_draw(l, i, 100 + (uint32_t)set, &lit);
            vfloat y     = crossing(q, &r);
            for (int k = 0; k < LANES; k++)
                of += (double)lane(y, k) / EACH;
        }
        sum += of / SETS;
        squared += of * of / SETS;
    }
    *error = sqrt(fmax(squared - sum * sum, 0.0) / (SETS - 1));
    return sum;
}

/* The same by the midpoint rule, of what is asked for at points. */
static double by_asking(const light *l, const square *q)
{
    double sum  = 0.0;
    double area = 4.0 * (double)(v3_length(q->u) * v3_length(q->v));
    for (int i = 0; i < SIDE * SIDE; i++) {
        float x = 2.0f * ((float)(i % SIDE) + 0.5f) / SIDE - 1.0f;
        float y = 2.0f * ((float)(i / SIDE) + 0.5f) / SIDE - 1.0f;
        vec3 p  = { q->centre.x + x * q->u.x + y * q->v.x, q->centre.y + x * q->u.y + y * q->v.y,
                    q->centre.z + x * q->u.z + y * q->v.z };
        sum +=
            mean_irradiance(l, p, q->n, light_has_extent(l) ? 8 : 3, NULL) * area / (SIDE * SIDE);
    }
    return sum;
}

static void places_agree(const char *name, const light *l)
{
    const double nothing = 1e-5; /* W, of 10: no particle */
    const double rule = 0.002; /* of the midpoint rule: a part is an eighth of the distance wide */
    print_message("           %-18s", name);
    for (int i = 0; i < SQUARES; i++) {
        double error, got = by_particles(l, &squares[i], &error);
        double want = by_asking(l, &squares[i]);
        print_message(" %9.3g W %+.4f +- %.4f", want, want > 0.0 ? got / want - 1.0 : got,
                      want > 0.0 ? error / want : error);
        if (fabs(got - want) > 4.0 * error + rule * want + nothing)
            fail_msg("%s: %g W cross square %d, not %g: off by %g errors", name, got, i, want,
                     fabs(got - want) / error);
    }
    print_message("\n");
}

TEST(what_crosses_squares_near_a_lamp_is_what_is_asked_for_there)
{
    for_each_source(false, places_agree);
}

/* ---- far away -------------------------------------------------------------------------------- */

static double mean_flux(const light *l)
{
    double sum = 0.0;
    for (int i = 0; i < EACH; i += LANES) {
        vmask lit;
        vlight_ray r = source_draw(l, i, 5, &lit);
        for (int k = 0; k < LANES; k++)
            sum += (double)lane(r.flux.y, k) / EACH;
    }
    return sum;
}

/* W, through the target's sphere; and squares in it. */
static void far_agrees(const char *name, const light *l, double through)
{
    const square in = { { 0.3f, 0.2f, 0.1f }, { 0.5f, 0, 0 }, { 0, 0.6f, 0 }, { 0, 0, 1 } };
    const square up = { { 0.3f, -0.4f, 0.3f }, { 0, 0.4f, 0 }, { 0, 0, 0.5f }, { -1, 0, 0 } };
    assert_near(mean_flux(l), through, 1e-5);
    for (int i = 0; i < 2; i++) {
        const square *q = i ? &up : &in;
        double error, got = by_particles(l, q, &error), want = by_asking(l, q);
        print_message("           %-18s %9.3g W %+.4f +- %.4f\n", name, want, got / want - 1.0,
                      error / want);
        assert_true(want > 0.0 && fabs(got - want) < 4.0 * error + 1e-3 * want);
    }
}

TEST(light_from_far_away_crosses_the_sphere_as_asked_for)
{
    arena a           = { 0 };
    const double area = M_PI * (double)(source_target.radius * source_target.radius);
    const vec3 to_sun = { -0.4f, 0.3f, 0.8f }, way = { 0.4f, -0.3f, -0.8f };
    far_agrees("parallel", light_parallel(&a, &(parallel_desc){ way, { 3, 2, 1 } }, NULL),
               2.0 * area);
    far_agrees("sun", light_sun(&a, &(sun_light_desc){ to_sun, { 3, 2, 1 }, 0.53 }, NULL),
               2.0 * area);

    /* Of a wide one, irradiance is what is left of all its rays square to the centre: the mean of
     * their cosines is (1 + cos R) / 2 */
    far_agrees("wide sun", light_sun(&a, &(sun_light_desc){ to_sun, { 3, 2, 1 }, 30.0 }, NULL),
               2.0 * area / (0.5 + 0.5 * cos(15.0 * M_PI / 180.0)));
    arena_clear(&a);
}

/* A square that the beam fills, one that it crosses in part, one behind its beginning. */
TEST(a_beam_lights_what_lies_before_it)
{
    arena a        = { 0 };
    const light *l = light_parallel(
        &a, &(parallel_desc){ { 0, 0, -2 }, { 3, 2, 1 }, { 0, 0, 0.4f }, 0.3f }, NULL);
    const square all   = { { 0, 0, -1 }, { 0.4f, 0, 0 }, { 0, 0.4f, 0 }, { 0, 0, 1 } };
    const square half  = { { 0.4f, 0, -1 }, { 0.4f, 0, 0 }, { 0, 0.4f, 0 }, { 0, 0, 1 } };
    const square above = { { 0, 0, 1 }, { 0.4f, 0, 0 }, { 0, 0.4f, 0 }, { 0, 0, 1 } };
    double error, full = 2.0 * M_PI * 0.09;
    assert_near(by_particles(l, &all, &error), full, 1e-4);
    assert_near(by_particles(l, &half, &error), 0.5 * full, 1e-3);
    assert_true(by_particles(l, &above, &error) == 0.0);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_crosses_squares_near_a_lamp_is_what_is_asked_for_there),
        cmocka_unit_test(light_from_far_away_crosses_the_sphere_as_asked_for),
        cmocka_unit_test(a_beam_lights_what_lies_before_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
