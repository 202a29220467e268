/* sim/map_scatter.c -- see map_tracer.h: where particles go on to.
 *
 * Materials are asked with the way back to where the particle came from in the eye's place; that
 * gives what they do to flux, as all of them treat both ways alike, but for normals that are not
 * the triangle's own. With ns such a normal, ng the triangle's, a the way back and b the way on,
 * flux is worth (Veach 1997, 5.3.2)
 *
 *     f(a, b) |b . ns| / pdf    times    |a . ns| |b . ng| / (|a . ng| |b . ns|)
 *
 * and where it is laid down |a . ns| / |a . ng| of it makes the irradiance about ns, by which
 * materials reflect.
 */
#include "sim/map_tracer.h"

#include "core/color.h"

static const float surest_survival = 0.995f; /* as in path.c */

/* Whether a deflection is one that paths ask for by mirror images (mirrors.h); -1 in image from
 * where it is not on. Light of skies is not asked for so. */
static vmask follow_images(map_tracer *t, int k, vmask single, vmask wide)
{
    const mirrors *m = t->job->s->mirror_images;
    if (!m)
        return (vmask){ 0 };
    vint image = vload_int(t->image + k * LANES);
    vhit hit   = hit_of(t, k, single);
    vint next  = mirrors_precede(m, image, &hit, single);
    image      = vselect_int(single, next, vselect_int(wide, vsplat_int(-1), image));
    vstore_int(t->image + k * LANES, image);
    return single & (next > 0);
}

/* The lamp's own body, which does not see its light. */
static bool is_spared(const map_tracer *t, int i)
{
    return t->spare[i] && !(t->state[i] & SCATTERED) &&
           world_owner(t->job->s->world, t->instance[i]) == t->spare[i];
}

/* Straight on through the body of their own lamp. */
static vmask spared(const map_tracer *t, int k, vmask active)
{
    int32_t is[LANES] = { 0 };
    for (int bits = vbits(active); bits; bits &= bits - 1) {
        int j = __builtin_ctz((unsigned)bits);
        is[j] = is_spared(t, k * LANES + j);
    }
    return vload_int(is) != 0;
}

static vmask on_one_side(const vshading *s, const vvec3 *wi)
{
    return (vdot(*wi, s->n) > 0.0f) == (vdot(*wi, s->flat) > 0.0f);
}

/* What normals that are not the triangle's own make of flux. */
static vfloat adjoint(const vshading *s, const vvec3 *wi)
{
    return tilt(s, &s->wo) * vabs(vdot(*wi, s->flat)) / vmax(vabs(vdot(*wi, s->n)), vsplat(1e-6f));
}

static void note_scattered(map_tracer *t, int k, vmask active, const vscatter *next)
{
    vint does    = vgather_int(t->job->s->material_does, vkeep_int(active, t->at[k].material));
    vint before  = vload_int(t->state + k * LANES) & ~COPY;
    vmask single = next->pdf == INFINITY;
    vmask plate  = ((does & DOES_SOLID) != 0) & ((does & DOES_LENS) == 0);
    vmask inner  = single & plate & ~next->bent & ~t->shading[k].front;
    vmask on     = next->straight | (single & plate & next->bent); /* as shadow rays pass it */
    vmask image  = follow_images(t, k, single & ~on & ~inner & ~next->bent,
                                 ~on & (~single | next->bent | inner));
    vint bits =
        vselect_int(single, vsplat_int(SCATTERED), vsplat_int(SCATTERED | SPREAD | FROM_MATT));
    bits       = vselect_int(image, bits, bits | NO_IMAGE);
    bits       = vselect_int(inner, bits | LOST, bits);
    vint kept  = vselect_int(single, before, before & ~LOST);
    vint after = (kept & ~FROM_MATT) | bits;
    vstore_int(t->state + k * LANES, vselect_int(on, before, after));
}

/* From matt surfaces before portals. What carries less as it was aimed does not end by that. */
static vmask aim(map_tracer *t, int k, vmask active, vmask goes, vscatter *next)
{
    const scene *s = t->job->s;
    uint32_t seed  = hash_combine_u32(hash_combine_u32(t->seed, 0xa13d), t->depth);
    vsample4 u     = vsobol4(vunsigned(vload_int(t->index + k * LANES)), vsplat_uint(seed));
    vfloat rarer;
    goes = map_toward_portals(s, &t->at[k], &t->shading[k], &u, matt_lanes(t, k, active), goes,
                              next, &rarer);
    vstore(t->carried[FULL] + k * LANES, load(t, FULL, k) * rarer);
    return goes;
}

/* The lanes that go on, as they turn first where they are aimed at. */
static vmask as_aimed(map_tracer *t, int k, vmask goes, vmask straight)
{
    int i       = k * LANES;
    vint state  = vload_int(t->state + i);
    vfloat gone = vload(t->distance + i), aimed = load(t, AIMED, k);
    vmask to     = (state & TO_TURN) != 0;
    vmask piece  = vload_int(t->instance + i) == vload_int(t->aim_instance + i);
    vmask same   = vload_int(t->triangle + i) == vload_int(t->aim_triangle + i);
    vfloat close = map_aim_tolerance(t->job->aim, gone);
    vmask here   = piece & (same | (vabs(gone - aimed) <= close)); /* or across an edge */
    vstore(t->carried[AIMED] + i, aimed - gone);
    vstore_int(t->state + i, vselect_int(straight, state, state & ~TO_TURN));
    return goes & (~to | (straight & ~here) | (~straight & here));
}

/* Draws where particles go on, or that they end. */
static vmask draw(map_tracer *t, int k, vmask active, vscatter *next)
{
    const scene *s    = t->job->s;
    vuint index       = vunsigned(vload_int(t->index + k * LANES));
    uint32_t seed     = hash_combine_u32(hash_combine_u32(t->seed, 0xb0ce), t->depth);
    vsample4 u        = vsobol4(index, vsplat_uint(seed));
    const vshading *h = &t->shading[k];
    vmask goes = materials_scatter(s->materials, t->at[k].material, h, u.x, u.y, u.z, active, next);
    if (aims(t))
        goes = aim(t, k, active, goes, next);
    if (s->smooth || s->textured) {
        vmask turned = goes & ~next->straight;
        goes         = goes & (next->straight | on_one_side(h, &next->wi));
        next->weight = vselect3(turned, vscale(next->weight, adjoint(h, &next->wi)), next->weight);
    }
    if (s->owners) {
        vmask through  = spared(t, k, active);
        next->wi       = vselect3(through, load3(t, WAY, k), next->wi);
        next->weight   = vselect3(through, vspread((vec3){ 1, 1, 1 }), next->weight);
        next->straight = next->straight | through;
        goes           = goes | through;
    }
    if (t->job->kind == MAP_FOCUSED)
        goes = goes & (next->straight | (next->pdf == INFINITY));
    if (t->job->aim)
        goes = as_aimed(t, k, goes, next->straight);

    /* Roulette: it goes on as often as it is worth going. Straight on it ends by itself. */
    vrgb flux       = vmul(load3(t, FLUX, k), next->weight);
    vfloat most     = vmax(flux.x, vmax(flux.y, flux.z)) / load(t, FULL, k);
    vfloat surest   = vselect(next->straight, vsplat(1.0f), vsplat(surest_survival));
    vfloat survival = vmin(most, surest);
    goes            = goes & (most > 0.0f) & (u.w < survival);
    vrgb before     = load3(t, FLUX, k);
    vrgb after      = vkeep3(goes, vscale(flux, 1.0f / survival));
    add_up(t->balance->absorbed, active, vsub(before, after));
    store3(t, FLUX, k, after);
    return goes;
}

vmask map_scatter(map_tracer *t, int k, vmask active, vscatter *next)
{
    vmask goes = draw(t, k, active, next);
    note_scattered(t, k, active, next);
    store3(t, PLACE, k, vray_start(&t->at[k], &next->wi));
    store3(t, WAY, k, next->wi);
    return goes;
}
