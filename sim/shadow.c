/* sim/shadow.c -- see shadow.h. */
#include "sim/shadow.h"

#include "core/color.h"
#include "core/packet_math.h"
#include "core/without.h"
#include "sim/shading.h"

enum { MOST_HITS = 8 /* at once */, MOST_ROUNDS = 64 };

/* A ray on its way through hollow surfaces. */
typedef struct passage {
    vpassed faces; /* so far */
    vrgb depth;    /* optical depth of the solids so far, by where the ray went in and out */
    vrgb inside;   /* 1/m: absorption of the solids that it is in, as far as it is known */
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

static vrgb not_below_0(vrgb a)
{
    const vfloat zero = vsplat(0.0f);
    return (vrgb){ vmax(a.x, zero), vmax(a.y, zero), vmax(a.z, zero) };
}

/* One face more, `gone` m along the ray. Out of a solid that it began in it comes as out of none.
 */
static void pass_face(const scene *s, const vray *ray, const vhit *hit, vfloat gone, vmask met,
                      passage *p)
{
    vsurface at;
    vshading shading;
    scene_shade(s, hit, &ray->direction, vsplat(0.0f), met, &at, &shading);
    vrgb through = materials_through(s->materials, at.material, &shading, met);
    if (s->lenses) { /* which bend it elsewhere */
        vint kind = vgather_int(s->material_does, vkeep_int(met, at.material));
        through   = vkeep3((kind & DOES_LENS) == 0, through);
    }
    p->faces.share = vselect3(met, vmul(p->faces.share, through), p->faces.share);
    if (!s->solids)
        return;
    vint does       = vgather_int(s->material_does, vkeep_int(met, at.material));
    p->faces.solids = p->faces.solids | (met & ((does & DOES_SOLID) != 0));
    vrgb sigma      = absorption_of(s, at.material, met);
    vfloat sign     = vselect(shading.front, vsplat(-1.0f), vsplat(1.0f));
    p->depth        = vadd(p->depth, vscale(sigma, sign * vkeep(met, gone)));
    p->inside       = not_below_0(vsub(p->inside, vscale(sigma, sign)));
}

static vfloat unabsorbed(vfloat depth)
{
    const float nepers = 1.44269504f; /* log2(e) */
    return vexp2(-nepers * vmax(depth, vsplat(0.0f)));
}

/* Where the ray ends within a solid, the rest of its way is in there too. */
static vpassed arrives(const scene *s, const passage *p, vfloat reach)
{
    vpassed all = p->faces;
    if (!s->solids)
        return all;
    vfloat far = vselect(reach < INFINITY, reach, vsplat(0.0f));
    vrgb depth = vadd(p->depth, vscale(p->inside, far));
    all.share =
        vmul(all.share, (vrgb){ unabsorbed(depth.x), unabsorbed(depth.y), unabsorbed(depth.z) });
    return all;
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

static vpassed follow(const scene *s, const vray *from, vint spare, vmask active)
{
    vfloat gone = { 0 };
    vray ray    = *from;
    passage p   = { .faces.share = vspread((vec3){ 1, 1, 1 }) };
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
        active           = active & (last->instance >= 0) & (vrgb_luminance(p.faces.share) > 0.0f);
        if (!vany(active))
            break;
        gone = gone + vkeep(active, last->distance);
        ray  = behind(s, &ray, last);
    }
    p.faces.share = vkeep3(~active, p.faces.share); /* through more than can be looked at */
    return arrives(s, &p, from->reach);
}

static void let_all_pass(const scene *s, int packets, vmask *blocked, vpassed *passed)
{
    for (int k = 0; k < packets; k++) {
        blocked[k] = (vmask){ 0 };
        if (HAS_MIRRORS && s->hollow)
            passed[k] = (vpassed){ .share = vspread((vec3){ 1, 1, 1 }) };
    }
}

int64_t shadow_trace(const scene *s, const vray *rays, const vmask *asked, const vint *spare,
                     int packets, ray_hint hint, vmask *blocked, vpassed *passed)
{
    int64_t count = 0;
    for (int k = 0; k < packets; k++)
        count += __builtin_popcount((unsigned)vbits(asked[k]));
    if (count == 0)
        return 0;
    if (s->unshadowed) {
        let_all_pass(s, packets, blocked, passed);
        return 0;
    }
    world_any_hit(s->world, rays, asked, s->owners ? spare : NULL, packets, hint, blocked);
    for (int k = 0; HAS_MIRRORS && s->hollow && k < packets; k++) {
        vmask open = asked[k] & ~blocked[k];
        vint own   = s->owners ? spare[k] : vsplat_int(0);
        passed[k]  = (vpassed){ .share = vspread((vec3){ 1, 1, 1 }) };
        if (vany(open) && !s->untinted)
            passed[k] = follow(s, &rays[k], own, open);
    }
    return count;
}
