/* tests/material_checks.c -- see material_checks.h. */
#include "tests/material_checks.h"

#include "core/sampler.h"
#include "tests/test.h"

#include <stdio.h>

static const double pi = 3.14159265358979324;

/* ---- asking ---------------------------------------------------------------------------------- */

typedef struct dir {
    double x, y, z;
} dir;

static vvec3 spread(dir d) { return vspread((vec3){ (float)d.x, (float)d.y, (float)d.z }); }

static dir lane_dir(const vvec3 *v, int i)
{
    return (dir){ (double)lane(v->x, i), (double)lane(v->y, i), (double)lane(v->z, i) };
}

static double lane_channel(const vrgb *v, int i, int channel)
{
    return (double)(channel == 0 ? lane(v->x, i) : channel == 1 ? lane(v->y, i) : lane(v->z, i));
}

static vlook white_look(const material *m)
{
    const material_look *l = &m->look;
    return (vlook){ .color           = vspread(l->color),
                    .emission        = vspread(l->emission),
                    .specular        = vspread(l->specular),
                    .openness        = vsplat(l->openness),
                    .metallic        = vsplat(l->metallic),
                    .roughness       = vsplat(l->roughness),
                    .transmission    = vsplat(l->transmission),
                    .specular_weight = vsplat(l->specular_weight) };
}

static vshading seen_from(const material *m, dir wo)
{
    vvec3 n = vspread((vec3){ 0, 0, wo.z < 0.0 ? -1.0f : 1.0f });
    return (vshading){ .wo       = spread(wo),
                       .n        = n,
                       .flat     = n,
                       .front    = n.z > 0.0f,
                       .distance = vsplat(1.0f),
                       .look     = white_look(m) };
}

static dir direction(double theta_deg, double phi_deg, bool front)
{
    double theta = theta_deg * pi / 180.0, phi = phi_deg * pi / 180.0;
    double z = cos(theta);
    return (dir){ sin(theta) * cos(phi), sin(theta) * sin(phi), front ? z : -z };
}

vshading material_seen_from(const material *m, double theta_deg, double phi_deg, bool front)
{
    return seen_from(m, direction(theta_deg, phi_deg, front));
}

/* Independent numbers in [0,1). */
static vfloat even(uint32_t n, uint32_t seed)
{
    vuint bits = vhash_combine(vsplat_uint(seed), vunsigned(vlane_index()) + n);
    return vto_float(vsigned(bits >> 8)) * 0x1p-24f;
}

/* ---- polar coordinates about an axis ---------------------------------------------------------
 *
 * The angle from the axis is pi x^4, x in [0, 1]: at x = 0.13 it is 1 mrad.
 */

typedef struct polar {
    dir axis, u, v;
} polar;

/* About the mirror direction of wo, or about the one straight on. */
static polar polar_about(dir wo, bool transmitted)
{
    dir a         = { -wo.x, -wo.y, transmitted ? -wo.z : wo.z };
    double length = sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    a             = (dir){ a.x / length, a.y / length, a.z / length };

    double sign = copysign(1.0, a.z), b = -1.0 / (sign + a.z);
    return (polar){ a,
                    { 1.0 + sign * a.x * a.x * b, sign * a.x * a.y * b, -sign * a.x },
                    { a.x * a.y * b, sign + a.y * a.y * b, -a.y } };
}

static dir polar_direction(const polar *p, double x, double phi)
{
    double alpha = pi * x * x * x * x;
    double c = cos(alpha), s = sin(alpha), su = s * cos(phi), sv = s * sin(phi);
    return (dir){ c * p->axis.x + su * p->u.x + sv * p->v.x,
                  c * p->axis.y + su * p->u.y + sv * p->v.y,
                  c * p->axis.z + su * p->u.z + sv * p->v.z };
}

/* sr: of a cell of that width in x and phi. */
static double polar_solid_angle(double x, double dx, double dphi)
{
    double alpha = pi * x * x * x * x;
    return 4.0 * pi * x * x * x * sin(alpha) * dx * dphi;
}

static void polar_of(const polar *p, dir d, double *x, double *phi)
{
    double c  = d.x * p->axis.x + d.y * p->axis.y + d.z * p->axis.z;
    double su = d.x * p->u.x + d.y * p->u.y + d.z * p->u.z;
    double sv = d.x * p->v.x + d.y * p->v.y + d.z * p->v.z;
    *x        = pow(atan2(hypot(su, sv), c) / pi, 0.25);
    *phi      = atan2(sv, su);
    *phi += *phi < 0.0 ? 2.0 * pi : 0.0;
}

/* ---- quadrature of reflect() on one side of the surface ---------------------------------------
 */

enum { ROWS = 16, COLUMNS = 32, FINE = 24, CELLS = ROWS * COLUMNS };

/* The energy (if not NULL), and the integral of the pdf over each of ROWS * COLUMNS cells in polar
 * coordinates: FINE * FINE points in each. */
static void integrate(const material *m, dir wo, bool transmitted, double *rgb, double *share)
{
    const double dx = 1.0 / (ROWS * FINE), dphi = 2.0 * pi / (COLUMNS * FINE);
    vshading s  = seen_from(m, wo);
    polar about = polar_about(wo, transmitted);
    double sign = (wo.z < 0.0) == transmitted ? 1.0 : -1.0; /* of the z that count */
    for (int i = 0; i < ROWS * FINE; i++) {
        double x = (i + 0.5) * dx, omega = polar_solid_angle(x, dx, dphi);
        for (int j = 0; j < COLUMNS * FINE; j += LANES) {
            float to[3][LANES];
            for (int k = 0; k < LANES; k++) {
                dir d    = polar_direction(&about, x, (j + k + 0.5) * dphi);
                to[0][k] = (float)d.x;
                to[1][k] = (float)d.y;
                to[2][k] = (float)d.z;
            }
            vvec3 wi     = { vload(to[0]), vload(to[1]), vload(to[2]) };
            vmask inside = wi.z * (float)sign > 0.0f;
            if (!vany(inside))
                continue;
            vfloat pdf;
            vrgb f = materials_reflect(&m, vsplat_int(0), &s, &wi, inside, &pdf);
            for (int k = 0; k < LANES; k++) {
                for (int c = 0; c < 3; c++)
                    rgb[c] += omega * lane_channel(&f, k, c);
                share[i / FINE * COLUMNS + (j + k) / FINE] += omega * (double)lane(pdf, k);
            }
        }
    }
}

/* ---- what scatter() draws ---------------------------------------------------------------------
 */

enum { ROUNDS = 16, DRAWS = 4096 };

/* The mean weight of one round, on either side; of single directions alone, and of those straight
 * on. */
typedef struct drawn {
    energy all, single;
    double straight[3];
} drawn;

static void draw_round(const material *m, const vshading *s, uint32_t seed, drawn *d)
{
    *d = (drawn){ 0 };
    for (uint32_t i = 0; i < DRAWS; i += LANES) {
        vscatter out;
        vsample4 p = vsobol4(vunsigned(vlane_index()) + i, vsplat_uint(seed));
        vmask goes = materials_scatter(&m, vsplat_int(0), s, p.x, p.y, p.z, ALL_LANES, &out);
        vmask back = vdot(out.wi, s->n) > 0.0f;
        for (int k = 0; k < LANES; k++)
            for (int c = 0; c < 3 && (lane(goes, k) & 1); c++) {
                double w    = lane_channel(&out.weight, k, c) / DRAWS;
                bool single = lane(out.pdf, k) == INFINITY;
                bool up     = lane(back, k) & 1;
                *(up ? &d->all.reflected[c] : &d->all.transmitted[c]) += w;
                if (single)
                    *(up ? &d->single.reflected[c] : &d->single.transmitted[c]) += w;
                if (lane(out.straight, k) & 1)
                    d->straight[c] += w;
            }
    }
}

typedef struct estimate {
    double mean, error; /* standard error of the mean */
} estimate;

/* Of one figure of each round. */
static estimate over_rounds(const drawn *rounds, const double *of_first)
{
    double sum = 0.0, squares = 0.0;
    size_t offset = (size_t)((const char *)of_first - (const char *)rounds);
    for (int r = 0; r < ROUNDS; r++)
        sum += *(const double *)(const void *)((const char *)(rounds + r) + offset);
    double mean = sum / ROUNDS;
    for (int r = 0; r < ROUNDS; r++) {
        double x = *(const double *)(const void *)((const char *)(rounds + r) + offset);
        squares += (x - mean) * (x - mean);
    }
    return (estimate){ mean, sqrt(squares / (ROUNDS * (ROUNDS - 1))) };
}

static void draw_rounds(const material *m, const vshading *s, drawn rounds[ROUNDS])
{
    for (uint32_t r = 0; r < ROUNDS; r++)
        draw_round(m, s, r, &rounds[r]);
}

static energy integral(const material *m, dir wo, const drawn *rounds)
{
    energy e            = { 0 };
    double share[CELLS] = { 0 };
    integrate(m, wo, false, e.reflected, share);
    integrate(m, wo, true, e.transmitted, share);
    for (int c = 0; c < 3; c++) {
        e.reflected[c] += over_rounds(rounds, &rounds->single.reflected[c]).mean;
        e.transmitted[c] += over_rounds(rounds, &rounds->single.transmitted[c]).mean;
    }
    return e;
}

energy material_albedo_integral(const material *m, double theta_deg, double phi_deg, bool front)
{
    drawn rounds[ROUNDS];
    dir wo     = direction(theta_deg, phi_deg, front);
    vshading s = seen_from(m, wo);
    draw_rounds(m, &s, rounds);
    return integral(m, wo, rounds);
}

/* ---- the white furnace ------------------------------------------------------------------------
 */

/* The mean weight has a standard error of its own, of 15 degrees of freedom: t = 6.5 is passed once
 * in 10^5. Quadrature and albedo share 1e-3. */
static void expect_weight(const material *m, const char *where, const char *what,
                          const drawn *rounds, const double *figure, double want)
{
    estimate e = over_rounds(rounds, figure);
    if (!(fabs(e.mean - want) <= 1e-3 + 6.5 * e.error))
        fail_msg("%s, %s: %s by scatter() is %.6f +- %.6f, not %.6f", m->type->name, where, what,
                 e.mean, e.error, want);
}

static void check_furnace_at(const material *m, double theta, bool front)
{
    char where[64];
    snprintf(where, sizeof where, "%g deg on its %s", theta, front ? "front" : "back");
    drawn rounds[ROUNDS];
    dir wo     = direction(theta, 20, front);
    vshading s = seen_from(m, wo);
    draw_rounds(m, &s, rounds);
    energy e     = integral(m, wo, rounds);
    vrgb albedo  = materials_albedo(&m, vsplat_int(0), &s, ALL_LANES);
    vrgb through = materials_through(&m, vsplat_int(0), &s, ALL_LANES);
    for (int c = 0; c < 3; c++) {
        double a = lane_channel(&albedo, 0, c), sum = e.reflected[c] + e.transmitted[c];
        if (!(a >= 0.0 && a <= 1.0 + 1e-5))
            fail_msg("%s, %s: an albedo of %.7f", m->type->name, where, a);
        if (!(sum <= 1.0 + 1e-3))
            fail_msg("%s, %s: %.6f of the light leaves", m->type->name, where, sum);
        if (!(fabs(a - e.reflected[c]) <= 1e-3))
            fail_msg("%s, %s: albedo() is %.6f, its integral %.6f", m->type->name, where, a,
                     e.reflected[c]);
        expect_weight(m, where, "reflected", rounds, &rounds->all.reflected[c], e.reflected[c]);
        expect_weight(m, where, "let through", rounds, &rounds->all.transmitted[c],
                      e.transmitted[c]);
        if (!m->solid)
            expect_weight(m, where, "straight on", rounds, &rounds->straight[c],
                          lane_channel(&through, 0, c));
    }
}

void material_check_furnace(const material *m)
{
    static const double theta[] = { 0, 30, 60, 80, 89, 89.99 };
    for (size_t i = 0; i < sizeof theta / sizeof *theta; i++) {
        check_furnace_at(m, theta[i], true);
        check_furnace_at(m, theta[i], false);
    }
}

/* ---- sampling against the pdf ------------------------------------------------------------------
 */

static void check_against_reflect(const material *m, const vshading *s, const vscatter *out,
                                  vmask wide)
{
    vfloat pdf;
    vrgb f = materials_reflect(&m, vsplat_int(0), s, &out->wi, wide, &pdf);
    for (int k = 0; k < LANES; k++) {
        if (!(lane(wide, k) & 1))
            continue;
        double said = (double)lane(out->pdf, k), is = (double)lane(pdf, k);
        if (!(is > 0.0 && fabs(said - is) <= 1e-4 * is))
            fail_msg("%s: scatter() says a pdf of %.9g, reflect() of %.9g", m->type->name, said,
                     is);
        for (int c = 0; c < 3; c++) {
            double w = lane_channel(&out->weight, k, c), want = lane_channel(&f, k, c) / is;
            if (!(fabs(w - want) <= 1e-4 * want + 1e-7))
                fail_msg("%s: a weight of %.9g, where f cos / pdf is %.9g", m->type->name, w, want);
        }
    }
}

/* The last cell takes what goes to single directions and what is lost. */
static void count_draws(const material *m, dir wo, uint32_t draws, int count[2 * CELLS + 1])
{
    vshading s     = seen_from(m, wo);
    polar about[2] = { polar_about(wo, false), polar_about(wo, true) };
    for (uint32_t n = 0; n < draws; n += LANES) {
        vscatter out;
        vmask goes = materials_scatter(&m, vsplat_int(0), &s, even(n, 1), even(n, 2), even(n, 3),
                                       ALL_LANES, &out);
        vmask wide = goes & (out.pdf < INFINITY);
        check_against_reflect(m, &s, &out, wide);
        vfloat side = vdot(out.wi, s.n);
        for (int k = 0; k < LANES; k++) {
            double x, phi;
            int half = lane(side, k) < 0.0f;
            polar_of(&about[half], lane_dir(&out.wi, k), &x, &phi);
            int row    = (int)fmin(x * ROWS, ROWS - 1);
            int column = (int)fmin(phi / (2.0 * pi) * COLUMNS, COLUMNS - 1);
            count[lane(wide, k) & 1 ? half * CELLS + row * COLUMNS + column : 2 * CELLS]++;
        }
    }
}

static void check_sampling_at(const material *m, double theta, bool front)
{
    enum { SAMPLES = 1 << 17 };
    dir wo                         = direction(theta, 30, front);
    double rgb[3]                  = { 0 };
    double expected[2 * CELLS + 1] = { 0 }, sum = 0.0;
    int count[2 * CELLS + 1] = { 0 };
    integrate(m, wo, false, rgb, expected);
    integrate(m, wo, true, rgb, expected + CELLS);
    for (int i = 0; i < 2 * CELLS; i++)
        sum += expected[i];
    if (!(sum <= 1.0 + 1e-3))
        fail_msg("%s at %g deg: the pdf's integral is %.6f", m->type->name, theta, sum);
    expected[2 * CELLS] = fmax(1.0 - sum, 0.0);
    for (int i = 0; i <= 2 * CELLS; i++)
        expected[i] *= SAMPLES / fmax(sum, 1.0);

    count_draws(m, wo, SAMPLES, count);
    double chance = chi_square_test(expected, count, 2 * CELLS + 1);
    if (!(chance > 1e-5))
        fail_msg("%s at %g deg on its %s: directions follow their pdf with a chance of %g",
                 m->type->name, theta, front ? "front" : "back", chance);
}

void material_check_sampling(const material *m)
{
    static const double theta[] = { 0, 45, 80, 89 };
    for (size_t i = 0; i < sizeof theta / sizeof *theta; i++) {
        check_sampling_at(m, theta[i], true);
        check_sampling_at(m, theta[i], false);
    }
}

/* ---- reciprocity -------------------------------------------------------------------------------
 */

typedef struct random_numbers {
    uint32_t state;
} random_numbers;

static double next(random_numbers *r) { return hash_u32(r->state++) * 0x1p-32; }

/* Every third time all but along the surface. */
static dir random_direction(random_numbers *r)
{
    double kind = next(r), z = 2.0 * next(r) - 1.0, phi = 2.0 * pi * next(r);
    z           = kind < 1.0 / 3.0 ? z * z * z * 0.01 : z;
    double side = sqrt(1.0 - z * z);
    return (dir){ side * cos(phi), side * sin(phi), z };
}

/* Half of the time near where mirrors and panes send wo, at 1e-4 to 1 rad. */
static dir random_partner(random_numbers *r, dir wo)
{
    if (next(r) < 0.5)
        return random_direction(r);
    polar about = polar_about(wo, next(r) < 0.25);
    double x    = pow(pow(10.0, -4.0 * next(r)) / pi, 0.25);
    return polar_direction(&about, x, 2.0 * pi * next(r));
}

static vrgb density_between(const material *m, dir wo, dir wi)
{
    vshading s = seen_from(m, wo);
    vvec3 to   = spread(wi);
    vrgb f     = materials_reflect(&m, vsplat_int(0), &s, &to, ALL_LANES, NULL);
    return vscale(f, 1.0f / vabs(to.z));
}

void material_check_reciprocity(const material *m, double tolerance)
{
    random_numbers r = { 7 };
    for (int i = 0; i < 20000; i++) {
        dir wo = random_direction(&r), wi = random_partner(&r, wo);
        if (fabs(wo.z) < 1e-6 || fabs(wi.z) < 1e-6)
            continue;
        vrgb there = density_between(m, wo, wi), back = density_between(m, wi, wo);
        for (int c = 0; c < 3; c++) {
            double a = lane_channel(&there, 0, c), b = lane_channel(&back, 0, c);
            if (!(fabs(a - b) <= tolerance * fmax(a, b) + 1e-30))
                fail_msg("%s: from (%.7f %.7f %.7f) to (%.7f %.7f %.7f) f is %.9g, back %.9g",
                         m->type->name, wi.x, wi.y, wi.z, wo.x, wo.y, wo.z, a, b);
        }
    }
}

/* ---- packets ------------------------------------------------------------------------------------
 */

/* [0, 1), its ends included, as samplers give it. */
static float random_unit(random_numbers *r)
{
    double kind = next(r), u = next(r);
    return kind < 0.05 ? 0.0f : kind < 0.1 ? 0x1.fffffep-1f : (float)(u * 0x1.fffffep-1);
}

static dir plus(dir a, double t, dir b)
{
    return (dir){ a.x + t * b.x, a.y + t * b.y, a.z + t * b.z };
}

/* About the normal n: along the surface to within a rounding, along the normal, at random. */
static dir direction_about(random_numbers *r, dir n)
{
    dir d       = random_direction(r);
    double kind = next(r);
    if (kind < 0.1)
        return n;
    double up   = d.x * n.x + d.y * n.y + d.z * n.z;
    dir t       = kind < 0.3 ? plus(d, -up, n) : d;
    double size = sqrt(t.x * t.x + t.y * t.y + t.z * t.z);
    return (dir){ t.x / size, t.y / size, t.z / size };
}

/* One point in each lane, NaN in masked ones. */
typedef struct points {
    vshading s;
    vvec3 wi;
    vfloat u, v, pick;
    vmask active;
} points;

enum { WO, NORMAL, FLAT, WI, UV, FIELDS };

static void set3(float table[3][LANES], int k, dir d, bool nan)
{
    table[0][k] = nan ? NAN : (float)d.x;
    table[1][k] = nan ? NAN : (float)d.y;
    table[2][k] = nan ? NAN : (float)d.z;
}

static vvec3 load3(float table[3][LANES])
{
    return (vvec3){ vload(table[0]), vload(table[1]), vload(table[2]) };
}

static void random_points(const material *m, random_numbers *r, points *p)
{
    float at[FIELDS][3][LANES], distance[LANES];
    int32_t active[LANES], front[LANES];
    for (int k = 0; k < LANES; k++) {
        dir axis  = { 0, 0, next(r) < 0.5 ? 1 : -1 };
        dir n     = next(r) < 0.3 ? axis : random_direction(r);
        dir wo    = direction_about(r, n);
        double up = wo.x * n.x + wo.y * n.y + wo.z * n.z;
        wo        = up < 0.0 ? (dir){ -wo.x, -wo.y, -wo.z } : wo;
        dir wi    = direction_about(r, n);
        wi        = next(r) < 0.2 ? (dir){ -wo.x, -wo.y, -wo.z } : wi;
        wi        = next(r) < 0.2 ? plus(n, 2.0 * fabs(up) - 1.0, plus(n, -1.0, wo)) : wi;
        active[k] = next(r) < 0.7 ? -1 : 0;
        front[k]  = next(r) < 0.5 ? -1 : 0;
        bool nan  = !active[k];
        set3(at[WO], k, wo, nan);
        set3(at[NORMAL], k, n, nan);
        set3(at[FLAT], k, n, nan);
        set3(at[WI], k, wi, nan);
        set3(at[UV], k, (dir){ random_unit(r), random_unit(r), random_unit(r) }, nan);
        distance[k] = nan ? NAN : (float)pow(10.0, 6.0 * next(r) - 4.0);
    }
    p->active = vload_int(active);
    p->wi     = load3(at[WI]);
    p->u      = vload(at[UV][0]);
    p->v      = vload(at[UV][1]);
    p->pick   = vload(at[UV][2]);
    p->s      = (vshading){ .wo       = load3(at[WO]),
                            .n        = load3(at[NORMAL]),
                            .flat     = load3(at[FLAT]),
                            .front    = vload_int(front),
                            .distance = vload(distance),
                            .look     = white_look(m) };
}

static void expect_number(const material *m, const char *what, bool active, double value,
                          double most)
{
    if (!active && !(value == 0.0))
        fail_msg("%s: %s is %g in a masked lane", m->type->name, what, value);
    if (!(value >= 0.0 && value <= most))
        fail_msg("%s: %s is %g", m->type->name, what, value);
}

static void expect_channels(const material *m, const char *what, vmask active, const vrgb *rgb,
                            double most)
{
    for (int k = 0; k < LANES; k++)
        for (int c = 0; c < 3; c++)
            expect_number(m, what, lane(active, k) & 1, lane_channel(rgb, k, c), most);
}

static void check_scattered(const material *m, const points *p)
{
    static const double finite = 3.4e38;
    vscatter out;
    vmask goes = materials_scatter(&m, vsplat_int(0), &p->s, p->u, p->v, p->pick, p->active, &out);
    if (vany(goes & ~p->active) || vany((out.straight | out.bent) & ~p->active))
        fail_msg("%s: a masked lane goes on", m->type->name);
    expect_channels(m, "a weight", goes, &out.weight, finite);
    for (int k = 0; k < LANES; k++) {
        dir wi = lane_dir(&out.wi, k), wo = lane_dir(&p->s.wo, k);
        double length = sqrt(wi.x * wi.x + wi.y * wi.y + wi.z * wi.z);
        bool active = lane(p->active, k) & 1, going = lane(goes, k) & 1;
        expect_number(m, "a pdf", active, (double)lane(out.pdf, k), HUGE_VAL);
        expect_number(m, "a direction's length", active, length, 1.0 + 1e-5);
        if (going && !(length > 1.0 - 1e-5))
            fail_msg("%s: a direction's length is %.7f", m->type->name, length);
        if (going && !((double)lane(out.pdf, k) > 0.0))
            fail_msg("%s: goes on with a pdf of 0", m->type->name);
        if (going && (lane(out.straight, k) & 1) &&
            (wi.x != -wo.x || wi.y != -wo.y || wi.z != -wo.z))
            fail_msg("%s: straight on is not -wo", m->type->name);
    }
}

static void check_asked(const material *m, const points *p)
{
    static const double finite = 3.4e38, whole = 1.0 + 1e-5;
    vint index   = vsplat_int(0);
    vfloat pdf   = { 0 };
    vrgb f       = materials_reflect(&m, index, &p->s, &p->wi, p->active, &pdf);
    vrgb albedo  = materials_albedo(&m, index, &p->s, p->active);
    vrgb through = materials_through(&m, index, &p->s, p->active);
    expect_channels(m, "f cos", p->active, &f, finite);
    expect_channels(m, "an albedo", p->active, &albedo, whole);
    expect_channels(m, "what goes through", p->active, &through, whole);
    for (int k = 0; k < LANES; k++)
        expect_number(m, "reflect()'s pdf", lane(p->active, k) & 1, (double)lane(pdf, k), finite);
}

void material_check_packets(const material *m)
{
    random_numbers r = { 11 };
    points p;
    for (int i = 0; i < 100000; i += LANES) {
        random_points(m, &r, &p);
        check_scattered(m, &p);
        check_asked(m, &p);
    }
}
