/* tests/flat_twin.c -- the light of flat polygons in double precision: see flat_twin.h. */
#include "tests/flat_twin.h"

#include "core/sampler.h"
#include "tests/test.h"

static dvec3 unit(dvec3 a) { return d3_scale(a, 1.0 / d3_length(a)); }

dvec3 twin_centre(const flat_twin *f)
{
    dvec3 c = { 0 };
    for (int i = 0; i < f->corners; i++)
        c = d3_add(c, d3_scale(f->corner[i], 1.0 / f->corners));
    return c;
}

double twin_size(const flat_twin *f)
{
    double size = 0.0;
    for (int i = 0; i < f->corners; i++)
        for (int k = 0; k < i; k++)
            size = fmax(size, d3_length(d3_sub(f->corner[i], f->corner[k])));
    return size;
}

static dvec3 twin_normal(const flat_twin *f)
{
    return unit(d3_cross(d3_sub(f->corner[1], f->corner[0]), d3_sub(f->corner[2], f->corner[0])));
}

double twin_irradiance(const flat_twin *f, dvec3 p, dvec3 n)
{
    double height = d3_dot(d3_sub(p, f->corner[0]), twin_normal(f));
    if (height == 0.0 || (height < 0.0 && !f->two_sided))
        return 0.0;

    /* What is above the horizon (Sutherland & Hodgman 1974) */
    dvec3 v[8];
    int count = 0;
    for (int i = 0; i < f->corners; i++) {
        dvec3 a  = d3_sub(f->corner[i], p);
        dvec3 b  = d3_sub(f->corner[(i + 1) % f->corners], p);
        double x = d3_dot(a, n), y = d3_dot(b, n);
        if (x >= 0.0)
            v[count++] = a;
        if ((x >= 0.0) != (y >= 0.0))
            v[count++] = d3_add(a, d3_scale(d3_sub(b, a), x / (x - y)));
    }
    double sum = 0.0;
    for (int i = 0; i < count; i++) {
        dvec3 a = v[i], b = v[(i + 1) % count], c = d3_cross(a, d3_sub(b, a));
        double length = d3_length(c);
        if (length > 0.0)
            sum += atan2(length, d3_dot(a, b)) * d3_dot(c, n) / length;
    }
    return 0.5 * fabs(sum);
}

/* Cells of a triangle: the midpoints of the four-way subdivision, both ways up. */
static double triangle_quadrature(const dvec3 corner[3], bool two_sided, dvec3 p, dvec3 n, int side)
{
    dvec3 e = d3_sub(corner[1], corner[0]), g = d3_sub(corner[2], corner[0]), c = d3_cross(e, g);
    double twice = d3_length(c), sum = 0.0;
    for (int i = 0; i < side; i++)
        for (int k = 0; k < 2 * (side - i) - 1; k++) {
            double shift = k % 2 ? 2.0 / 3.0 : 1.0 / 3.0;
            dvec3 at     = d3_add(corner[0], d3_add(d3_scale(e, (i + shift) / side),
                                                    d3_scale(g, (k / 2 + shift) / side)));
            dvec3 to     = d3_sub(at, p);
            double r2    = d3_dot(to, to);
            double cos_e = -d3_dot(to, c) / twice;
            double cos_r = fmax(d3_dot(to, n), 0.0);
            sum += fmax(two_sided ? fabs(cos_e) : cos_e, 0.0) * cos_r / (r2 * r2);
        }
    return sum * 0.5 * twice / ((double)side * side);
}

double twin_quadrature(const flat_twin *f, dvec3 p, dvec3 n, int side)
{
    double e = 0.0;
    for (int i = 2; i < f->corners; i++) {
        dvec3 t[3] = { f->corner[0], f->corner[i - 1], f->corner[i] };
        e += triangle_quadrature(t, f->two_sided, p, n, side);
    }
    return e;
}

double twin_facing(const flat_twin *f, dvec3 p)
{
    return twin_irradiance(f, p, unit(d3_sub(twin_centre(f), p)));
}

double twin_random(uint32_t *state)
{
    *state += 1;
    return (double)hash_u32(*state) * 0x1p-32;
}

dvec3 twin_direction(uint32_t *state)
{
    double z = 2.0 * twin_random(state) - 1.0, turn = 2.0 * M_PI * twin_random(state);
    double r = sqrt(1.0 - z * z);
    return (dvec3){ r * cos(turn), r * sin(turn), z };
}

void twin_place(const flat_twin *f, double near_, double far, uint32_t *state, dvec3 *p, dvec3 *n)
{
    do {
        double d = twin_size(f) * near_ * pow(far / near_, twin_random(state));
        dvec3 w  = twin_direction(state);
        if (!f->two_sided && d3_dot(w, twin_normal(f)) < 0.0)
            w = d3_scale(w, -1.0);
        *p = d3_rounded(d3_add(twin_centre(f), d3_scale(w, d)));
        *n = d3_rounded(twin_direction(state));
    } while (twin_irradiance(f, *p, *n) == 0.0);
}

double light_closed_form(const light *l, dvec3 p, dvec3 n)
{
    vvec3 place = vspread(d3_to_float(p)), normal = vspread(d3_to_float(n));
    vrgb e = l->type->irradiance(l, &place, &normal, ALL_LANES);
    for (int i = 0; i < LANES; i++)
        assert_true(lane(e.y, i) == lane(e.x, 0) && lane(e.z, i) == lane(e.x, 0));
    return (double)lane(e.x, 0);
}

double light_sampled(const light *l, dvec3 p, dvec3 n, int count, uint32_t seed)
{
    vvec3 place = vspread(d3_to_float(p)), normal = vspread(d3_to_float(n));
    double sum = 0.0;
    for (int k = 0; k < count; k += LANES) {
        vsample4 q = vsobol4(vunsigned(vlane_index() + k), vsplat_uint(seed));
        vlight_sample s;
        vmask lit    = light_sample(l, &place, q.x, q.y, ALL_LANES, &s);
        vfloat cos_r = vmax(vdot(normal, s.wi), vsplat(0.0f));
        vfloat e     = vkeep(lit, s.e.x * cos_r);
        for (int i = 0; i < LANES; i++)
            sum += (double)lane(e, i);
    }
    return sum / count;
}

enum { ROWS = 24, SHOTS = 1 << 16 };

/* Cells of the polygon: of the rectangle by its sides, of the triangle by two of them. */
static int cell_of(const flat_twin *f, dvec3 at)
{
    dvec3 e = d3_sub(f->corner[1], f->corner[0]);
    dvec3 g = d3_sub(f->corner[f->corners - 1], f->corner[0]), o = d3_sub(at, f->corner[0]);
    dvec3 c   = d3_cross(e, g);
    double c2 = d3_dot(c, c);
    double x = d3_dot(d3_cross(o, g), c) / c2, y = d3_dot(d3_cross(e, o), c) / c2;
    int column = (int)fmin(fmax(x * ROWS, 0.0), ROWS - 1);
    int row    = (int)fmin(fmax(y * ROWS, 0.0), ROWS - 1);
    return row * ROWS + column;
}

/* Of a triangle (Van Oosterom & Strackee 1983). */
static double solid_angle(dvec3 a, dvec3 b, dvec3 c)
{
    double ra = d3_length(a), rb = d3_length(b), rc = d3_length(c);
    double up = fabs(d3_dot(a, d3_cross(b, c)));
    return 2.0 *
           atan2(up, ra * rb * rc + d3_dot(a, b) * rc + d3_dot(b, c) * ra + d3_dot(c, a) * rb);
}

/* The solid angle of a small triangle, times the pdf of hit() toward its middle. */
static double share(const light *l, dvec3 p, dvec3 a, dvec3 b, dvec3 c)
{
    vvec3 place = vspread(d3_to_float(p));
    vvec3 wi    = vspread(d3_to_float(unit(d3_add(a, d3_add(b, c)))));
    vlight_hit hit;
    l->type->hit(l, &place, &wi, ALL_LANES, &hit);
    return solid_angle(a, b, c) * (double)lane(hit.pdf, 0);
}

/* The share of samples in each cell. All shares are 1. */
static void expect_cells(const light *l, const flat_twin *f, dvec3 p, double *expected)
{
    dvec3 e    = d3_scale(d3_sub(f->corner[1], f->corner[0]), 1.0 / ROWS);
    dvec3 g    = d3_scale(d3_sub(f->corner[f->corners - 1], f->corner[0]), 1.0 / ROWS);
    double sum = 0.0;
    for (int i = 0; i < ROWS * ROWS; i++) {
        int x = i % ROWS, y = i / ROWS;
        dvec3 at    = d3_sub(d3_add(f->corner[0], d3_add(d3_scale(e, x), d3_scale(g, y))), p);
        dvec3 right = d3_add(at, e), up = d3_add(at, g);
        bool whole = f->corners == 4 || x + y < ROWS - 1, part = whole || x + y == ROWS - 1;
        expected[i] = (part ? share(l, p, at, right, up) : 0.0) +
                      (whole ? share(l, p, right, d3_add(right, g), up) : 0.0);
        sum += expected[i];
        expected[i] *= SHOTS;
    }
    assert_near(sum, 1.0, 1e-3);
}

double light_follows_its_pdf(const light *l, const flat_twin *f, dvec3 p)
{
    static double expected[ROWS * ROWS];
    static int count[ROWS * ROWS];
    vvec3 place = vspread(d3_to_float(p));
    int missed  = 0;
    expect_cells(l, f, p, expected);
    for (int i = 0; i < ROWS * ROWS; i++)
        count[i] = 0;
    for (int k = 0; k < SHOTS; k += LANES) {
        vuint seed = vhash(vunsigned(vlane_index() + k)); /* independent, not stratified */
        vfloat s   = vto_float(vsigned(seed >> 8)) * 0x1p-24f;
        vfloat t   = vto_float(vsigned(vhash(seed + 7) >> 8)) * 0x1p-24f;
        vlight_sample q;
        vlight_hit hit;
        vmask lit = light_sample(l, &place, s, t, ALL_LANES, &q);
        vmask met = l->type->hit(l, &place, &q.wi, lit, &hit);
        assert_true(vall(lit));
        for (int i = 0; i < LANES; i++) {
            dvec3 wi = { (double)lane(q.wi.x, i), (double)lane(q.wi.y, i),
                         (double)lane(q.wi.z, i) };
            count[cell_of(f, d3_add(p, d3_scale(wi, (double)lane(q.dist, i))))]++;
            if (vbits(met) >> i & 1) {
                assert_near(lane(hit.pdf, i), lane(q.pdf, i), 2e-5);
                assert_near(lane(hit.dist, i), lane(q.dist, i), 2e-5);
                assert_near(lane(hit.radiance.x, i), 1.0, 0.0);
            } else
                missed++; /* on an edge, to rounding */
        }
    }
    assert_true(missed < SHOTS / 500);
    return chi_square_test(expected, count, ROWS * ROWS);
}

/* ---- checks ----------------------------------------------------------------------------- */

/* Of the plane's height by rounding, and all that follows: absolute, W/m^2. */
static double height_rounding(const flat_twin *f, dvec3 p)
{
    double size = twin_size(f), d = d3_length(d3_sub(twin_centre(f), p));
    return 2e-7 * fmin(size * size / (d * d), M_PI);
}

void check_closed_form(twin_maker make, double near_, double far)
{
    uint32_t state = 17;
    for (int i = 0; i < 1000; i++) {
        arena a = { 0 };
        flat_twin f;
        const light *l = make(&a, &state, &f);
        dvec3 p, n;
        twin_place(&f, near_, far, &state, &p, &n);
        double got = light_closed_form(l, p, n), want = twin_irradiance(&f, p, n);
        double tolerance = 1e-5 * twin_facing(&f, p) + height_rounding(&f, p);
        if (!(fabs(got - want) <= tolerance))
            fail_msg("place %d: E is %.9g, not %.9g +- %.2g", i, got, want, tolerance);
        arena_clear(&a);
    }
}

void check_sampled(twin_maker make, double near_, double far)
{
    uint32_t state = 23;
    for (int i = 0; i < 1000; i++) {
        arena a = { 0 };
        flat_twin f;
        const light *l = make(&a, &state, &f);
        dvec3 p, n;
        twin_place(&f, near_, far, &state, &p, &n);
        double got = light_sampled(l, p, n, 64, (uint32_t)i), want = twin_irradiance(&f, p, n);
        double tolerance = 5e-3 * twin_facing(&f, p);
        if (!(fabs(got - want) <= tolerance))
            fail_msg("place %d: E is %.9g, not %.9g +- %.2g", i, got, want, tolerance);
        arena_clear(&a);
    }
}

/* A random tilt, or one whose horizon goes through the centre. */
static dvec3 tilt(const flat_twin *f, dvec3 p, bool cut, uint32_t *state)
{
    dvec3 n = twin_direction(state), c = unit(d3_sub(twin_centre(f), p));
    if (cut)
        n = unit(d3_sub(n, d3_scale(c, d3_dot(n, c))));
    return d3_rounded(n);
}

void check_as_point(twin_maker make)
{
    enum { PLACES = 200, TILTS = 12 };
    uint32_t state = 29;
    double used    = 0.0;
    int known      = 0;
    for (int i = 0; i < PLACES; i++) {
        arena a = { 0 };
        flat_twin f;
        const light *l = make(&a, &state, &f);
        dvec3 p, n;
        twin_place(&f, 1.5, 100.0, &state, &p, &n);
        vvec3 place = vspread(d3_to_float(p));
        vlight_sample s;
        vfloat bound;
        assert_true(vall(l->type->as_point(l, &place, ALL_LANES, &s, &bound)));
        dvec3 e     = { (double)lane(s.wi.x, 0), (double)lane(s.wi.y, 0), (double)lane(s.wi.z, 0) };
        double most = 0.0;
        for (int k = 0; k < TILTS; k++) {
            n          = tilt(&f, p, k % 2, &state);
            double got = fmax(d3_dot(e, n), 0.0) * (double)lane(s.e.x, 0);
            most       = fmax(most, fabs(got - twin_quadrature(&f, p, n, 24)));
        }
        if (!(most <= (double)lane(bound, 0)))
            fail_msg("place %d: off by %g, bound %g", i, most, (double)lane(bound, 0));
        if (lane(bound, 0) < INFINITY)
            used += most / (double)lane(bound, 0), known++;
        arena_clear(&a);
    }
    assert_true(known > PLACES / 2);
    assert_true(used / known > 0.25);
}

void check_weight(twin_maker make)
{
    uint32_t state = 31;
    for (int i = 0; i < 1000; i++) {
        arena a = { 0 };
        flat_twin f;
        const light *l = make(&a, &state, &f);
        dvec3 p, n;
        twin_place(&f, 0.01, 100.0, &state, &p, &n);
        vvec3 place = vspread(d3_to_float(p)), normal = vspread(d3_to_float(n));
        double w = (double)lane(l->type->weight(l, &place, &normal, ALL_LANES), 0);
        double e = twin_irradiance(&f, p, n);
        assert_true(w > 0.0 && w < 7.0 && w > 0.01 * e);
        arena_clear(&a);
    }
}

void check_near(const light *l, const flat_twin *f, dvec3 at, dvec3 up, double tolerance)
{
    const double heights[] = { 1.0, 1e-3, 1e-6, 0.0 };
    uint32_t state         = 37;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 40; k++) {
            dvec3 p  = d3_rounded(d3_add(at, d3_scale(up, heights[i])));
            dvec3 n  = d3_rounded(k ? twin_direction(&state) : d3_scale(up, -1.0));
            double e = light_closed_form(l, p, n), s = light_sampled(l, p, n, 1024, (uint32_t)k);
            double want = twin_irradiance(f, p, n);
            assert_true(e >= 0.0 && e <= M_PI && s >= 0.0);
            if (heights[i] > 0.0) {
                double close = M_PI * (1e-5 + 1e-7 / heights[i]);
                if (!(fabs(e - want) <= close && fabs(s - want) <= tolerance * M_PI))
                    fail_msg("at %g %g, %g m above: %g in closed form, %g by samples, not %g", at.x,
                             at.y, heights[i], e, s, want);
            }
            if (k == 0)
                assert_true(s <= M_PI * (1.0 + tolerance));
        }
}

void check_lanes(const light *l, dvec3 lit, const dvec3 *behind)
{
    vvec3 p = vspread(d3_to_float(lit)), back = vspread(d3_to_float(behind ? *behind : lit));
    vmask one = vlane_index() < 1, none = ~ALL_LANES;
    for (int k = 0; k < 2; k++) {
        const vvec3 *at = k ? &back : &p;
        vmask asked     = k && behind ? ALL_LANES : one;
        vmask want      = k ? none : one;
        vlight_sample s, c;
        vlight_hit h;
        vfloat bound;
        vmask drawn = light_sample(l, at, vsplat(0.3f), vsplat(0.6f), asked, &s);
        vvec3 n     = k ? vspread((vec3){ 0, 0, 1 }) : s.wi;
        if (k && !behind)
            break;
        vmask met     = l->type->hit(l, at, &n, asked, &h);
        vmask far     = l->type->as_point(l, at, asked, &c, &bound);
        vrgb e        = l->type->irradiance(l, at, &n, asked);
        vfloat weight = l->type->weight(l, at, &n, asked);
        assert_int_equal(vbits(drawn), vbits(want));
        assert_int_equal(vbits(met), vbits(want));
        assert_int_equal(vbits(far), vbits(want));
        const vfloat all[] = { s.wi.x, s.dist, s.e.y, s.pdf, h.dist, h.radiance.z, h.pdf,
                               c.wi.y, c.dist, c.e.x, c.pdf, bound,  e.x,          weight };
        for (size_t q = 0; q < sizeof all / sizeof *all; q++)
            for (int i = k ? 0 : 1; i < LANES; i++)
                assert_true(lane(all[q], i) == 0.0f);
    }
}
