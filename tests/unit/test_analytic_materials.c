/* tests/unit/test_analytic_materials.c -- materials that are formulae, in packets, against the same
 * formulae written out in double: 10^6 points with random normals, of which a third are seen along
 * the surface (to 1e-6 rad) and a third along the normal.
 *
 * Tolerances: 1e-5 of the value, and what becomes of it if directions change by a rounding: `step`
 * of a cosine or of a chord, for directions are floats, unit to 2^-23.
 */
#include "core/sampler.h"
#include "materials/material.h"
#include "tests/test.h"

static const double pi = 3.14159265358979324, step = 4e-7;

/* ---- vectors in double
 * --------------------------------------------------------------------------- */

typedef struct d3 {
    double x, y, z;
} d3;

static double dot(d3 a, d3 b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
static d3 plus(d3 a, double t, d3 b) { return (d3){ a.x + t * b.x, a.y + t * b.y, a.z + t * b.z }; }
static d3 unit(d3 a)
{
    double size = sqrt(dot(a, a));
    return (d3){ a.x / size, a.y / size, a.z / size };
}
static d3 mirrored(d3 wo, d3 n) { return plus((d3){ -wo.x, -wo.y, -wo.z }, 2 * dot(wo, n), n); }

/* ---- formulae
 * ------------------------------------------------------------------------------------- */

/* A figure and how far it may be off for the roundings of directions. */
typedef struct figure {
    double value, slack;
} figure;

typedef struct point {
    d3 wo, wi, n;
    double distance, chance; /* chance: of a lobe, by what the packet's albedo() says of it */
    bool front;
} point;

typedef struct answers {
    figure f[3], pdf; /* f cos */
    figure through[3], albedo[3];

    bool single, mirrors_first; /* goes to single directions; which part small picks choose */
    figure first;               /* the share of picks that choose it */
    d3 passed;                  /* where what is not mirrored goes */
    double passed_slack, mirror_weight[3], passed_weight[3];
} answers;

static const double matt[3] = { 0.5, 0.25, 0 }, specular[3] = { 0.5, 0.5, 1 };
static const double share[3] = { 0.875, 0.5, 0.125 }, absorption[3] = { 0, 0.5, 4 };
static const double ior = 1.5;

static void diffuse(const point *p, double unused, answers *a)
{
    (void)unused;
    double cosine = fmax(dot(p->wi, p->n), 0.0);
    a->pdf        = (figure){ cosine / pi, step };
    for (int c = 0; c < 3; c++) {
        a->f[c]      = (figure){ share[c] * cosine / pi, step };
        a->albedo[c] = (figure){ share[c], 0 };
    }
}

/* cos^n of the angle between wi and r; its slope is that along the chord. */
static figure lobe(double exponent, d3 wi, d3 r)
{
    d3 apart     = plus(wi, -1.0, r);
    double chord = sqrt(dot(apart, apart)), cosine = 1.0 - 0.5 * chord * chord;
    double near = chord - step, least = 1.0 - 0.5 * near * near; /* of the chord, and its cosine */
    double value = cosine > 0.0 ? exp(exponent * log1p(-0.5 * chord * chord)) : 0.0;
    double most  = least > 0.0 ? exp(exponent * log1p(-0.5 * near * near)) : 0.0;
    return (figure){ value, chord > step ? most - value : 1.0 - value };
}

static void phong(const point *p, double n, answers *a)
{
    double cosine = dot(p->wi, p->n);
    d3 r          = mirrored(p->wo, p->n);
    figure near   = lobe(n, p->wi, r);
    figure folded = lobe(n, plus(p->wi, -2.0 * cosine, p->n), r);
    double scale = (n + 2) / (2 * pi), lit = cosine > 0.0 ? 1.0 : 0.0;
    for (int c = 0; c < 3; c++) {
        double f      = matt[c] / pi + specular[c] * scale * near.value;
        a->f[c].value = lit * f * cosine;
        a->f[c].slack = f * step + specular[c] * scale * near.slack * fabs(cosine);
        a->albedo[c]  = (figure){ 0, 1 }; /* the furnace sees to it */
    }
    double drawn = p->chance * (n + 1) / (2 * pi);
    double pdf   = drawn * (near.value + folded.value) + (1.0 - p->chance) * fabs(cosine) / pi;
    a->pdf.value = lit * pdf;
    a->pdf.slack = step + drawn * (near.slack + folded.slack);
    a->pdf.slack += fabs(cosine) < step ? pdf : 0.0; /* above or below the surface */
}

static void mirror(const point *p, double unused, answers *a)
{
    (void)p, (void)unused;
    a->single = true;
    a->first  = (figure){ 1, 0 };
    for (int c = 0; c < 3; c++) {
        a->mirror_weight[c] = share[c];
        a->albedo[c]        = (figure){ share[c], 0 };
    }
    a->mirrors_first = true;
}

/* Born & Wolf 1.5.2 (21a): s, p; 1 beyond the critical angle. */
static void border(double cos_i, double eta, double *s, double *p, double *cos_t)
{
    double cos2_t = 1.0 - (1.0 - cos_i * cos_i) / (eta * eta);
    *cos_t        = sqrt(fmax(cos2_t, 0.0));
    *s            = pow((cos_i - eta * *cos_t) / (cos_i + eta * *cos_t), 2);
    *p            = pow((eta * cos_i - *cos_t) / (eta * cos_i + *cos_t), 2);
    if (cos2_t <= 0.0)
        *s = *p = 1.0;
}

static double border_reflects(double cos_i, double eta)
{
    double s, p, cos_t;
    border(fmin(fmax(cos_i, 0.0), 1.0), eta, &s, &p, &cos_t);
    return 0.5 * (s + p);
}

static figure around(double (*of)(double, double), double cos_i, double parameter)
{
    double value = of(cos_i, parameter);
    double less = of(cos_i - step, parameter), more = of(cos_i + step, parameter);
    return (figure){ value, fabs(less - value) + fabs(more - value) };
}

static figure scaled(figure a, double by) { return (figure){ a.value * by, a.slack * by }; }

static void dielectric(const point *p, double unused, answers *a)
{
    (void)unused;
    double cos_i = dot(p->wo, p->n), eta = p->front ? ior : 1.0 / ior, s, q, cos_t, near, far;
    figure back    = around(border_reflects, cos_i, eta);
    figure outside = around(border_reflects, cos_i, ior);
    border(fmax(cos_i - step, 0.0), eta, &s, &q, &near);
    border(fmin(cos_i + step, 1.0), eta, &s, &q, &far);
    border(fmin(cos_i, 1.0), eta, &s, &q, &cos_t);
    a->single        = true;
    a->first         = back;
    a->mirrors_first = true;
    d3 along         = plus((d3){ -p->wo.x, -p->wo.y, -p->wo.z }, cos_i, p->n);
    a->passed        = plus((d3){ along.x / eta, along.y / eta, along.z / eta }, -cos_t, p->n);
    a->passed_slack  = far - near;
    for (int c = 0; c < 3; c++) {
        double left         = p->front ? 1.0 : exp(-absorption[c] * p->distance);
        a->mirror_weight[c] = left;
        a->passed_weight[c] = left * share[c];
        a->albedo[c]        = scaled(back, left);
        a->through[c]       = (figure){ share[c] * (1.0 - outside.value), outside.slack };
    }
}

/* A pane of which `whole` passes at normal incidence: the share that passes, and its complement
 * after absorption. */
static double pane_inner(double whole)
{
    double r = pow((ior - 1) / (ior + 1), 2), low = 0.0, high = 1.0;
    for (int i = 0; i < 60; i++) { /* halving: no formula of the library's own */
        double a                                                              = 0.5 * (low + high);
        *((1 - r) * (1 - r) * a / (1 - r * r * a * a) < whole ? &low : &high) = a;
    }
    return low;
}

static void slab(double cos_i, double inner, double *passed, double *reflected)
{
    double r[2], cos_t;
    border(fmin(fmax(cos_i, 1e-9), 1.0), ior, &r[0], &r[1], &cos_t);
    double a = pow(inner, 1.0 / cos_t);
    *passed = *reflected = 0.0;
    for (int i = 0; i < 2; i++) {
        double t = (1 - r[i]) * (1 - r[i]) * a / (1 - r[i] * r[i] * a * a);
        *passed += 0.5 * t;
        *reflected += 0.5 * (r[i] + r[i] * a * t);
    }
}

static double slab_passes(double cos_i, double inner)
{
    double passed, reflected;
    slab(cos_i, inner, &passed, &reflected);
    return passed;
}

static double slab_reflects(double cos_i, double inner)
{
    double passed, reflected;
    slab(cos_i, inner, &passed, &reflected);
    return reflected;
}

static void pane(const point *p, double box, answers *a)
{
    static double inner[3]; /* of the shares */
    for (int c = 0; c < 3 && inner[2] == 0.0; c++)
        inner[c] = pane_inner(share[c]);
    double cos_i = dot(p->wo, p->n), passed = 0, back = 0;
    bool acts = p->front || box == 0.0;
    for (int c = 0; c < 3; c++) {
        a->through[c] = acts ? around(slab_passes, cos_i, inner[c]) : (figure){ 1, 0 };
        a->albedo[c]  = acts ? around(slab_reflects, cos_i, inner[c]) : (figure){ 0, 0 };
        passed += a->through[c].value;
        back += a->albedo[c].value;
    }
    a->single = true;
    a->first  = (figure){ passed / (passed + back),
                          a->through[0].slack + a->through[1].slack + a->through[2].slack };
    a->passed = (d3){ -p->wo.x, -p->wo.y, -p->wo.z };
    for (int c = 0; c < 3; c++) {
        a->passed_weight[c] = a->through[c].value / a->first.value;
        a->mirror_weight[c] = a->albedo[c].value / (1.0 - a->first.value);
    }
}

/* ---- random points
 * --------------------------------------------------------------------------------- */

static uint32_t drawn;

static double next(void) { return hash_u32(drawn++) * 0x1p-32; }

static d3 anywhere(void)
{
    double z = 2.0 * next() - 1.0, phi = 2.0 * pi * next(), side = sqrt(1.0 - z * z);
    return (d3){ side * cos(phi), side * sin(phi), z };
}

/* On n's side: all but along the surface, all but along n, or anywhere. */
static d3 above(d3 n)
{
    d3 d        = anywhere();
    d3 along    = unit(plus(d, -dot(d, n), n));
    double kind = next(), small = pow(10.0, -6.0 * next()), large = sqrt(1.0 - small * small);
    if (kind < 1.0 / 3.0)
        return unit(plus((d3){ along.x * large, along.y * large, along.z * large }, small, n));
    if (kind < 2.0 / 3.0)
        return unit(plus((d3){ along.x * small, along.y * small, along.z * small }, large, n));
    return dot(d, n) < 0.0 ? (d3){ -d.x, -d.y, -d.z } : d;
}

static d3 partner(d3 wo, d3 n)
{
    double kind = next();
    if (kind < 0.1)
        return anywhere();
    if (kind < 0.5)
        return unit(plus(mirrored(wo, n), pow(10.0, -5.0 * next()), anywhere()));
    return above(n);
}

/* Packets of points, and the same in double. */
typedef struct points {
    vshading s;
    vvec3 wi;
    point each[LANES];
} points;

static d3 as_float(d3 a)
{
    return (d3){ (double)(float)a.x, (double)(float)a.y, (double)(float)a.z };
}

static vvec3 spread(const d3 *a)
{
    float x[LANES], y[LANES], z[LANES];
    for (int k = 0; k < LANES; k++) {
        x[k] = (float)a[k].x;
        y[k] = (float)a[k].y;
        z[k] = (float)a[k].z;
    }
    return (vvec3){ vload(x), vload(y), vload(z) };
}

static void draw_points(points *p)
{
    d3 n[LANES], wo[LANES], wi[LANES];
    float distance[LANES];
    int32_t front[LANES];
    for (int k = 0; k < LANES; k++) {
        n[k]        = as_float(anywhere());
        wo[k]       = as_float(above(unit(n[k])));
        wi[k]       = as_float(partner(unit(wo[k]), unit(n[k])));
        distance[k] = (float)pow(10.0, 3.0 * next() - 2.0);
        front[k]    = next() < 0.5 ? -1 : 0;
        p->each[k]  = (point){ .wo       = unit(wo[k]),
                               .wi       = unit(wi[k]),
                               .n        = unit(n[k]),
                               .distance = (double)distance[k],
                               .front    = front[k] };
    }
    p->wi = spread(wi);
    p->s  = (vshading){ .wo       = spread(wo),
                        .n        = spread(n),
                        .flat     = spread(n),
                        .front    = vload_int(front),
                        .distance = vload(distance) };
}

/* ---- packets beside the formulae
 * -------------------------------------------------------------------- */

static double channel(const vrgb *v, int k, int c)
{
    return (double)(c == 0 ? lane(v->x, k) : c == 1 ? lane(v->y, k) : lane(v->z, k));
}

static void expect(const material *m, const char *what, const point *p, double got, figure want)
{
    if (!(fabs(got - want.value) <= 1e-5 * fabs(want.value) + want.slack + 1e-12))
        fail_msg("%s: %s is %.9g, not %.9g (+- %.2g), cos %.9g and %.9g", m->type->name, what, got,
                 want.value, want.slack, dot(p->wo, p->n), dot(p->wi, p->n));
}

static void expect_scattered(const material *m, const point *p, const answers *a,
                             const vscatter *out, int k, double pick)
{
    bool passes  = lane(out->straight | out->bent, k) & 1;
    bool first   = passes != a->mirrors_first;
    double twice = a->first.slack + 1e-5;
    if (first != (pick < a->first.value) && fabs(pick - a->first.value) > twice)
        fail_msg("%s: the wrong part of %.9g is picked by %.9g", m->type->name, a->first.value,
                 pick);
    d3 want = passes ? a->passed : mirrored(p->wo, p->n);
    d3 got = { (double)lane(out->wi.x, k), (double)lane(out->wi.y, k), (double)lane(out->wi.z, k) };
    d3 off = plus(got, -1.0, want);
    expect(m, "a way on is off: that", p, sqrt(dot(off, off)),
           (figure){ 0, 2e-6 + (passes ? a->passed_slack : 0) });
    for (int c = 0; c < 3; c++)
        expect(m, "a weight", p, channel(&out->weight, k, c),
               (figure){ passes ? a->passed_weight[c] : a->mirror_weight[c], 0 });
}

typedef struct twin {
    const material *m;
    void (*answer)(const point *, double, answers *);
    double parameter;
} twin;

static void compare(const twin *t, points *p, double pick)
{
    const material *m = t->m;
    vint index        = vsplat_int(0);
    vscatter out;
    vfloat pdf, some = vsplat(0.5f);
    vrgb f       = materials_reflect(&m, index, &p->s, &p->wi, ALL_LANES, &pdf);
    vrgb albedo  = materials_albedo(&m, index, &p->s, ALL_LANES);
    vrgb through = materials_through(&m, index, &p->s, ALL_LANES);
    materials_scatter(&m, index, &p->s, some, some, vsplat((float)pick), ALL_LANES, &out);
    for (int k = 0; k < LANES; k++) {
        answers a          = { 0 };
        double lobe_albedo = 2.0 * channel(&albedo, k, 2); /* of phong: in all three channels */
        p->each[k].chance  = lobe_albedo / (lobe_albedo + 0.75);
        t->answer(&p->each[k], t->parameter, &a);
        expect(m, "the pdf", &p->each[k], (double)lane(pdf, k), a.pdf);
        for (int c = 0; c < 3; c++) {
            expect(m, "f cos", &p->each[k], channel(&f, k, c), a.f[c]);
            expect(m, "the albedo", &p->each[k], channel(&albedo, k, c), a.albedo[c]);
            expect(m, "what goes through", &p->each[k], channel(&through, k, c), a.through[c]);
        }
        if (a.single)
            expect_scattered(m, &p->each[k], &a, &out, k, pick);
    }
}

static vec3 rgb(const double a[3]) { return (vec3){ (float)a[0], (float)a[1], (float)a[2] }; }

static const material *phong_of(arena *a, float exponent)
{
    phong_desc d = { .reflectance = rgb(matt), .specular = rgb(specular), .exponent = exponent };
    return material_phong(a, &d, NULL);
}

TEST(packets_are_the_formulae_in_double)
{
    enum { POINTS = 1000000, TWINS = 9 };
    arena a                 = { 0 };
    diffuse_desc d          = { .reflectance = rgb(share) };
    mirror_desc reflecting  = { .reflectance = rgb(share) };
    dielectric_desc glass   = { .ior        = (float)ior,
                                .absorption = rgb(absorption),
                                .tint       = rgb(share) };
    pane_desc thin          = { .transmittance = rgb(share), .ior = (float)ior };
    pane_desc box           = { .transmittance = rgb(share), .ior = (float)ior, .box = true };
    const twin twins[TWINS] = { { material_diffuse(&a, &d, NULL), diffuse, 0 },
                                { phong_of(&a, 1), phong, 1 },
                                { phong_of(&a, 20), phong, 20 },
                                { phong_of(&a, 1000), phong, 1000 },
                                { phong_of(&a, 1e6f), phong, 1e6 },
                                { material_mirror(&a, &reflecting, NULL), mirror, 0 },
                                { material_dielectric(&a, &glass, NULL), dielectric, 0 },
                                { material_pane(&a, &thin, NULL), pane, 0 },
                                { material_pane(&a, &box, NULL), pane, 1 } };
    points p;
    for (int i = 0; i < POINTS; i += LANES) {
        draw_points(&p);
        compare(&twins[i / LANES % TWINS], &p, (double)(float)(next() * 0x1.fffffep-1));
    }
    arena_clear(&a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(packets_are_the_formulae_in_double),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
