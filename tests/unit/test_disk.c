/* tests/unit/test_disk.c -- the disk: closed forms, quadrature in double, its sampler. */
#include "core/sampler.h"
#include "core/transform.h"
#include "lights/light.h"
#include "tests/shapes.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324;

static const light *make(arena *a, vec3 centre, vec3 aim, float radius)
{
    disk_desc d    = { centre, aim, radius, { 1, 2, 3 } };
    const light *l = light_disk(a, &d, NULL);
    assert_non_null(l);
    return l;
}

/* The red channel of the closed form, for a radiance of 1 */
static double closed(const light *l, vec3 at, vec3 normal)
{
    vvec3 p = vspread(at), n = vspread(normal);
    vrgb e = l->type->irradiance(l, &p, &n, ALL_LANES);
    assert_true(lane(e.x, 0) >= 0 && lane(e.x, 0) <= 3.1415928f);
    assert_near(lane(e.z, 0), 3 * (double)lane(e.x, 0), 1e-6);
    return (double)lane(e.x, 0);
}

/* The rule of `count` places of Gauss and Legendre on [-1, 1] (Newton's method on P_n). */
static void gauss(int count, double *at, double *weight)
{
    for (int i = 0; i < count; i++) {
        double x = cos(pi * (i + 0.75) / (count + 0.5)), slope = 1;
        for (int turn = 0; turn < 20; turn++) {
            double p = 1, before = 0;
            for (int k = 1; k <= count; k++) {
                double next = ((2 * k - 1) * x * p - (k - 1) * before) / k;
                before      = p;
                p           = next;
            }
            slope = count * (x * p - before) / (x * x - 1);
            x -= p / slope;
        }
        at[i]     = x;
        weight[i] = 2 / ((1 - x * x) * slope * slope);
    }
}

/* A disk and a place before it, in double */
typedef struct view {
    dvec3 to, axis, normal; /* from the place to the centre; unit: of the disk, of the receiver */
    double radius;
} view;

static view view_of(vec3 centre, vec3 aim, float radius, vec3 at, vec3 normal)
{
    dvec3 a = d3_from(aim);
    return (view){ d3_add(d3_from(centre), d3_scale(d3_from(at), -1)),
                   d3_scale(a, 1 / d3_length(a)), d3_from(normal), (double)radius };
}

static void double_frame(dvec3 n, dvec3 *u, dvec3 *v)
{
    dvec3 pick = fabs(n.x) < 0.6 ? (dvec3){ 1, 0, 0 } : (dvec3){ 0, 1, 0 };
    *u         = d3_cross(pick, n);
    *u         = d3_scale(*u, 1 / d3_length(*u));
    *v         = d3_cross(n, *u);
}

/* Over the disk in strips that run along the receiver, from its horizon on, v = -R cos x (so that
 * the strips' lengths are smooth in x) and within each strip likewise smooth in its place;
 * `facing`: each element on a surface that faces it. */
static double by_quadrature(view s, bool facing)
{
    enum { N = 128 };
    static double at[N], weight[N];
    if (weight[0] == 0)
        gauss(N, at, weight);
    if (-d3_dot(s.to, s.axis) <= 0)
        return 0;

    /* Up the slope, and across: where the slope is 0 any direction will do */
    dvec3 up = d3_add(s.normal, d3_scale(s.axis, -d3_dot(s.normal, s.axis))), across;
    if (d3_length(up) < 1e-9)
        double_frame(s.axis, &up, &across);
    up     = d3_scale(up, 1 / d3_length(up));
    across = d3_cross(s.axis, up);

    double slope = d3_dot(up, s.normal), middle = d3_dot(s.to, s.normal), from = 0;
    if (!facing && middle < slope * s.radius)
        from = middle <= -slope * s.radius ? pi : acos(middle / (slope * s.radius));
    double sum = 0;
    for (int i = 0; i < N; i++) {
        double x = from + (pi - from) * 0.5 * (1 + at[i]);
        double v = -s.radius * cos(x), half = s.radius * sin(x);
        for (int j = 0; j < N; j++) {
            /* Nearest the foot of the place the integrand may peak: sinh spreads it */
            double foot  = -d3_dot(s.to, across);
            double z     = -d3_dot(s.to, s.axis);
            double near_ = hypot(z, v + d3_dot(s.to, up));
            double k0 = asinh((-half - foot) / near_), k1 = asinh((half - foot) / near_);
            double k  = k0 + (k1 - k0) * 0.5 * (1 + at[j]);
            double w  = foot + near_ * sinh(k);
            dvec3 r   = d3_add(s.to, d3_add(d3_scale(up, v), d3_scale(across, w)));
            double r2 = d3_dot(r, r), cos_n = facing ? 1 : d3_dot(r, s.normal) / sqrt(r2);
            double area = weight[i] * 0.5 * (pi - from) * s.radius * sin(x) * weight[j] * 0.5 *
                          (k1 - k0) * near_ * cosh(k);
            sum += area * cos_n * z / (r2 * sqrt(r2));
        }
    }
    return sum;
}

static double by_samples(const light *l, vec3 at, vec3 normal, uint32_t seed, int count)
{
    vvec3 p = vspread(at), n = vspread(normal);
    double sum = 0;
    for (int i = 0; i < count; i += LANES) {
        vsample4 u = vsobol4(vunsigned(vlane_index() + i), vsplat_uint(seed));
        vlight_sample s;
        light_sample(l, &p, u.x, u.y, ALL_LANES, &s);
        sum += (double)vsum(s.e.x * vmax(vdot(n, s.wi), vsplat(0)));
    }
    return sum / count;
}

/* reference.md: radius 1, at a height of 2; the receiver is parallel or vertical. */
TEST(closed_forms_of_the_reference_come_out)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, 2 }, (vec3){ 0, 0, -3 }, 1);
    vec3 up = { 0, 0, 1 }, inward = { -1, 0, 0 };
    assert_near(closed(l, (vec3){ 0, 0, 0 }, up), pi / 5, 1e-6);
    static const struct {
        float d;
        double parallel, vertical;
    } row[] = { { 0.5f, 0.580264, 0.131366 },
                { 1, 0.460076, 0.190570 },
                { 2, 0.206963, 0.182703 },
                { 3, 0.0806081, 0.111838 } };
    for (int i = 0; i < 4; i++) {
        vec3 along_x = { row[i].d, 0, 0 }, askew = { 0.6f * row[i].d, -0.8f * row[i].d, 0 };
        assert_near(closed(l, along_x, up), row[i].parallel, 4e-6); /* its digits */
        assert_near(closed(l, along_x, inward), row[i].vertical, 4e-6);
        assert_near(closed(l, askew, (vec3){ -0.6f, 0.8f, 0 }), row[i].vertical, 4e-6);
        assert_near(by_samples(l, along_x, up, 3, 4096), row[i].parallel, 1e-4);
    }
    assert_true(closed(l, (vec3){ 0, 0, 0 }, (vec3){ 0, 0, -1 }) == 0);
    assert_true(closed(l, (vec3){ 0, 0, 3 }, (vec3){ 0, 0, -1 }) == 0); /* behind the disk */
    assert_true(by_samples(l, (vec3){ 0, 0, 3 }, (vec3){ 0, 0, -1 }, 1, 16) == 0);
    arena_clear(&a);
}

TEST(a_thousand_places_and_tilts_agree_with_quadrature)
{
    arena a             = { 0 };
    uint32_t seed       = 18;
    double worst_closed = 0, worst_sampled = 0;
    int cut = 0;
    for (int i = 0; i < 1000;) {
        vec3 centre = random_point(&seed), aim = random_direction(&seed);
        float radius = 0.1f + random_unit(&seed);
        vec3 at = v3_scale(random_point(&seed), i % 3 ? 2 : 6), n = random_direction(&seed);
        view s = view_of(centre, aim, radius, at, n);
        if (-d3_dot(s.to, s.axis) < 0.05)
            continue;
        const light *l = make(&a, centre, aim, radius);
        double want = by_quadrature(s, false), facing = by_quadrature(s, true);
        double off     = fabs(closed(l, at, n) - want) / facing,
               sampled = fabs(by_samples(l, at, n, seed, 64) - want) / facing;
        worst_closed   = fmax(worst_closed, off);
        worst_sampled  = fmax(worst_sampled, sampled);
        double level   = sqrt(1 - pow(d3_dot(s.normal, s.axis), 2));
        cut += fabs(d3_dot(s.to, s.normal)) < level * s.radius;
        i++;
    }
    assert_true(worst_closed < 1e-5);
    assert_true(worst_sampled < 5e-3); /* of the worst; with other seeds 3e-3 to 7e-3 */
    assert_true(cut > 200);
    arena_clear(&a);
}

/* A metre, a millimetre and a micrometre before it: all but the edge sees nothing else. */
TEST(close_by_it_never_gives_more_than_pi)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, 0 }, (vec3){ 0, 0, 1 }, 1);
    for (int k = 0; k < 3; k++) {
        float z = (float[]){ 1, 1e-3f, 1e-6f }[k];
        for (float d = 0; d < 1.3f; d += 0.05f)
            for (float tilt = -3; tilt < 3.2f; tilt += 0.25f) {
                vec3 at = { 0.8f * d, -0.6f * d, z }, n = { sinf(tilt), 0, cosf(tilt) };
                double e = closed(l, at, n); /* asserts that */
                double s = by_samples(l, at, n, 7, 256);
                assert_true(s >= 0 && s < 1.02 * pi);
                assert_true(fabs(s - e) < 0.01);

                if (d < 0.9f && z < 1e-2f) /* a wide wall: (1 - cos tilt) / 2 of pi */
                    assert_true(fabs(e - 0.5 * pi * (1 - (double)n.z)) < 0.02 + 20 * (double)z);
            }
        double want = pi / (1 + (double)z * (double)z);
        assert_near(closed(l, (vec3){ 0, 0, z }, (vec3){ 0, 0, -1 }), want, 1e-6);
    }
    vec3 edge = { 1, 0, 0 }, in_plane = { 0.5f, 0, 0 };
    assert_true(closed(l, edge, (vec3){ 0, 0, -1 }) == 0);
    assert_true(closed(l, in_plane, (vec3){ 0, 0, -1 }) == 0);
    for (float z = 1; z > 0; z *= 0.1f) { /* down to where squares are 0 */
        assert_true(by_samples(l, (vec3){ 1, 0, z }, (vec3){ 0, 0, -1 }, 1, 64) < 1.02 * pi);
        closed(l, (vec3){ 1, 0, z }, (vec3){ 0, 0, -1 });
        closed(l, (vec3){ 0, 0, z }, (vec3){ -1, 0, 0 });
    }
    arena_clear(&a);
}

/* Far away, where the differences of the closed form would cancel */
TEST(far_away_it_stays_exact)
{
    arena a       = { 0 };
    uint32_t seed = 41;
    double worst  = 0;
    for (int i = 0; i < 400; i++) {
        vec3 centre = { 0, 0, 0 }, aim = random_direction(&seed), n = random_direction(&seed);
        float r = i % 4 == 1 ? 60 + 10 * random_unit(&seed) /* where the way to it changes */
                             : powf(10, 3 * random_unit(&seed)) * 3;
        vec3 at = v3_scale(random_direction(&seed), r);
        if (i % 2) { /* nearly edge-on: the horizon cuts it */
            vec3 side = v3_cross(n, at);
            n         = v3_scale(side, 1 / v3_length(side));
        }
        view s = view_of(centre, aim, 1, at, n);
        if (-d3_dot(s.to, s.axis) < 0.02 * d3_length(s.to))
            continue;
        double want = by_quadrature(s, false), facing = by_quadrature(s, true);
        double off = fabs(closed(make(&a, centre, aim, 1), at, n) - want) / facing;
        worst      = fmax(worst, off);
    }
    assert_true(worst < 1e-5);
    arena_clear(&a);
}

/* Cells even in area on the disk */
enum { ROWS = 12, COLUMNS = 16, CELLS = ROWS * COLUMNS, FINE = 16, SAMPLES = 1 << 16 };

/* What the pdf that rays see makes of each, by its midpoints: in all 1, but for that rule and for
 * floats at the edge. */
static void expect_cells(const light *l, vvec3 p, double *expected)
{
    double sum = 0, d = (double)lane(p.x, 0), z = (double)lane(p.z, 0);
    for (int c = 0; c < CELLS; c++) {
        expected[c] = 0;
        for (int f = 0; f < FINE * FINE; f++) {
            double r   = sqrt((c / COLUMNS + (f / FINE + 0.5) / FINE) / ROWS);
            double phi = 2 * pi * (c % COLUMNS + (f % FINE + 0.5) / FINE) / COLUMNS;
            dvec3 to   = { r * cos(phi) - d, r * sin(phi), -z };
            double far = d3_length(to);
            vvec3 wi   = vspread(d3_to_float(d3_scale(to, 1 / far)));
            vlight_hit h;
            if (vall(l->type->hit(l, &p, &wi, ALL_LANES, &h)))
                expected[c] += (double)lane(h.pdf, 0) * z / (far * far * far);
        }
        expected[c] *= pi / CELLS / (FINE * FINE);
        sum += expected[c];
    }
    assert_near(sum, 1, 1e-3);
    for (int c = 0; c < CELLS; c++)
        expected[c] *= SAMPLES / sum;
}

static double chi_square_at(float d, float z, uint32_t seed)
{
    arena a          = { 0 };
    const light *l   = make(&a, (vec3){ 0, 0, 0 }, (vec3){ 0, 0, 1 }, 1);
    vvec3 p          = vspread((vec3){ d, 0, z });
    int count[CELLS] = { 0 };
    double expected[CELLS];
    expect_cells(l, p, expected);
    for (int n = 0; n < SAMPLES; n += LANES) {
        float u[LANES], v[LANES];
        for (int i = 0; i < LANES; i++) {
            u[i] = random_unit(&seed);
            v[i] = random_unit(&seed);
        }
        vlight_sample s;
        light_sample(l, &p, vload(u), vload(v), ALL_LANES, &s);
        vvec3 place = valong(p, s.wi, s.dist);
        for (int i = 0; i < LANES; i++) {
            double x = (double)lane(place.x, i), y = (double)lane(place.y, i), r2 = x * x + y * y;
            double turn = atan2(y, x) / (2 * pi);
            int row = (int)(r2 * ROWS), column = (int)((turn < 0 ? turn + 1 : turn) * COLUMNS);
            assert_true(r2 < 1.0001);
            row    = row < ROWS ? row : ROWS - 1;
            column = column < COLUMNS ? column : COLUMNS - 1;
            count[row * COLUMNS + column]++;
        }
    }
    arena_clear(&a);
    return chi_square_test(expected, count, CELLS);
}

TEST(samples_follow_the_density_that_rays_see)
{
    assert_true(chi_square_at(0, 2, 1) > 0.01);
    assert_true(chi_square_at(0.5f, 0.3f, 2) > 0.01);
    assert_true(chi_square_at(0.9f, 0.2f, 3) > 0.01);
    assert_true(chi_square_at(2, 0.3f, 4) > 0.01);
    assert_true(chi_square_at(30, 20, 5) > 0.01);
}

/* As disk.c promises; the solid angle is what each element gives to a surface that faces it. */
TEST(the_density_is_all_but_one_over_the_solid_angle)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, 0 }, (vec3){ 0, 0, 1 }, 1);
    uint32_t seed  = 45;
    double low = 1, high = 1;
    for (int i = 0; i < 300; i++) {
        vec3 at = { 3 * random_unit(&seed), 0, powf(10, 2 * random_unit(&seed) - 1.3f) };
        double omega =
            by_quadrature(view_of((vec3){ 0, 0, 0 }, (vec3){ 0, 0, 1 }, 1, at, at), true);
        double rim = hypot((double)at.z, (double)at.x - 1);
        vvec3 p    = vspread(at);
        for (int k = 0; k < 16; k++) {
            vlight_sample s;
            vfloat x = vsplat(random_unit(&seed)), y = vsplat(random_unit(&seed));
            light_sample(l, &p, x, y, ALL_LANES, &s);
            double even = omega * (double)lane(s.pdf, 0);
            low         = fmin(low, even);
            high        = fmax(high, even);
            assert_true(rim < 0.5 || fabs(even - 1) < 3e-3);
        }
    }
    assert_true(low > 0.92 && high < 1.07 && high > 1.01);
    arena_clear(&a);
}

TEST(a_sample_is_a_hit_of_the_same_density)
{
    arena a       = { 0 };
    uint32_t seed = 51;
    for (int i = 0; i < 3000; i++) {
        vec3 aim = random_direction(&seed);
        float z = powf(10, 2 - 4 * random_unit(&seed)), d = 3 * random_unit(&seed);
        vec3 u, v;
        aim = v3_scale(aim, 1 / v3_length(aim));
        v3_frame(aim, &u, &v);
        vec3 at        = { z * aim.x + d * u.x, z * aim.y + d * u.y, z * aim.z + d * u.z };
        const light *l = make(&a, (vec3){ 0, 0, 0 }, aim, 1);
        vvec3 p        = vspread(at);
        vlight_sample s;
        vlight_hit h;
        vfloat x = vsplat(random_unit(&seed)), y = vsplat(0.9f * random_unit(&seed));
        assert_true(vall(light_sample(l, &p, x, y, ALL_LANES, &s)));
        assert_near(lane(vlength(s.wi), 0), 1, 1e-6);
        if (!vany(l->type->hit(l, &p, &s.wi, ALL_LANES, &h))) {
            vvec3 place = valong(p, s.wi, s.dist);
            assert_true(lane(vlength(place), 0) > 0.999f); /* only next to the edge */
            continue;
        }
        assert_near(lane(h.dist, 0), (double)lane(s.dist, 0), 1e-4); /* grazing */
        assert_near(lane(h.pdf, 0), (double)lane(s.pdf, 0),
                    1e-3); /* of the turn, near the middle */
        assert_near((double)lane(s.e.y, 0) * (double)lane(h.pdf, 0), 2, 1e-3);
        assert_true(lane(h.radiance.z, 0) == 3);
        vvec3 back = vneg(s.wi), behind = vneg(p);
        assert_false(vany(l->type->hit(l, &p, &back, ALL_LANES, &h)));
        assert_false(vany(l->type->hit(l, &behind, &back, ALL_LANES, &h)));
        assert_true(lane(h.dist, 0) == 0 && lane(h.pdf, 0) == 0 && lane(h.radiance.x, 0) == 0);
    }
    arena_clear(&a);
}

/* By Lambert's contour: the arc beyond the edge's shadow on the disk, x > x0, and its chord */
TEST(a_half_plane_shadows_it_as_in_closed_form)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, 2 }, (vec3){ 0, 0, -1 }, 1);
    vvec3 p        = vspread((vec3){ 0, 0, 0 });
    for (float edge = -0.4f; edge < 0.45f; edge += 0.1f) { /* at half the height */
        double x0 = 2 * (double)edge, slant = sqrt(x0 * x0 + 4), sum = 0;
        double want = acos(x0) / 5 - x0 / slant * atan(sqrt(1 - x0 * x0) / slant);
        enum { N = 1 << 14 };
        for (uint32_t i = 0; i < N; i += LANES) {
            vsample4 u = vsobol4(vunsigned(vlane_index()) + i, vsplat_uint(5));
            vlight_sample s;
            light_sample(l, &p, u.x, u.y, ALL_LANES, &s);
            vfloat passes = s.wi.x / s.wi.z; /* at a height of 1 */
            sum += (double)vsum(vkeep(passes > edge, s.e.x * s.wi.z));
        }
        assert_true(fabs(sum / N - want) < 1e-3 * pi / 5); /* some cells at the edge, of N */
    }
    arena_clear(&a);
}

TEST(as_a_point_it_is_off_by_no_more_than_its_bound)
{
    arena a         = { 0 };
    uint32_t seed   = 61;
    double tightest = 0, white = 0.2126 + 0.7152 * 2 + 0.0722 * 3;
    for (int i = 0; i < 100; i++) {
        vec3 centre = random_point(&seed), aim = random_direction(&seed);
        float radius   = 0.1f + 0.4f * random_unit(&seed);
        const light *l = make(&a, centre, aim, radius);
        vec3 at        = v3_scale(random_point(&seed), 2.0f + (float)(i % 10) * 2.0f);
        vvec3 p        = vspread(at);
        vlight_sample s;
        vfloat bound;
        l->type->as_point(l, &p, ALL_LANES, &s, &bound);
        if (lane(bound, 0) == INFINITY || lane(s.dist, 0) == 0)
            continue;
        for (int k = 0; k < 8; k++) {
            vec3 n   = random_direction(&seed);
            vec3 way = { lane(s.wi.x, 0), lane(s.wi.y, 0), lane(s.wi.z, 0) };
            if (k % 2) { /* nearly edge-on */
                vec3 side = v3_cross(n, way);
                n         = v3_scale(side, 1 / v3_length(side));
            }
            double want  = by_quadrature(view_of(centre, aim, radius, at, n), false);
            double point = (double)lane(s.e.x, 0);
            double cos_n = d3_dot(d3_from(n), d3_from(way));
            double off   = white * fabs(want - point * fmax(cos_n, 0));
            double least = (double)lane(bound, 0) + 2e-6 * white * point; /* of floats */
            assert_true(off <= least);
            tightest = fmax(tightest, off / least);
        }
    }
    assert_true(tightest > 0.5); /* and so not a rough one */
    vvec3 near_ = vspread((vec3){ 0.5f, 0, 1 });
    vlight_sample s;
    vfloat bound;
    const light *l = make(&a, (vec3){ 0, 0, 0 }, (vec3){ 0, 0, 1 }, 1);
    l->type->as_point(l, &near_, ALL_LANES, &s, &bound);
    assert_true(lane(bound, 0) == INFINITY);
    arena_clear(&a);
}

TEST(the_weight_is_positive_wherever_a_sample_lights)
{
    arena a       = { 0 };
    uint32_t seed = 71;
    for (int i = 0; i < 2000; i++) {
        const light *l = make(&a, random_point(&seed), random_direction(&seed), 0.5f);
        vvec3 p        = vspread(v3_scale(random_point(&seed), 2));
        vvec3 n        = vspread(random_direction(&seed));
        vfloat w       = l->type->weight(l, &p, &n, ALL_LANES);
        assert_true(vall((w >= 0) & (w < INFINITY)));
        for (int k = 0; k < 16; k++) {
            vlight_sample s;
            light_sample(l, &p, vsplat(random_unit(&seed)), vsplat(random_unit(&seed)), ALL_LANES,
                         &s);
            assert_true(vall((w > 0) | ~(vdot(n, s.wi) > 1e-6f)));
        }
    }
    arena_clear(&a);
}

TEST(flux_peak_and_bounds_agree)
{
    arena a        = { 0 };
    vec3 aim       = { 0, 0.6f, 0.8f };
    const light *l = make(&a, (vec3){ 1, 2, 3 }, aim, 0.5f);
    assert_near(light_flux(l).y, 2 * pi * pi * 0.25, 1e-6);
    vec3 toward, most = l->type->peak(l, &toward);
    assert_near(most.z, 3 * pi * 0.25, 1e-6);
    assert_near(toward.y, 0.6, 1e-6);
    light_bounds b = light_bounds_of(l);
    assert_true(b.cos_spread == 1 && b.cos_reach == 0 && !b.far);
    assert_near(b.high.x, 1.5, 1e-6);
    assert_near(b.high.y, 2.4, 1e-6);
    assert_near(b.low.z, 2.7, 1e-6);
    assert_near(b.peak, (0.2126 + 0.7152 * 2 + 0.0722 * 3) * pi * 0.25, 1e-6);

    /* A hemisphere around it, even in area, receives the flux */
    enum { N = 2000 };
    double sum      = 0;
    const light *up = make(&a, (vec3){ 0, 0, 0 }, (vec3){ 0, 0, 1 }, 0.5f);
    for (int i = 0; i < N; i++) {
        float z = (float)((i + 0.5) / N), r = sqrtf(1 - z * z);
        sum += closed(up, (vec3){ r, 0, z }, (vec3){ -r, 0, -z }) * 2 * pi / N;
    }
    assert_near(sum, pi * pi * 0.25, 1e-4);
    arena_clear(&a);
}

TEST(dead_lanes_are_zero)
{
    arena a        = { 0 };
    const light *l = make(&a, (vec3){ 0, 0, 2 }, (vec3){ 0, 0, -1 }, 0.3f);
    vvec3 p = vspread((vec3){ 0, 0, 0 }), n = vspread((vec3){ 0, 0, 1 });
    vmask one = vlane_index() < 1;
    vlight_sample s, c;
    vlight_hit h;
    vfloat bound;
    assert_int_equal(vbits(light_sample(l, &p, vsplat(0), vsplat(0), one, &s)), 1);
    assert_int_equal(vbits(l->type->as_point(l, &p, one, &c, &bound)), 1);
    assert_int_equal(vbits(l->type->hit(l, &p, &n, one, &h)), 1);
    vrgb e   = l->type->irradiance(l, &p, &n, one);
    vfloat w = l->type->weight(l, &p, &n, one);
    for (int i = 1; i < LANES; i++) {
        assert_true(lane(s.e.x, i) == 0 && lane(s.dist, i) == 0 && lane(s.pdf, i) == 0);
        assert_true(lane(c.e.x, i) == 0 && lane(c.dist, i) == 0 && lane(bound, i) == 0);
        assert_true(lane(h.pdf, i) == 0 && lane(h.dist, i) == 0 && lane(h.radiance.y, i) == 0);
        assert_true(lane(e.y, i) == 0 && lane(w, i) == 0);
    }
    arena_clear(&a);
}

TEST(what_makes_no_sense_is_refused)
{
    arena a              = { 0 };
    lux_error err        = { 0 };
    const disk_desc good = { { 0, 0, 0 }, { 0, 0, 1 }, 1, { 1, 1, 1 } };
    disk_desc d          = good;
    d.radius             = 0;
    assert_null(light_disk(&a, &d, &err));
    assert_int_equal(err.code, ERR_ARGUMENT);
    d.radius = NAN;
    assert_null(light_disk(&a, &d, &err));
    d     = good;
    d.aim = (vec3){ 0, 0, 0 };
    assert_null(light_disk(&a, &d, &err));
    d            = good;
    d.radiance.x = -1;
    assert_null(light_disk(&a, &d, &err));
    memory_is_out = true;
    arena none    = { 0 };
    assert_null(light_disk(&none, &good, &err));
    memory_is_out = false;
    assert_int_equal(err.code, ERR_MEMORY);
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(closed_forms_of_the_reference_come_out),
        cmocka_unit_test(a_thousand_places_and_tilts_agree_with_quadrature),
        cmocka_unit_test(close_by_it_never_gives_more_than_pi),
        cmocka_unit_test(far_away_it_stays_exact),
        cmocka_unit_test(samples_follow_the_density_that_rays_see),
        cmocka_unit_test(the_density_is_all_but_one_over_the_solid_angle),
        cmocka_unit_test(a_sample_is_a_hit_of_the_same_density),
        cmocka_unit_test(a_half_plane_shadows_it_as_in_closed_form),
        cmocka_unit_test(as_a_point_it_is_off_by_no_more_than_its_bound),
        cmocka_unit_test(the_weight_is_positive_wherever_a_sample_lights),
        cmocka_unit_test(flux_peak_and_bounds_agree),
        cmocka_unit_test(dead_lanes_are_zero),
        cmocka_unit_test(what_makes_no_sense_is_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
