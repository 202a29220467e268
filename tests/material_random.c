/* tests/material_random.c -- materials in random directions: see material_checks.h. */
#include "core/sampler.h"
#include "tests/material_checks.h"
#include "tests/material_points.h"

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
static double random_unit(random_numbers *r)
{
    double kind = next(r), u = next(r);
    return kind < 0.05 ? 0.0 : kind < 0.1 ? 0x1.fffffep-1 : u * 0x1.fffffep-1;
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
                            .look     = look_plain(m) };
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
