/* sim/emission.c -- see emission.h. Which source a particle is of, and what is near; what is far
 * away: emission_far.c.
 */
#include "core/color.h"
#include "core/distribution.h"
#include "sim/emission_parts.h"
#include "sim/room.h"

#include <string.h>

/* Of daylight, how much is drawn without regard to portals: where there is something outside that
 * gives it on, and else. */
static const double open_outside = 0.5, open_inside = 0.25;

/* Of the largest coordinate of a lamp's place: so far ahead its light begins, that the surface
 * which it may lie in does not stop it. (Who asks for it stops as much short of it.) */
static const float ahead = 0x1p-16f;

/* ---- drawing -------------------------------------------------------------------------------- */

static vint draw_source(const emission *e, const vsample4 *pick, vmask active, vfloat *share)
{
    vfloat rest, of_block, of_source;
    vint block  = vdistribution_draw(e->block_cdf, vsplat_int(0), e->blocks, vkeep(active, pick->x),
                                     &rest, &of_block);
    vint source = vdistribution_draw(e->source_cdf, block * (e->block + 1), e->block,
                                     vkeep(active, pick->y), &rest, &of_source);
    *share      = of_block * of_source;
    return block * e->block + source;
}

static vmask draw_near(const emission *e, int which, const emission_numbers *n, vmask active,
                       vparticle *out)
{
    const light *l = e->s->lights[which];
    vlight_ray ray;
    vmask lit = l->type->emit(l, &e->around, n->u.z, n->u.w, n->u.x, n->u.y, active, &ray);

    vvec3 o    = ray.origin;
    vfloat far = vmax(vmax(vabs(o.x), vabs(o.y)), vabs(o.z));
    out->ray   = (vray){ vkeep3(lit, valong(o, ray.direction, far * ahead)), ray.direction,
                         vkeep(lit, vsplat(INFINITY)) };
    out->flux  = ray.flux;
    out->even  = vkeep(lit, vsplat(1.0f));
    return lit;
}

static vmask draw_light(const emission *e, int which, const emission_numbers *n, vmask active,
                        vparticle *out)
{
    const scene *s = e->s;
    bool lamp      = which < s->light_count;
    out->source    = vkeep_int(active, vsplat_int(which));
    out->group = vkeep_int(active, vsplat_int(lamp ? s->light_info[which].group : s->glow_group));
    out->spare = vkeep_int(active, vsplat_int(lamp ? s->light_info[which].owner : 0));
    if (isinf(light_flux(s->lights[which]).x))
        return emission_draw_light(e, which, n, active, out);
    return draw_near(e, which, n, active, out);
}

static vparticle choose(vmask m, const vparticle *a, const vparticle *b)
{
    return (vparticle){ .ray    = { vselect3(m, a->ray.origin, b->ray.origin),
                                    vselect3(m, a->ray.direction, b->ray.direction),
                                    vselect(m, a->ray.reach, b->ray.reach) },
                        .flux   = vselect3(m, a->flux, b->flux),
                        .even   = vselect(m, a->even, b->even),
                        .source = vselect_int(m, a->source, b->source),
                        .group  = vselect_int(m, a->group, b->group),
                        .spare  = vselect_int(m, a->spare, b->spare) };
}

vmask emission_draw(const emission *e, vuint index, vuint seed, vmask active, vparticle *out)
{
    *out = (vparticle){ 0 };
    if (e->blocks == 0)
        return (vmask){ 0 };
    vsample4 pick      = vsobol4(index, vhash_combine(seed, vsplat_uint(1)));
    emission_numbers n = { .u = vsobol4(index, seed), .way = pick.z, .portal = pick.w };
    vfloat share;
    vint source = draw_source(e, &pick, active, &share);

    vmask lit = { 0 }, left = active;
    while (vany(left)) {
        int which;
        vmask same   = vtake_same(source, &left, &which);
        vparticle of = { 0 };
        vmask drawn  = which < e->light_count ? draw_light(e, which, &n, same, &of)
                                              : emission_draw_sky(e, which, &n, same, &of);
        *out         = choose(drawn, &of, out);
        lit          = lit | drawn;
    }
    out->flux = vkeep3(lit, vscale(out->flux, 1.0f / share));
    return lit;
}

double emission_flux(const emission *e) { return e->flux; }

double emission_missing(const emission *e) { return e->s->glow_watts; }

/* ---- making --------------------------------------------------------------------------------- */

static light_target sphere_around(const scene *s)
{
    const double wider = 1.0 + 1e-3; /* than the box, for rounding */
    if (!(s->low.x <= s->high.x))
        return (light_target){ { 0, 0, 0 }, 1.0f };
    dvec3 middle = d3_scale(d3_add(s->low, s->high), 0.5);
    double far   = 0.5 * d3_length(d3_sub(s->high, s->low));
    return (light_target){ scene_place(s, middle), (float)fmax(wider * far, 1e-3) };
}

/* Whether ceiling, walls and floor of the room let no light through: its first materials. */
static bool room_is_opaque(const scene *s)
{
    for (int i = 0; i < ROOM_MATERIALS; i++) {
        vec3 through = s->material_info[i].transmittance;
        if ((s->material_does[i] & (DOES_HOLLOW | DOES_SOLID)) || v3_length(through) > 0.0f)
            return false;
    }
    return true;
}

/* Whether no daylight is of use but what comes in by portals: where all surfaces are a box room
 * whose windows they are, and what is in it. (Its walls are lit from outside as well, but give
 * that light on to nothing.) */
static bool is_closed_room(const scene *s)
{
    const study_room *r = &s->study->room;
    const double off    = 1e-6;
    return r->given && room_is_opaque(s) && s->portal_count == r->window_count &&
           s->low.x >= -off && s->low.y >= -off && s->low.z >= -off &&
           s->high.x <= r->size.x + off && s->high.y <= r->size.y + off &&
           s->high.z <= r->size.z + off;
}

/* k: what gives the open way its share of all daylight. */
static double rarity(const emission *e, const far_flux *all, int count)
{
    double share = e->s->exteriors ? open_outside : open_inside;
    far_flux sum = { 0, 0 };
    for (int i = 0; i < count; i++) {
        sum.open += all[i].open;
        sum.through += all[i].through;
    }
    if (is_closed_room(e->s))
        return 0.0;
    return sum.through > 0.0 ? share / (1.0 - share) * sum.through / sum.open : 1.0;
}

typedef struct emission_work {
    arena scratch;
    far_flux *far;    /* of each source; 0 of near ones */
    double *weight;   /* of each source: W as luminance, what its particles are shared out by */
    int32_t *group;   /* of each source */
    double *of_group; /* sums of weights */
    float *through;
} emission_work;

static bool find_room(emission *e, emission_work *w, int sources, lux_error *err)
{
    const size_t n = (size_t)sources + 1;
    return (w->far = arena_array(&w->scratch, far_flux, n, err)) &&
           (w->weight = arena_array(&w->scratch, double, n + BLOCK, err)) &&
           (w->group = arena_array(&w->scratch, int32_t, n, err)) &&
           (w->of_group = arena_array(&w->scratch, double, (size_t)e->s->group_count + 1, err));
}

/* Lamps that are near are worth what they are dimmed to, unless there is a layer of each. */
static void weigh_light(emission *e, emission_work *w, int i)
{
    const scene *s = e->s;
    const light *l = s->lights[i];
    bool lamp      = i < s->light_count;
    double watts   = (double)rgb_luminance(light_flux(l));
    float dimming  = lamp ? s->light_info[i].dimming : s->glow_dimming;
    w->group[i]    = lamp ? s->light_info[i].group : s->glow_group;
    if (isinf(watts)) {
        w->far[i] = emission_far_flux(e, l);
        return;
    }
    e->flux += watts;
    w->weight[i] = s->layered ? watts : watts * (double)dimming * scene_maintenance(s, i);
}

/* k is of all that is far away together. */
static void weigh_far(emission *e, emission_work *w, int sources)
{
    e->rare = rarity(e, w->far, sources);
    for (int i = 0; i < sources; i++) {
        double open = e->rare * w->far[i].open, both = open + w->far[i].through;
        if (!(both > 0.0))
            continue;
        w->weight[i]  = both;
        w->through[i] = (float)(w->far[i].through / both);
        e->flux += e->rare > 0.0 ? w->far[i].open : w->far[i].through;
    }
}

/* Each group of a layered scene gets the same share. */
static void share_by_group(const emission *e, emission_work *w, int sources)
{
    if (!e->s->layered)
        return;
    for (int i = 0; i < sources; i++)
        w->of_group[w->group[i]] += w->weight[i];
    for (int i = 0; i < sources; i++)
        if (w->weight[i] > 0.0)
            w->weight[i] /= w->of_group[w->group[i]];
}

static bool make_distribution(arena *a, emission *e, emission_work *w, int sources, lux_error *err)
{
    e->block        = sources < BLOCK ? sources : BLOCK;
    int blocks      = (sources - 1) / e->block + 1;
    float *of_block = arena_array(a, float, (size_t)blocks + 1, err);
    float *cdf =
        of_block ? arena_array(a, float, (size_t)blocks *((size_t)e->block + 1), err) : NULL;
    double *sums = cdf ? arena_array(&w->scratch, double, (size_t)blocks, err) : NULL;
    if (!sums)
        return false;
    for (int k = 0; k < blocks; k++)
        sums[k] = distribution_make(cdf + (size_t)k * ((size_t)e->block + 1),
                                    w->weight + (size_t)k * (size_t)e->block, e->block);
    e->block_cdf  = of_block;
    e->source_cdf = cdf;
    e->blocks     = distribution_make(of_block, sums, blocks) > 0.0 ? blocks : 0;
    return true;
}

static bool make(arena *a, emission *e, emission_work *w, lux_error *err)
{
    const scene *s = e->s;
    far_flux *of_skies;
    if (s->sky_count > 0 && !emission_make_skies(a, e, &of_skies, err))
        return false;
    const int sources = e->light_count + e->sky_count;
    if (sources == 0)
        return true;
    w->through = arena_array(a, float, (size_t)sources, err);
    if (!w->through || !find_room(e, w, sources, err))
        return false;
    e->through = w->through;
    for (int i = 0; i < e->light_count; i++)
        weigh_light(e, w, i);
    for (int i = 0; i < e->sky_count; i++) {
        w->far[e->light_count + i]   = of_skies[i];
        w->group[e->light_count + i] = s->layered ? e->skies[i].group : 0;
    }
    weigh_far(e, w, sources);
    share_by_group(e, w, sources);
    return make_distribution(a, e, w, sources, err);
}

const emission *emission_new(arena *a, const scene *s, lux_error *err)
{
    emission *e = arena_new(a, emission, err);
    if (!e)
        return NULL;
    *e              = (emission){ .s            = s,
                                  .around       = sphere_around(s),
                                  .portals      = s->portal_list,
                                  .portal_count = s->portal_count,
                                  .light_count  = s->light_count + s->emitter_count };
    e->area         = (float)(M_PI * (double)e->around.radius * (double)e->around.radius);
    emission_work w = { 0 };
    bool good       = make(a, e, &w, err);
    arena_clear(&w.scratch);
    return good ? e : NULL;
}
