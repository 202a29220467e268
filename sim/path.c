/* sim/path.c -- see path.h. The living paths stay packed at the front of the arrays. */
#include "sim/path.h"

#include "core/color.h"
#include "core/sampler.h"
#include "sim/direct.h"
#include "sim/sensor.h"

#include <string.h>

enum { PACKETS = PATHS / LANES };

enum { ASKED_LAMPS = 16 }; /* that are all asked where a path begins, if one would not do */

/* Survival is never certain, so that a path ends even in a room that absorbs nothing. */
static const float surest_survival = 0.995f;

/* What a living path carries; vectors are three fields. */
enum {
    PLACE  = 0,          /* m: where it stands; on its way, where the ray begins */
    NORMAL = PLACE + 3,  /* on the side that it came from; on its way, the ray's direction */
    CAME   = NORMAL + 3, /* unit: toward where it came from */
    WORTH  = CAME + 3,   /* by channel, 1 at the beginning */
    ERROR  = WORTH + 3,  /* m, of PLACE */
    PLAIN_FIELDS,        /* the rest is carried where surfaces glow */
    LEFT = PLAIN_FIELDS, /* m: where it was before */
    SIDE = LEFT + 3,     /* the normal there */
    PDF  = SIDE + 3,     /* 1/sr: with which it left in its direction */
    FIELDS
};

typedef struct path_tracer {
    const scene *s;
    const path_options *o;
    direct_scratch *direct;
    int64_t ray_count;
    path_bundle *b;
    int alive, fields;  /* of those below that are carried */
    float first[PATHS]; /* sr: response / pdf of each path's first direction */

    /* Of each living path: whose it is, what it stands on, what it carries */
    int32_t id[PATHS], material[PATHS], emitter[PATHS];
    float carried[FIELDS][PATHS];

    /* Of one step, by packet */
    vsurface at[PACKETS];
    vmask active[PACKETS];
    vsample4 sample[PACKETS], light_sample[PACKETS];
    direct_pick lights[PACKETS];
    vray rays[PACKETS];
    vhit hits[PACKETS];
} path_tracer;

path_tracer *path_tracer_new(arena *a, const scene *s, lux_error *err)
{
    path_tracer *t = arena_new(a, path_tracer, err);
    if (!t)
        return NULL;
    t->s      = s;
    t->fields = s->glows ? FIELDS : PLAIN_FIELDS;
    t->direct = direct_scratch_new(a, err);
    return t->direct ? t : NULL;
}

int64_t path_rays(const path_tracer *t) { return t->ray_count + direct_rays(t->direct); }

static int packets_of(const path_tracer *t) { return (t->alive + LANES - 1) / LANES; }

static vvec3 load3(const path_tracer *t, int field, int k)
{
    int i = k * LANES;
    return (vvec3){ vload(t->carried[field] + i), vload(t->carried[field + 1] + i),
                    vload(t->carried[field + 2] + i) };
}

static void store3(path_tracer *t, int field, int k, vvec3 v)
{
    int i = k * LANES;
    vstore(t->carried[field] + i, v.x);
    vstore(t->carried[field + 1] + i, v.y);
    vstore(t->carried[field + 2] + i, v.z);
}

/* Keeps the paths of `goes` of packet k, behind those kept before; they move down in place. */
static int keep(path_tracer *t, int k, vmask goes, int kept)
{
    for (int bits = vbits(goes); bits; bits &= bits - 1, kept++) {
        int from          = k * LANES + __builtin_ctz((unsigned)bits);
        t->id[kept]       = t->id[from];
        t->material[kept] = t->material[from];
        t->emitter[kept]  = t->emitter[from];
        for (int f = 0; f < t->fields; f++)
            t->carried[f][kept] = t->carried[f][from];
    }
    return kept;
}

/* Random numbers of a vertex. Lights have numbers of their own only where they need them. */
static void load_packets(path_tracer *t, uint32_t depth)
{
    bool places = t->s->extended || t->s->emitter_count > 0;
    for (int k = 0; k < packets_of(t); k++) {
        int i              = k * LANES;
        t->active[k]       = (vlane_index() + i) < t->alive;
        vint id            = vload_int(t->id + i);
        vuint index        = vunsigned(vgather_int((const int32_t *)t->b->index, id));
        vuint seed         = vunsigned(vgather_int((const int32_t *)t->b->seed, id));
        vuint of_bounce    = vhash_combine(seed, vunsigned(vsplat_int((int)depth)));
        vuint of_light     = vhash_combine(seed, vunsigned(vsplat_int(~(int)depth)));
        t->sample[k]       = vsobol4(index, of_bounce);
        t->light_sample[k] = places ? vsobol4(index, of_light) : t->sample[k];
        t->at[k]           = (vsurface){ .position = load3(t, PLACE, k),
                                         .normal   = load3(t, NORMAL, k),
                                         .error    = vload(t->carried[ERROR] + i),
                                         .material = vload_int(t->material + i) };
    }
}

/* ---- what is found --------------------------------------------------------------------------- */

/* Adds what each path of packet k found, e, of light number `which` (-1: of none). */
static void add(path_tracer *t, bool straight, int k, vrgb e, vint which)
{
    const scene *s  = t->s;
    path_sums *sums = straight ? &t->b->direct : &t->b->indirect;
    float of[3][LANES];
    vstore(of[0], e.x);
    vstore(of[1], e.y);
    vstore(of[2], e.z);
    for (int i = 0; i < LANES && k * LANES + i < t->alive; i++) {
        int id = t->id[k * LANES + i], l = lane(which, i);
        if (l < 0)
            continue;
        bool lamp     = l < s->light_count;
        float dimming = lamp ? s->light_info[l].dimming : s->glow_dimming;
        int group     = lamp ? s->light_info[l].group : s->glow_group;
        for (int c = 0; c < 3; c++) {
            (*sums)[c][id] += dimming * of[c][i];
            if (!t->b->layers)
                continue;
            t->b->layers[group][c][id] += of[c][i];
            if (straight)
                t->b->layers[s->group_count + group][c][id] += of[c][i];
        }
    }
}

static vfloat first_of(const path_tracer *t, int k)
{
    return vgather(t->first, vload_int(t->id + k * LANES));
}

/* p_a^2 / (p_a^2 + p_b^2), and 1 where there is no other way, b = 0, even to a direction that is as
 * good as never drawn. */
static vfloat power_heuristic(vfloat a, vfloat b)
{
    vfloat ratio = b / a;
    return vselect(b > 0.0f, 1.0f / (1.0f + ratio * ratio), vsplat(1.0f));
}

static vshading shading_of(const path_tracer *t, int k)
{
    return (vshading){ .wo = load3(t, CAME, k), .n = t->at[k].normal, .flat = t->at[k].normal };
}

/* Of the lights that were drawn: how much each counts, where the path might find it too. */
static vfloat light_share(const path_tracer *t, int k, bool beginning)
{
    const direct_pick *l = &t->lights[k];
    const vsurface *at   = &t->at[k];
    vmask glows          = t->active[k] & (l->light >= t->s->light_count);
    if (!vany(glows))
        return vsplat(1.0f);
    vshading here = shading_of(t, k);
    vfloat pdf;
    if (beginning)
        pdf = vsensor_pdf(t->o->quantity, &at->normal, &l->wi);
    else
        materials_reflect(t->s->materials, at->material, &here, &l->wi, glows, &pdf);
    return vselect(glows, power_heuristic(l->pdf, pdf), vsplat(1.0f));
}

static void add_lights(path_tracer *t, int k, bool beginning)
{
    const direct_pick *l = &t->lights[k];
    const vsurface *at   = &t->at[k];
    vrgb e               = vscale(l->e, light_share(t, k, beginning));
    if (beginning) {
        vfloat response = vsensor_response(t->o->quantity, &at->normal, &l->wi);
        add(t, true, k, vkeep3(t->active[k], vscale(e, response)), l->light);
    } else {
        vshading here = shading_of(t, k);
        vrgb f =
            materials_reflect(t->s->materials, at->material, &here, &l->wi, t->active[k], NULL);
        vrgb all = vscale(vmul(load3(t, WORTH, k), vmul(f, e)), first_of(t, k));
        add(t, false, k, vkeep3(t->active[k], all), l->light);
    }
}

/* One that is drawn by its luminance would do, but for colour and for groups: a mixture's luminance
 * can be sure while its colour, or a group's share, is not. */
static bool asks_all_lamps(const path_tracer *t)
{
    const scene *s = t->s;
    return s->emitter_count == 0 && s->light_count <= ASKED_LAMPS &&
           (s->lights_differ || t->b->layers);
}

/* Next-event estimation where the paths stand. */
static void ask_lights(path_tracer *t, bool beginning)
{
    const scene *s = t->s;
    bool lamps     = (!beginning || t->o->lamps) && s->light_count > 0;
    bool all       = beginning && lamps && asks_all_lamps(t);
    if (!lamps && s->emitter_count == 0)
        return;
    for (int first = 0; first < packets_of(t); first += DIRECT_PACKETS) {
        int n          = packets_of(t) - first;
        direct_batch b = { .at         = t->at + first,
                           .active     = t->active + first,
                           .u          = t->light_sample + first,
                           .packets    = n < DIRECT_PACKETS ? n : DIRECT_PACKETS,
                           .glow_alone = !lamps,
                           .all_around = beginning && quantity_is_round(t->o->quantity) };
        for (int l = 0; l < (all ? s->light_count : 1); l++) {
            if (all)
                direct_lamp(s, t->direct, l, &b, t->lights + first);
            else
                direct_one(s, t->direct, &b, t->lights + first);
            for (int k = first; k < first + b.packets; k++)
                add_lights(t, k, beginning);
        }
    }
}

/* What shines by itself where the paths have come to. */
static void add_glow(path_tracer *t, bool straight)
{
    const scene *s = t->s;
    if (!s->glows)
        return;
    for (int k = 0; k < packets_of(t); k++) {
        vmask active = (vlane_index() + k * LANES) < t->alive;
        vint which   = vload_int(t->material + k * LANES);
        vrgb glow    = materials_emission(s->materials, which, NULL, active);
        vmask bright = active & ((glow.x > 0.0f) | (glow.y > 0.0f) | (glow.z > 0.0f));
        if (!vany(bright))
            continue;

        /* Lights that are asked where the path was find it as well */
        vsurface before = { .position = load3(t, LEFT, k), .normal = load3(t, SIDE, k) };
        vvec3 wi        = vneg(load3(t, CAME, k));
        vfloat pdf      = vload(t->carried[PDF] + k * LANES);
        bool no_lamps   = s->light_count == 0 || (straight && !t->o->lamps);
        vfloat other = direct_glow_pdf(s, &before, &wi, vload_int(t->emitter + k * LANES), no_lamps,
                                       straight && quantity_is_round(t->o->quantity), bright);
        vfloat share = power_heuristic(pdf, other) * first_of(t, k);
        vrgb all     = vscale(vmul(load3(t, WORTH, k), glow), share);
        add(t, straight, k, vkeep3(bright, all), vsplat_int(s->light_count));
    }
}

/* Which paths see something that could give light back. */
static void note_what_is_met(path_tracer *t)
{
    for (int k = 0; k < packets_of(t); k++) {
        vmask active = (vlane_index() + k * LANES) < t->alive;
        vint which   = vload_int(t->material + k * LANES);
        vfloat back  = vrgb_luminance(materials_reflectance(t->s->materials, which, active));
        for (int bits = vbits(active & (back > 0.0f)); bits; bits &= bits - 1)
            t->b->met[t->id[k * LANES + __builtin_ctz((unsigned)bits)]] = 1.0f;
    }
}

/* ---- a step of all living paths -------------------------------------------------------------- */

/* Draws where a path begins to go; what its direction is worth is kept by its number. */
static vmask begin_direction(path_tracer *t, int k, vvec3 *wi, vfloat *pdf)
{
    const vsample4 *u = &t->sample[k];
    float worth[LANES];
    vfloat first;
    *wi = vsensor_direction(t->o->quantity, &t->at[k].normal, u->x, u->y, pdf, &first);
    vstore(worth, first);
    for (int i = 0; i < LANES && k * LANES + i < t->alive; i++)
        t->first[t->id[k * LANES + i]] = worth[i];
    return t->active[k];
}

/* Draws where a path goes on, or that it ends. */
static vmask next_direction(path_tracer *t, int k, vvec3 *wi, vfloat *pdf)
{
    const scene *s     = t->s;
    const vsample4 *u  = &t->sample[k];
    const vsurface *at = &t->at[k];
    vshading here      = shading_of(t, k);
    vscatter next;
    vmask goes =
        materials_scatter(s->materials, at->material, &here, u->x, u->y, u->z, t->active[k], &next);
    vrgb worth = vmul(load3(t, WORTH, k), next.weight);

    /* Roulette: a path goes on as often as it is worth going */
    vfloat most     = vmax(worth.x, vmax(worth.y, worth.z));
    vfloat survival = vmin(most, vsplat(surest_survival));
    goes            = goes & (u->w < survival);
    store3(t, WORTH, k, vscale(worth, 1.0f / survival));
    *wi  = next.wi;
    *pdf = next.pdf;
    return goes;
}

static void draw_directions(path_tracer *t, bool beginning)
{
    int n = packets_of(t), kept = 0;
    for (int k = 0; k < n; k++) {
        vvec3 wi;
        vfloat pdf = vsplat(1.0f);
        vmask goes = beginning ? begin_direction(t, k, &wi, &pdf) : next_direction(t, k, &wi, &pdf);
        if (t->fields == FIELDS) {
            store3(t, LEFT, k, t->at[k].position);
            store3(t, SIDE, k, t->at[k].normal);
            vstore(t->carried[PDF] + k * LANES, pdf);
        }
        store3(t, PLACE, k, vray_start(&t->at[k], &wi));
        store3(t, NORMAL, k, wi);
        kept = keep(t, k, goes, kept);
    }
    t->alive = kept;
}

/* The emitters that a packet's hits are, -1 for none. */
static void find_emitters(path_tracer *t, int k, vmask met)
{
    const scene *s = t->s;
    for (int bits = vbits(met); bits; bits &= bits - 1) {
        int i         = __builtin_ctz((unsigned)bits);
        int64_t first = s->first_emitter ? s->first_emitter[lane(t->hits[k].instance, i)] : -1;
        t->emitter[k * LANES + i] =
            first < 0 ? -1 : s->emitter_of[first + lane(t->hits[k].triangle, i)];
    }
}

/* Traces the rays, and moves the paths to what they meet. */
static void go_on(path_tracer *t)
{
    int n = packets_of(t), kept = 0;
    for (int k = 0; k < n; k++) {
        t->active[k] = (vlane_index() + k * LANES) < t->alive;
        t->rays[k]   = (vray){ load3(t, PLACE, k), load3(t, NORMAL, k), vsplat(INFINITY) };
    }
    t->ray_count += t->alive;
    world_first_hit(t->s->world, t->rays, t->active, n, RAYS_INCOHERENT, t->hits);

    for (int k = 0; k < n; k++) {
        vsurface at;
        vmask met = t->active[k] & (t->hits[k].instance >= 0);
        world_surface(t->s->world, &t->hits[k], met, &at);
        vvec3 wo   = vneg(t->rays[k].direction);
        vmask back = vdot(wo, at.normal) < 0.0f;
        store3(t, PLACE, k, at.position);
        store3(t, NORMAL, k, vselect3(back, vneg(at.normal), at.normal));
        store3(t, CAME, k, wo);
        vstore(t->carried[ERROR] + k * LANES, at.error);
        vstore_int(t->material + k * LANES, at.material);
        find_emitters(t, k, met);
        kept = keep(t, k, met, kept);
    }
    t->alive = kept;
}

static void begin(path_tracer *t, path_bundle *b, const path_options *o)
{
    t->b     = b;
    t->o     = o;
    t->alive = b->count;
    memset(b->direct, 0, sizeof b->direct);
    memset(b->indirect, 0, sizeof b->indirect);
    memset(b->met, 0, sizeof b->met);
    if (b->layers)
        memset(b->layers, 0, 2 * (size_t)t->s->group_count * sizeof *b->layers);
    const struct {
        int field;
        const float *from;
    } given[] = { { PLACE, b->x },    { PLACE + 1, b->y },   { PLACE + 2, b->z },
                  { NORMAL, b->nx },  { NORMAL + 1, b->ny }, { NORMAL + 2, b->nz },
                  { CAME, b->nx },    { CAME + 1, b->ny },   { CAME + 2, b->nz },
                  { ERROR, b->error } };
    for (size_t g = 0; g < sizeof given / sizeof *given; g++)
        memcpy(t->carried[given[g].field], given[g].from, (size_t)b->count * sizeof(float));
    for (int i = 0; i < PATHS; i++) {
        t->id[i]       = i < b->count ? i : 0; /* those behind the last are read, and dropped */
        t->material[i] = 0;
        t->emitter[i]  = -1;
        for (int c = 0; c < 3; c++)
            t->carried[WORTH + c][i] = 1.0f;
    }
}

void path_trace(path_tracer *t, path_bundle *b, const path_options *o)
{
    begin(t, b, o);
    for (uint32_t depth = 0; t->alive > 0; depth++) {
        load_packets(t, depth);
        ask_lights(t, depth == 0);
        if (!o->bounce && (depth > 0 || !t->s->glows))
            break;
        draw_directions(t, depth == 0);
        go_on(t);
        add_glow(t, depth == 0);
        if (depth == 0)
            note_what_is_met(t);
        if (!o->bounce)
            break;
    }
}
