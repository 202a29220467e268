/* tests/sources.c -- see sources.h. */
#include "tests/sources.h"

#include "core/sampler.h"
#include "tests/test.h"
#include "tests/webs.h"

const vec3 source_at             = { 0.1f, 0.2f, 0.4f };
const light_target source_target = { { 0.2f, -0.1f, 0.3f }, 2.0f };
static const vec3 aim            = { 0.3f, -0.2f, -0.9f };

typedef const light *light_maker(arena *a);

static const light *a_point(arena *a)
{
    return light_point(a, &(point_desc){ source_at, { 3, 2, 1 } }, NULL);
}
static const light *a_cone(arena *a)
{
    return light_cone(a, &(cone_desc){ source_at, aim, { 3, 2, 1 }, 0.3f, 0.8f }, NULL);
}
static const light *a_wide_cone(arena *a)
{
    return light_cone(a, &(cone_desc){ source_at, aim, { 3, 2, 1 }, 0.0f, 3.1f }, NULL);
}
static const light *a_cosine(arena *a)
{
    return light_cosine(a, &(cosine_desc){ source_at, aim, { 3, 2, 1 }, 1.0f }, NULL);
}
static const light *a_spot(arena *a)
{
    return light_cosine(a, &(cosine_desc){ source_at, aim, { 3, 2, 1 }, 40.5f }, NULL);
}
static const light *a_line(arena *a)
{
    return light_linear(
        a, &(linear_desc){ { -0.4f, 0.1f, 0.3f }, { 0.5f, 0.3f, 0.4f }, { 3, 2, 1 } }, NULL);
}
static const light *a_disk(arena *a)
{
    return light_disk(a, &(disk_desc){ source_at, aim, 0.4f, { 3, 2, 1 } }, NULL);
}
static const light *a_rect(arena *a)
{
    return light_rect(a, &(rect_desc){ source_at, aim, { 0, 1, 0.2f }, 0.9f, 0.4f, { 3, 2, 1 } },
                      NULL);
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
    return light_parallel(a, &(parallel_desc){ aim, { 3, 2, 1 }, source_at, 0.3f }, NULL);
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
enum { LAMPS = sizeof lamps / sizeof *lamps };

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
            .position = source_at, .aim = aim, .rotate = 0.4f, .scale = { 3, 2, 1 }, .web = web },
        NULL);
}

void for_each_source(bool beam, source_test *test)
{
    for (int i = 0; i < (beam ? LAMPS : LAMPS - 1); i++) {
        arena a        = { 0 };
        const light *l = make(&a, &lamps[i]);
        assert_non_null(l);
        test(lamps[i].name, l);
        arena_clear(&a);
    }
}

vlight_ray source_draw(const light *l, int first, uint32_t seed, vmask *lit)
{
    vlight_ray ray;
    vsample4 u = vsobol4(vunsigned(vlane_index() + first), vsplat_uint(seed));
    *lit       = l->type->emit(l, &source_target, u.z, u.w, u.x, u.y, ALL_LANES, &ray);
    return ray;
}
