/* lights/luminaire_area.c -- a luminaire that shines from its luminous opening: near field and soft
 * shadows. The formulae are those of opening.h.
 */
#include "lights/luminaire.h"

#include "core/color.h"

/* A vector along the opening's own axes. */
static vvec3 to_own(const luminaire *l, vvec3 a)
{
    return (vvec3){ vdot(a, vspread(l->own[0])), vdot(a, vspread(l->own[1])),
                    vdot(a, vspread(l->own[2])) };
}

static vvec3 from_own(const luminaire *l, vvec3 a)
{
    return vadd(vscale(vspread(l->own[0]), a.x),
                vadd(vscale(vspread(l->own[1]), a.y), vscale(vspread(l->own[2]), a.z)));
}

static vvec3 size_of(vvec3 a) { return (vvec3){ vabs(a.x), vabs(a.y), vabs(a.z) }; }

/* Mirrored as it takes to bring `side` to where nothing is below 0; again: back. */
static vvec3 mirror(vvec3 a, vvec3 side)
{
    vfloat one = vsplat(1.0f);
    return (vvec3){ a.x * vcopysign(one, side.x), a.y * vcopysign(one, side.y),
                    a.z * vcopysign(one, side.z) };
}

static vvec3 from_centre(const luminaire *l, const vvec3 *p)
{
    return to_own(l, vsub(*p, vspread(l->position)));
}

static vmask area_sample(const light *self, const vvec3 *p, vfloat s, vfloat t, vmask active,
                         vlight_sample *out)
{
    const luminaire *l   = (const luminaire *)self;
    vvec3 side           = from_centre(l, p);
    vvec3 q              = size_of(side);
    vopening_place place = { 0 };
    vmask drawn          = l->opening.type->draw(&l->opening, &q, s, t, active, &place);

    vvec3 to    = from_own(l, mirror(place.to, side));
    vfloat dist = vlength(to);
    vvec3 wi    = vscale(to, 1.0f / dist);
    vfloat cd   = { 0 };
    vmask lit   = vluminaire_candela(l, wi, drawn, &cd);

    out->wi   = vkeep3(lit, wi);
    out->dist = vkeep(lit, dist);
    out->e    = vscale(vspread(l->scale), vkeep(lit, cd / place.spread));
    out->pdf  = vkeep(lit, place.spread / place.projected); /* of a line: INFINITY */
    return lit;
}

static vmask area_hit(const light *self, const vvec3 *p, const vvec3 *wi, vmask active,
                      vlight_hit *out)
{
    const luminaire *l   = (const luminaire *)self;
    vvec3 side           = from_centre(l, p);
    vvec3 q              = size_of(side);
    vvec3 w              = mirror(to_own(l, *wi), side);
    vopening_place place = { 0 };
    vmask met            = l->opening.type->meet(&l->opening, &q, &w, active, &place);

    vfloat cd = { 0 };
    vmask lit = vluminaire_candela(l, *wi, met, &cd);

    out->dist     = vkeep(lit, vlength(place.to));
    out->radiance = vscale(vspread(l->scale), vkeep(lit, cd / place.projected));
    out->pdf      = vkeep(lit, place.spread / place.projected);
    return lit;
}

/* About I / (d^2 + A / pi), which is pi L right before the opening, times the cosine.
 *
 * d and the direction are those of the nearest place N of the box around the opening. All of the
 * opening lies beyond the plane through N square to that direction and within the box's diagonal
 * 2 R of N, so that its directions are within asin(k) of it, k = 2 R / sqrt(d^2 + 4 R^2): where the
 * cosine is below -k, no light comes from above the horizon. */
static vfloat area_weight(const light *self, const vvec3 *p, const vvec3 *n, vmask active)
{
    const luminaire *l = (const luminaire *)self;
    const float dim    = 0.02f; /* of the peak: where the nearest place is dark, others may
                                   shine, the more so the nearer */
    const float diagonal = 2.0f * l->opening.radius;
    const float spread =
        l->opening.area > 0.0f ? l->opening.area * (1.0f / WARP_PI) : 1e-4f * diagonal * diagonal;
    vvec3 side    = from_centre(l, p);
    vvec3 away    = vsub(size_of(side), vspread(l->opening.half));
    vvec3 to      = { -vmax(away.x, vsplat(0.0f)), -vmax(away.y, vsplat(0.0f)),
                      -vmax(away.z, vsplat(0.0f)) };
    vfloat dist2  = vdot(to, to);
    vmask outside = dist2 > 0.0f;
    to            = vselect3(outside, to, vneg(size_of(side))); /* in the box: toward the centre */
    vvec3 wi      = vscale(from_own(l, mirror(to, side)), 1.0f / vlength(to));

    /* About the horizon: a ramp (c + k)^2 / 4k between -k and k */
    vfloat k    = diagonal / vsqrt(dist2 + diagonal * diagonal);
    vfloat c    = vdot(wi, *n);
    vfloat over = vmax(c + k, vsplat(0.0f));
    vfloat cos  = vselect(c > k, c, over * over / (4.0f * k));
    cos         = vselect(outside, cos, vsplat(1.0f));

    vfloat cd = { 0 };
    vmask lit = vluminaire_candela(l, wi, active, &cd);
    cd        = vmax(vkeep(lit, cd), (dim + 0.5f * k * k) * l->model->most);
    return vkeep(active, rgb_luminance(l->scale) * cd * cos / (dist2 + spread));
}

const light_type luminaire_area_type = { .name     = "luminaire",
                                         .sample   = area_sample,
                                         .hit      = area_hit,
                                         .weight   = area_weight,
                                         .as_point = luminaire_as_point,
                                         .emit     = luminaire_emit,
                                         .flux     = luminaire_flux,
                                         .peak     = luminaire_peak,
                                         .bounds   = luminaire_bounds };

const light_type luminaire_line_type = { .name     = "luminaire",
                                         .sample   = area_sample,
                                         .weight   = area_weight,
                                         .as_point = luminaire_as_point,
                                         .emit     = luminaire_emit,
                                         .flux     = luminaire_flux,
                                         .peak     = luminaire_peak,
                                         .bounds   = luminaire_bounds };
