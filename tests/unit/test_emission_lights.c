/* tests/unit/test_emission_lights.c -- light as it sets out, of every type of light: as much, in
 * the directions and from the places that those find who ask for it.
 */
#include "core/color.h"
#include "core/sampler.h"
#include "core/warp.h"
#include "sky/sun_light.h"
#include "tests/test.h"
#include "tests/webs.h"

#include <string.h>

static const light_target around = { { 0.2f, -0.1f, 0.3f }, 2.0f };

/* ---- the lights ------------------------------------------------------------------------------ */

typedef const light *light_maker(arena *a);

static const vec3 at  = { 0.1f, 0.2f, 0.4f };
static const vec3 aim = { 0.3f, -0.2f, -0.9f };

static const light *a_point(arena *a)
{
    return light_point(a, &(point_desc){ at, { 3, 2, 1 } }, NULL);
}
static const light *a_cone(arena *a)
{
    return light_cone(a, &(cone_desc){ at, aim, { 3, 2, 1 }, 0.3f, 0.8f }, NULL);
}
static const light *a_wide_cone(arena *a)
{
    return light_cone(a, &(cone_desc){ at, aim, { 3, 2, 1 }, 0.0f, 3.1f }, NULL);
}
static const light *a_cosine(arena *a)
{
    return light_cosine(a, &(cosine_desc){ at, aim, { 3, 2, 1 }, 1.0f }, NULL);
}
static const light *a_spot(arena *a)
{
    return light_cosine(a, &(cosine_desc){ at, aim, { 3, 2, 1 }, 40.5f }, NULL);
}
static const light *a_line(arena *a)
{
    return light_linear(
        a, &(linear_desc){ { -0.4f, 0.1f, 0.3f }, { 0.5f, 0.3f, 0.4f }, { 3, 2, 1 } }, NULL);
}
static const light *a_disk(arena *a)
{
    return light_disk(a, &(disk_desc){ at, aim, 0.4f, { 3, 2, 1 } }, NULL);
}
static const light *a_rect(arena *a)
{
    return light_rect(a, &(rect_desc){ at, aim, { 0, 1, 0.2f }, 0.9f, 0.4f, { 3, 2, 1 } }, NULL);
}
static const light *a_triangle(arena *a)
{
    return light_triangle(
        a,
        &(triangle_desc){ { { -0.3f, 0, 0.3f }, { 0.6f, 0.1f, 0.4f }, { 0.2f, 0.7f, 0.5f } },
                          { 3, 2, 1 } },
        NULL);
}
static const light *a_beam(arena *a)
{
    return light_parallel(a, &(parallel_desc){ aim, { 3, 2, 1 }, at, 0.3f }, NULL);
}

typedef struct lamp {
    const char *name;
    light_maker *make;
    web_form *form; /* of a luminaire */
    int planes;
    double step_deg;
    opening_shape opening;
    vec3 size;
} lamp;

static const lamp lamps[] = {
    { "point", a_point },
    { "cone", a_cone },
    { "wide cone", a_wide_cone },
    { "cosine", a_cosine },
    { "spot", a_spot },
    { "line", a_line },
    { "disk", a_disk },
    { "rect", a_rect },
    { "triangle", a_triangle },
    { "web, even", NULL, web_isotropic, 1, 90.0 },
    { "web, cosine", NULL, web_lambertian, 1, 10.0 },
    { "web, spot", NULL, web_spot, 1, 5.0 },
    { "web, batwing", NULL, web_batwing, 4, 5.0 },
    { "web, wall washer", NULL, web_asymmetric, 24, 5.0 },
    { "web, rectangle", NULL, web_asymmetric, 24, 5.0, OPENING_RECTANGLE, { 0.9f, 0.3f, 0 } },
    { "web, disc", NULL, web_batwing, 4, 5.0, OPENING_DISC, { 0.5f, 0.8f, 0 } },
    { "web, box", NULL, web_isotropic, 1, 30.0, OPENING_BOX, { 0.9f, 0.3f, 0.1f } },
    { "web, cylinder", NULL, web_sine, 36, 5.0, OPENING_VERTICAL_CYLINDER, { 0.4f, 0.6f, 0.5f } },
    { "web, ellipsoid", NULL, web_batwing, 4, 5.0, OPENING_SPHERE, { 0.5f, 0.7f, 0.3f } },
    { "web, tube", NULL, web_sine, 36, 5.0, OPENING_CYLINDER_ALONG, { 0.9f, 0.2f, 0.1f } },
    { "web, upright disc", NULL, web_both_sides, 4, 5.0, OPENING_VERTICAL_DISC, { 0.6f, 0, 0.4f } },
    { "web, line", NULL, web_batwing, 4, 5.0, OPENING_LINE, { 0.9f, 0, 0 } },
    { "beam", a_beam },
};
enum { LAMPS = sizeof lamps / sizeof *lamps, SPREAD = LAMPS - 1 /* the beam has one direction */ };

static const light *make(arena *a, const lamp *from)
{
    if (from->make)
        return from->make(a);
    photometry *web = web_make(a, from->form, from->planes, from->step_deg);
    web->opening    = from->opening;
    web->length     = from->size.x;
    web->width      = from->size.y;
    web->height     = from->size.z;
    return light_luminaire(
        a,
        &(luminaire_desc){
            .position = at, .aim = aim, .rotate = 0.4f, .scale = { 3, 2, 1 }, .web = web },
        NULL);
}

static void for_each(int count, void (*test)(const char *name, const light *l))
{
    for (int i = 0; i < count; i++) {
        arena a        = { 0 };
        const light *l = make(&a, &lamps[i]);
        assert_non_null(l);
        test(lamps[i].name, l);
        arena_clear(&a);
    }
}

static vlight_ray draw(const light *l, int first, uint32_t seed, vmask *lit)
{
    vlight_ray ray;
    vsample4 u = vsobol4(vunsigned(vlane_index() + first), vsplat_uint(seed));
    *lit       = l->type->emit(l, &around, u.z, u.w, u.x, u.y, ALL_LANES, &ray);
    return ray;
}

/* ---- how much -------------------------------------------------------------------------------- */

enum { MANY = 1 << 14 };

static void flux_adds_up(const char *name, const light *l)
{
    double sum[3] = { 0 }, squares = 0.0;
    for (int i = 0; i < MANY; i += LANES) {
        vmask lit;
        vlight_ray ray = draw(l, i, 5, &lit);
        for (int k = 0; k < LANES; k++) {
            double y = (double)lane(ray.flux.y, k);
            assert_true(isfinite(y) && y >= 0.0);
            assert_true(((vbits(lit) >> k) & 1) || y == 0.0);
            if ((vbits(lit) >> k) & 1)
                assert_near(lane(vlength(ray.direction), k), 1.0, 2e-6);
            sum[0] += (double)lane(ray.flux.x, k) / MANY;
            sum[1] += y / MANY;
            sum[2] += (double)lane(ray.flux.z, k) / MANY;
            squares += y * y / MANY;
        }
    }
    vec3 want = light_flux(l);
    print_message("           %-18s %+.1e, weights vary by %.3f\n", name,
                  sum[1] / (double)want.y - 1.0,
                  sqrt(fmax(squares / (sum[1] * sum[1]) - 1.0, 0.0)));
    assert_near(sum[0], want.x, 0.002);
    assert_near(sum[1], want.y, 0.002);
    assert_near(sum[2], want.z, 0.002);
    assert_true(squares < 1.02 * sum[1] * sum[1]); /* weights are even to 15 % */
}

TEST(all_light_of_a_lamp_sets_out) { for_each(LAMPS, flux_adds_up); }

/* ---- where to -------------------------------------------------------------------------------- */

enum { ROWS = 24, COLUMNS = 24, CELLS = ROWS * COLUMNS, FINE = 24, DRAWN = 1 << 15 };

/* W/sr, as luminance, by what a point far away gets. */
static vfloat intensity(const light *l, vvec3 w)
{
    const float far = 100.0f;
    vvec3 p         = valong(vspread(at), w, vsplat(far));
    vlight_sample s;
    vfloat ignored;
    if (l->type->as_point)
        l->type->as_point(l, &p, ALL_LANES, &s, &ignored);
    else
        light_sample(l, &p, vsplat(0), vsplat(0), ALL_LANES, &s);
    return vrgb_luminance(s.e) * s.dist * s.dist;
}

/* W of each cell, equal steps of z and azimuth. */
static void expect(const light *l, double of[CELLS])
{
    memset(of, 0, CELLS * sizeof *of);
    for (int i = 0; i < CELLS * FINE * FINE; i += LANES) {
        vint number = vlane_index() + i;
        vint cell = number / (FINE * FINE), fine = number % (FINE * FINE);
        vfloat s = (vto_float(cell / COLUMNS) + (vto_float(fine / FINE) + 0.5f) / FINE) / ROWS;
        vfloat t = (vto_float(cell % COLUMNS) + (vto_float(fine % FINE) + 0.5f) / FINE) / COLUMNS;
        vfloat w = intensity(l, vwarp_sphere(s, t));
        for (int k = 0; k < LANES; k++)
            of[lane(cell, k)] += 4.0 * M_PI * (double)lane(w, k) / (CELLS * FINE * FINE);
    }
}

typedef struct tally {
    double sum, squares;
    int count;
} tally;

static vfloat random_of(int first, uint32_t which)
{
    vuint n = vhash_combine(vunsigned(vlane_index() + first), vsplat_uint(which));
    return vto_float(vsigned(n >> 8)) * 0x1p-24f;
}

/* Independent random numbers: so the spread of sums over cells is that of Poisson's law. */
static void tally_up(const light *l, tally of[CELLS])
{
    memset(of, 0, CELLS * sizeof *of);
    for (int i = 0; i < DRAWN; i += LANES) {
        vlight_ray r;
        l->type->emit(l, &around, random_of(i, 1), random_of(i, 2), random_of(i, 3),
                      random_of(i, 4), ALL_LANES, &r);
        vfloat phi = vatan2(r.direction.y, r.direction.x) * (0.5f / WARP_PI);
        vfloat row = vmax(0.5f - 0.5f * r.direction.z, vsplat(0.0f)) * ROWS;
        vfloat col = vselect(phi < 0.0f, phi + 1.0f, phi) * COLUMNS;
        vint cell  = vto_int(vmin(row, vsplat(ROWS - 1.0f))) * COLUMNS +
                    vto_int(vmin(col, vsplat(COLUMNS - 1.0f)));
        vfloat y = vrgb_luminance(r.flux);
        for (int k = 0; k < LANES; k++) {
            double w = (double)lane(y, k) / DRAWN;
            tally *t = &of[lane(cell, k)];
            t->sum += w;
            t->squares += w * w;
            t->count += w > 0.0;
        }
    }
}

static void directions_agree(const char *name, const light *l)
{
    double want[CELLS], chi_square = 0.0, more = 0.0, expected = 0.0, squares = 0.0;
    tally got[CELLS];
    int degrees = 0, count = 0;
    expect(l, want);
    tally_up(l, got);
    for (int i = 0; i < CELLS; i++) {
        if (want[i] == 0.0 && got[i].sum > 1e-5 * (double)rgb_luminance(light_flux(l)))
            fail_msg("%s shines where it is dark", name);
        more += got[i].sum;
        expected += want[i];
        squares += got[i].squares;
        count += got[i].count;
        if (count < 20 && i < CELLS - 1)
            continue;
        if (squares > 0.0) {
            chi_square += (more - expected) * (more - expected) / squares;
            degrees++;
        }
        more = expected = squares = 0.0;
        count                     = 0;
    }
    double chance = chi_square_tail(chi_square, degrees);
    print_message("           %-18s chi-square %.1f of %d: %.3f\n", name, chi_square, degrees,
                  chance);
    assert_true(chance > 1e-4); /* one in 500 runs of other numbers */
}

TEST(directions_are_drawn_by_intensity) { for_each(SPREAD, directions_agree); }

/* ---- where from ------------------------------------------------------------------------------ */

enum { SETS = 16, EACH = 1 << 13, SIDE = 6 };

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
            vlight_ray r = draw(l, i, 100 + (uint32_t)set, &lit);
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

/* The same by Gauss's rule, or the midpoint rule, of what is asked for at points. */
static double by_asking(const light *l, const square *q)
{
    double sum  = 0.0;
    double area = 4.0 * (double)(v3_length(q->u) * v3_length(q->v));
    for (int i = 0; i < SIDE * SIDE; i++) {
        float x = 2.0f * ((float)(i % SIDE) + 0.5f) / SIDE - 1.0f;
        float y = 2.0f * ((float)(i / SIDE) + 0.5f) / SIDE - 1.0f;
        vec3 p  = { q->centre.x + x * q->u.x + y * q->v.x, q->centre.y + x * q->u.y + y * q->v.y,
                    q->centre.z + x * q->u.z + y * q->v.z };
        sum += mean_irradiance(l, p, q->n, 8, NULL) * area / (SIDE * SIDE);
    }
    return sum;
}

static void places_agree(const char *name, const light *l)
{
    const double rule = 0.01; /* of the midpoint rule, of these squares at these distances */
    print_message("           %-18s", name);
    for (int i = 0; i < SQUARES; i++) {
        double error, got = by_particles(l, &squares[i], &error);
        double want = by_asking(l, &squares[i]);
        print_message(" %9.3g W %+.4f +- %.4f", want, want > 0.0 ? got / want - 1.0 : got,
                      want > 0.0 ? error / want : error);
        if (fabs(got - want) > 4.0 * error + rule * want)
            fail_msg("%s: %g W cross square %d, not %g: off by %g errors", name, got, i, want,
                     fabs(got - want) / error);
    }
    print_message("\n");
}

TEST(what_crosses_squares_near_a_lamp_is_what_is_asked_for_there)
{
    for_each(SPREAD, places_agree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(all_light_of_a_lamp_sets_out),
        cmocka_unit_test(directions_are_drawn_by_intensity),
        cmocka_unit_test(what_crosses_squares_near_a_lamp_is_what_is_asked_for_there),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
