/* sim/scene_glint.c -- how much of the sun's light goes by way of mirrors and panes.
 *
 * No sampler finds that light: from a lit place the mirrored sun is too small to be met, and a ray
 * toward the sun knows of no mirror. So it is measured beforehand, by beams of sunlight that start
 * outside, half of them evenly over the scene as the sun sees it, half over its portals:
 *
 *                \ sun       Where a beam ends, on a surface that is no mirror, its light counts if
 *        pane  |  \          a ray from there, drawn by its cosine, meets another surface: then
 *     - - - - -|- -\-        it is light that goes on within the scene, as in rooms, and not
 *              |  / \        from a roof to the sky.
 *     ---------+-/---*---
 *               glint
 *
 * Each beam is split by several draws of the material, in what passes straight and what comes back
 * in a narrow lobe, or in a single direction. The share of glints in all that counts is what
 * results lack.
 */
#include "core/color.h"
#include "core/sampler.h"
#include "core/warp.h"
#include "sim/scene_build.h"
#include "sim/shading.h"

enum { BEAMS = 1 << 14, LEAST_BEAMS = 1 << 10 }; /* of all suns; of one */
enum { MOST_SUNS = BEAMS / LEAST_BEAMS };
enum { BATCH = 64, SPLITS = 8, MOST_MEETINGS = 8 };

/* A tenth of the accuracy that is promised if none is asked for: no mean is wrong by more. */
static const double share_that_matters = 0.002;
static const float narrow_pdf          = 100.0f; /* 1/sr, as in scene_focus.c */
static const float least_weight        = 1e-4f;

typedef struct beam {
    vec3 from, way;
    float weight;
    bool glint; /* it has come back from a mirror */
} beam;

typedef struct glint_work {
    const scene *s;
    beam *beams, *next;
    int count, next_count, room;
    double counted, glints; /* weights */
    int first_mirror;       /* the material that sent the first glint that counted; -1 */
} glint_work;

/* ---- what becomes of beams ------------------------------------------------------------------- */

/* What one packet of beams meets. */
typedef struct meeting {
    vhit hit;
    vmask met, ends; /* ends: some of its light stays on a matt surface */
    vsurface at;
    vshading shading;
    vfloat straight, mirrored; /* shares */
    vray on, back, kept;       /* what goes on straight, in the mirror, and from a lit place */
} meeting;

static vray load_beams(const beam *from, int count, vmask *active)
{
    float x[6][LANES];
    for (int i = 0; i < LANES; i++) {
        const beam *b = &from[i < count ? i : 0];
        x[0][i] = b->from.x, x[1][i] = b->from.y, x[2][i] = b->from.z;
        x[3][i] = b->way.x, x[4][i] = b->way.y, x[5][i] = b->way.z;
    }
    *active = vlane_index() < count;
    return (vray){ { vload(x[0]), vload(x[1]), vload(x[2]) },
                   { vload(x[3]), vload(x[4]), vload(x[5]) },
                   vsplat(INFINITY) };
}

/* By several draws, the parts of which are even. */
static void split(const scene *s, meeting *m, vmask which, vsample4 u)
{
    const float each = 1.0f / SPLITS;
    vvec3 mirror     = m->shading.n;
    for (int k = 0; k < SPLITS; k++) {
        vscatter drawn;
        vfloat pick  = ((float)k + u.z) * each;
        vmask goes   = materials_scatter(s->materials, m->at.material, &m->shading, u.x, u.y, pick,
                                         which, &drawn);
        vfloat some  = each * vrgb_luminance(drawn.weight);
        vmask narrow = goes & ~drawn.straight & ~drawn.bent & (drawn.pdf > narrow_pdf);
        m->straight += vkeep(goes & drawn.straight, some);
        m->mirrored += vkeep(narrow, some);
        mirror = vselect3(narrow, drawn.wi, mirror);
    }
    m->back.direction = mirror;
    m->back.origin    = vray_start(&m->at, &mirror);
}

static void meet(const scene *s, const vray *ray, vint number, vmask active, meeting *m)
{
    vsample4 u = vsobol4(vunsigned(number), vsplat_uint(1));
    m->met     = active & (m->hit.instance >= 0);
    scene_shade(s, &m->hit, &ray->direction, vsplat(0.0f), m->met, &m->at, &m->shading);
    vint does         = vgather_int(s->material_does, vkeep_int(m->met, m->at.material));
    m->ends           = m->met & ((does & DOES_ASK) != 0);
    m->kept.direction = vwarp_cosine_about(m->at.normal, u.x, u.y);
    m->kept.origin    = vray_start(&m->at, &m->kept.direction);
    m->kept.reach     = vsplat(INFINITY);
    m->on.direction   = ray->direction;
    m->on.origin      = vray_start(&m->at, &ray->direction);
    vmask splits      = m->met & ((does & (DOES_NARROW | DOES_HOLLOW)) != 0);
    if (vany(splits))
        split(s, m, splits, u);
}

static void send_on(glint_work *w, const vray *ray, int i, beam as, float share)
{
    as.weight *= share;
    if (!(as.weight > least_weight) || w->next_count == w->room)
        return;
    as.from = (vec3){ lane(ray->origin.x, i), lane(ray->origin.y, i), lane(ray->origin.z, i) };
    as.way =
        (vec3){ lane(ray->direction.x, i), lane(ray->direction.y, i), lane(ray->direction.z, i) };
    w->next[w->next_count++] = as;
}

/* In the order of the beams, whatever the width of packets. */
static void take(glint_work *w, const meeting *m, const beam *beams, int count, vmask blocked)
{
    int ends = vbits(m->ends & blocked), met = vbits(m->met);
    for (int i = 0; i < count; i++) {
        beam b = beams[i];
        if (ends >> i & 1) {
            w->counted += (double)b.weight;
            w->glints += b.glint ? (double)b.weight : 0.0;
        }
        if (!(met >> i & 1))
            continue;
        send_on(w, &m->on, i, b, lane(m->straight, i));
        if (w->first_mirror < 0 && lane(m->mirrored, i) > 0.0f)
            w->first_mirror = lane(m->at.material, i);
        b.glint = true;
        send_on(w, &m->back, i, b, lane(m->mirrored, i));
    }
}

static void follow_batch(glint_work *w, int first, int packets)
{
    vray rays[BATCH], kept[BATCH];
    vmask active[BATCH], blocked[BATCH], ends[BATCH];
    vhit hits[BATCH];
    meeting met[BATCH];
    for (int k = 0; k < packets; k++) {
        int at  = first + k * LANES;
        rays[k] = load_beams(w->beams + at, w->count - at, &active[k]);
    }
    world_first_hit(w->s->world, rays, active, packets, RAYS_INCOHERENT, hits);
    for (int k = 0; k < packets; k++) {
        met[k] = (meeting){ .hit = hits[k] };
        meet(w->s, &rays[k], vlane_index() + (first + k * LANES), active[k], &met[k]);
        kept[k] = met[k].kept;
        ends[k] = met[k].ends;
    }
    world_any_hit(w->s->world, kept, ends, NULL, packets, RAYS_INCOHERENT, blocked);
    for (int k = 0; k < packets; k++) {
        int at = first + k * LANES, left = w->count - at;
        take(w, &met[k], w->beams + at, left < LANES ? left : LANES, blocked[k]);
    }
}

/* The share of glints, once all beams have gone their ways. */
static double follow(glint_work *w)
{
    w->counted = w->glints = 0.0;
    for (int n = 0; n < MOST_MEETINGS && w->count > 0; n++) {
        w->next_count = 0;
        for (int first = 0; first < w->count; first += BATCH * LANES) {
            int packets = (w->count - first + LANES - 1) / LANES;
            follow_batch(w, first, packets < BATCH ? packets : BATCH);
        }
        beam *done = w->beams;
        w->beams   = w->next;
        w->next    = done;
        w->count   = w->next_count;
    }
    return w->counted > 0.0 ? w->glints / w->counted : 0.0;
}

/* ---- where beams start ----------------------------------------------------------------------- */

/* A sun's beam through a place of the scene, from outside of all of it. */
static beam beam_through(dvec3 at, dvec3 to_sun, double radius)
{
    double back = 2.0 * radius - d3_dot(at, to_sun);
    return (beam){ .from   = d3_to_float(d3_add(at, d3_scale(to_sun, back))),
                   .way    = d3_to_float(d3_scale(to_sun, -1.0)),
                   .weight = 1.0f };
}

/* The two fractions of beam k: even in the square (Roberts' sequence). */
static void even_place(int k, double *s, double *t)
{
    double a = 0.5 + k * 0.75487766624669276, b = 0.5 + k * 0.56984029099805327;
    *s = 2.0 * (a - floor(a)) - 1.0;
    *t = 2.0 * (b - floor(b)) - 1.0;
}

/* Over the rectangle around the scene's box as the sun sees it. */
static void start_over_scene(glint_work *w, dvec3 to_sun, int count)
{
    const scene *s = w->s;
    dvec3 half     = d3_scale(d3_sub(s->high, s->low), 0.5);
    dvec3 middle   = d3_sub(d3_scale(d3_add(s->high, s->low), 0.5), s->centre);
    dvec3 u        = fabs(to_sun.z) < 0.9 ? (dvec3){ -to_sun.y, to_sun.x, 0 }
                                          : (dvec3){ 0, -to_sun.z, to_sun.y };
    u              = d3_scale(u, 1.0 / d3_length(u));
    dvec3 v        = d3_cross(to_sun, u);
    double a       = fabs(u.x) * half.x + fabs(u.y) * half.y + fabs(u.z) * half.z;
    double b       = fabs(v.x) * half.x + fabs(v.y) * half.y + fabs(v.z) * half.z;
    for (int k = 0; k < count; k++) {
        double x, y;
        even_place(k, &x, &y);
        dvec3 at             = d3_add(middle, d3_add(d3_scale(u, a * x), d3_scale(v, b * y)));
        w->beams[w->count++] = beam_through(at, to_sun, d3_length(half) + d3_length(middle));
    }
}

/* m^2 of a portal, as the sun sees it from outside. */
static double face_of(const portal *p, dvec3 to_sun)
{
    double cosine = d3_dot(d3_from(p->outward), to_sun);
    return cosine > 0.0 ? 4.0 * cosine * (double)(v3_length(p->u) * v3_length(p->v)) : 0.0;
}

/* Over the portals, each by its face. */
static void start_over_portals(glint_work *w, dvec3 to_sun, int count)
{
    const scene *s = w->s;
    dvec3 half     = d3_scale(d3_sub(s->high, s->low), 0.5);
    double radius = 2.0 * d3_length(half) + 1.0, all = 0.0, done = 0.0;
    for (int i = 0; i < s->portal_count; i++)
        all += face_of(&s->portal_list[i], to_sun);
    for (int i = 0; i < s->portal_count && all > 0.0; i++) {
        const portal *p = &s->portal_list[i];
        double before   = done;
        done += face_of(p, to_sun) / all;
        for (int k = (int)(before * count); k < (int)(done * count); k++) {
            double x, y;
            even_place(k, &x, &y);
            dvec3 at             = d3_add(d3_from(p->centre),
                                          d3_add(d3_scale(d3_from(p->u), x), d3_scale(d3_from(p->v), y)));
            w->beams[w->count++] = beam_through(at, to_sun, radius);
        }
    }
}

/* ---- suns ------------------------------------------------------------------------------------ */

static double share_of(glint_work *w, int sun, int beams)
{
    dvec3 way    = w->s->light_info[sun].at;
    dvec3 to_sun = d3_scale(way, -1.0 / d3_length(way));
    w->count     = 0;
    start_over_scene(w, to_sun, beams / 2);
    double all = follow(w);
    w->count   = 0;
    start_over_portals(w, to_sun, beams / 2);
    return fmax(all, follow(w));
}

static void tell(const scene *s, double share, int made_of, notices *n)
{
    notice_add(
        n,
        "%s: about %.2g %% of the sunlight comes by way of mirrors, panes or smooth surfaces "
        "(first \"%s\") and is not found, intervals are not valid",
        s->study->path, 100.0 * share, s->material_info[made_of].name);
}

bool scene_find_glints(scene *s, notices *n, lux_error *err)
{
    if (s->sun_count == 0 || !(s->narrow || s->hollow) || !(s->low.x <= s->high.x))
        return true;
    int step     = (s->sun_count + MOST_SUNS - 1) / MOST_SUNS;
    int suns     = (s->sun_count + step - 1) / step;
    arena a      = { 0 };
    glint_work w = { .s = s, .room = 2 * BEAMS, .first_mirror = -1 };
    w.beams      = arena_array(&a, beam, (size_t)w.room, err);
    w.next       = arena_array(&a, beam, (size_t)w.room, err);
    double most  = 0.0;
    for (int i = 0; w.beams && w.next && i < s->sun_count; i += step)
        most = fmax(most, share_of(&w, s->light_count - s->sun_count + i, BEAMS / suns));
    bool good = w.beams && w.next;
    arena_clear(&a);
    s->glints = most > share_that_matters;
    if (s->glints)
        tell(s, most, w.first_mirror, n);
    return good;
}
