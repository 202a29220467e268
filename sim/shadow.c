/* sim/shadow.c -- see shadow.h. */
#include "sim/shadow.h"

#include "core/color.h"
#include "core/packet_math.h"
#include "sim/shading.h"

enum { MOST_HITS = 8 /* at once */, MOST_ROUNDS = 64 };

/* A ray on its way through hollow surfaces. */
typedef struct passage {
    vrgb share;  /* of light that passed the faces so far */
    vrgb depth;  /* optical depth of the solids so far, by where the ray went in and out */
    vrgb inside; /* 1/m: absorption of the solids that it is in, as far as it is known */
} passage;

static vrgb absorption_of(const scene *s, vint index, vmask active)
{
    vrgb sum = { 0 };
    while (vany(active)) {
        int m;
        vmask same = vtake_same(index, &active, &m);
        sum        = vadd(sum, vkeep3(same, vspread(s->materials[m]->absorption)));
    }
    return sum;
}

/* One face more, `gone` m along the ray. */
static void pass_face(const scene *s, const vray *ray, const vhit *hit, vfloat gone, vmask met,
                      passage *p)
{
    vsurface at;
    vshading shading;
    scene_shade(s, hit, &ray->direction, vsplat(0.0f), met, &at, &shading);
    vrgb through = materials_through(s->materials, at.material, &shading, met);
    p->share     = vselect3(met, vmul(p->share, through), p->share);
    if (!s->solids)
        return;
    vrgb sigma  = absorption_of(s, at.material, met);
    vfloat sign = vselect(shading.front, vsplat(-1.0f), vsplat(1.0f));
    p->depth    = vadd(p->depth, vscale(sigma, sign * vkeep(met, gone)));
    p->inside   = vsub(p->inside, vscale(sigma, sign));
}

static vfloat passed(vfloat depth)
{
    const float nepers = 1.44269504f; /* log2(e) */
    return vexp2(-nepers * vmax(depth, vsplat(0.0f)));
}

/* Where the ray ends within a solid, the rest of its way is in there too. */
static vrgb arrives(const scene *s, const passage *p, vfloat reach)
{
    if (!s->solids)
        return p->share;
    vfloat far  = vselect(reach < INFINITY, reach, vsplat(0.0f));
    vfloat zero = vsplat(0.0f);
    vrgb left   = { vmax(p->inside.x, zero), vmax(p->inside.y, zero), vmax(p->inside.z, zero) };
    vrgb depth  = vadd(p->depth, vscale(left, far));
    return vmul(p->share, (vrgb){ passed(depth.x), passed(depth.y), passed(depth.z) });
}

/* The ray from behind the last of a full list of hits on. */
static vray behind(const scene *s, const vray *ray, const vhit *last)
{
    vsurface at;
    vmask met = last->instance >= 0;
    world_surface(s->world, last, met, &at);
    vray rest   = *ray;
    rest.origin = vselect3(met, vray_start(&at, &ray->direction), ray->origin);
    rest.reach  = vselect(met, ray->reach - last->distance, ray->reach);
    return rest;
}

static vrgb follow(const scene *s, const vray *from, vint spare, vmask active)
{
    vfloat gone = { 0 };
    vray ray    = *from;
    passage p   = { .share = vspread((vec3){ 1, 1, 1 }) };
    for (int round = 0; round < MOST_ROUNDS && vany(active); round++) {
        vhit hits[MOST_HITS];
        world_hollow_hits(s->world, &ray, &active, &spare, 1, MOST_HITS, hits);
        for (int i = 0; i < MOST_HITS; i++) {
            vmask met = active & (hits[i].instance >= 0);
            if (!vany(met))
                break;
            pass_face(s, &ray, &hits[i], gone + hits[i].distance, met, &p);
        }
        const vhit *last = &hits[MOST_HITS - 1];
        active           = active & (last->instance >= 0) & (vrgb_luminance(p.share) > 0.0f);
        if (!vany(active))
            break;
        gone = gone + vkeep(active, last->distance);
        ray  = behind(s, &ray, last);
    }
    return arrives(s, &p, from->reach);
}

int64_t shadow_trace(const scene *s, const vray *rays, const vmask *asked, const vint *spare,
                     int packets, ray_hint hint, vmask *blocked, vrgb *passes)
{
    int64_t count = 0;
    for (int k = 0; k < packets; k++)
        count += __builtin_popcount((unsigned)vbits(asked[k]));
    if (count == 0)
        return 0;
    world_any_hit(s->world, rays, asked, s->owners ? spare : NULL, packets, hint, blocked);
    for (int k = 0; s->hollow && k < packets; k++) {
        passes[k]  = vspread((vec3){ 1, 1, 1 });
        vmask open = asked[k] & ~blocked[k];
        if (vany(open))
            passes[k] = vselect3(
                open, follow(s, &rays[k], s->owners ? spare[k] : vsplat_int(0), open), passes[k]);
    }
    return count;
}
