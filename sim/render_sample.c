/* sim/render_sample.c -- samples of pixels. A pixel is the mean over its area of
 *
 *     L = L_emitted + rho / pi * E
 *
 * with E the irradiance of what the camera's ray meets, estimated by a path that begins there, and
 * L_emitted what surfaces and lamps on the way there send out by themselves. (A lamp is seen
 * through: it is no surface.) Where the surface is not matt, or seen through glass or holes, L is
 * what a path from the eye finds; E is that of the first surface which does not let most of the
 * light straight through.
 */
#include "core/color.h"
#include "core/sampler.h"
#include "sim/render_parts.h"
#include "sim/shading.h"

#include <string.h>

void view_pixel(const camera *c, uint32_t item, int *x, int *y)
{
    int strip = TILE * c->width, row = (int)item / strip; /* a row of tiles */
    int high = c->height - row * TILE < TILE ? c->height - row * TILE : TILE;
    int in = (int)item % strip, tile = in / (TILE * high); /* which tile of the row */
    int wide = c->width - tile * TILE < TILE ? c->width - tile * TILE : TILE;
    int at   = in - tile * TILE * high;
    *x       = tile * TILE + at % wide;
    *y       = row * TILE + at / wide;
}

static uint32_t seed_of(const view_run_state *v, const sample_id *id)
{
    return hash_combine_u32(hash_combine_u32(v->seed, id->item), id->scramble);
}

static void trace_camera(view_run_state *v, view_scratch *w, const sample_id *ids, int count)
{
    int packets = (count + LANES - 1) / LANES;
    for (int k = 0; k < packets; k++) {
        float x[LANES] = { 0 }, y[LANES] = { 0 };
        int32_t index[LANES] = { 0 }, seed[LANES] = { 0 };
        for (int i = 0; i < LANES && k * LANES + i < count; i++) {
            const sample_id *id = &ids[k * LANES + i];
            int px, py;
            view_pixel(&v->camera, id->item, &px, &py);
            x[i] = (float)px, y[i] = (float)py;
            index[i] = (int32_t)id->index;
            seed[i]  = (int32_t)hash_u32(seed_of(v, id));
        }
        vsample4 u = vsobol4(vunsigned(vload_int(index)), vunsigned(vload_int(seed)));
        if (v->s->pixel_centres)
            u.x = u.y = vsplat(0.5f);
        vfloat across = vload(x) + u.x, down = vload(y) + u.y;
        w->rays[k] = camera_ray(&v->camera, across, down);
        w->active[k] =
            ((vlane_index() + k * LANES) < count) & camera_sees(&v->camera, across, down);
    }
    world_first_hit(v->s->world, w->rays, w->active, packets, RAYS_COHERENT, w->hits);
    w->before = lamps_before(v->s, &v->shown, w->rays, w->active, packets, w->lamps);
    w->ray_count += count;
}

/* What most of the light goes straight through is looked through. */
static const float clear_share = 0.5f;
enum { MOST_LAYERS = 32 /* of glass, one behind the other */ };

/* Lets the hits of packet k be of what is seen behind glass and holes; far: how far that is. */
static void look_through(view_run_state *v, view_scratch *w, int k)
{
    const scene *s = v->s;
    vhit *seen     = &w->hits[k];
    w->passed[k]   = (vmask){ 0 };
    vmask looking  = w->active[k] & (seen->instance >= 0);
    for (int layer = 0; s->hollow && layer < MOST_LAYERS && vany(looking); layer++) {
        vsurface at;
        vshading shading;
        const vvec3 *way = &w->rays[k].direction;
        vfloat width     = v->camera.spread * seen->distance;
        scene_shade(s, seen, way, width, looking, &at, &shading);
        vrgb through = materials_through(s->materials, at.material, &shading, looking);
        looking      = looking & (vrgb_luminance(through) > clear_share);
        if (!vany(looking))
            return;
        vray on = { vray_start(&at, way), *way, vsplat(INFINITY) };
        vhit next;
        world_first_hit(s->world, &on, &looking, 1, RAYS_COHERENT, &next);
        w->ray_count += __builtin_popcount((unsigned)vbits(looking));
        w->passed[k]   = w->passed[k] | looking;
        seen->distance = vselect(looking, seen->distance + next.distance, seen->distance);
        seen->instance = vselect_int(looking, next.instance, seen->instance);
        seen->triangle = vselect_int(looking, next.triangle, seen->triangle);
        seen->u        = vselect(looking, next.u, seen->u);
        seen->v        = vselect(looking, next.v, seen->v);
        looking        = looking & (next.instance >= 0);
    }
}

/* Adds light that comes straight to the eye along the rays of packet k. */
static void add_emitted(const view_run_state *v, float *values, int k, int count, vrgb radiance,
                        int group, float dimming)
{
    const vfloat channel[3] = { radiance.x, radiance.y, radiance.z };
    for (int i = 0; i < LANES && k * LANES + i < count; i++)
        for (int c = 0; c < 3; c++) {
            float l = lane(channel[c], i);
            int at  = k * LANES + i;
            plain_of(v, values)[(RED + c) * BUNDLE + at] += dimming * l;
            if (v->layers)
                layer_of(v, values, group)[c * BUNDLE + at] += l;
        }
}

/* A lamp that shines at the eye from before the surface that is seen. */
static void add_lamp(const view_run_state *v, const view_scratch *w, float *values, int k,
                     int count, int l, vmask looking)
{
    const light *lamp       = v->s->lights[l];
    const scene_light *info = &v->s->light_info[l];
    vlight_hit hit;
    vmask seen  = lamp->type->hit(lamp, &w->rays[k].origin, &w->rays[k].direction, looking, &hit);
    seen        = seen & ((hit.dist < w->hits[k].distance) |
                   ((hit.dist == INFINITY) & (w->hits[k].instance < 0)));
    vfloat left = vsplat((float)scene_maintenance(v->s, l));
    if (vany(seen))
        add_emitted(v, values, k, count, vkeep3(seen, vscale(hit.radiance, left)), info->group,
                    info->dimming);
}

/* The sky behind everything. */
static void add_skies(const view_run_state *v, const view_scratch *w, float *values, int k,
                      int count)
{
    const scene *s   = v->s;
    const vvec3 *way = &w->rays[k].direction;
    vmask nothing    = w->active[k] & (w->hits[k].instance < 0) & ~w->passed[k];
    for (int i = 0; i < s->sky_count && vany(nothing); i++)
        add_emitted(v, values, k, count, sky_radiance(s->skies[i].sky, way, nothing),
                    s->skies[i].group, 1.0f);
}

/* What of a surface is seen besides light. */
static void note_surface(float *to, bool seen, int i, const vhit *hit, const vvec3 *n,
                         const vrgb *albedo)
{
    to[SMOOTHED * BUNDLE]     = 0.0f;
    to[SEEN * BUNDLE]         = seen;
    to[DISTANCE * BUNDLE]     = seen ? lane(hit->distance, i) : 0.0f;
    to[(NORMAL + 0) * BUNDLE] = seen ? lane(n->x, i) : 0.0f;
    to[(NORMAL + 1) * BUNDLE] = seen ? lane(n->y, i) : 0.0f;
    to[(NORMAL + 2) * BUNDLE] = seen ? lane(n->z, i) : 0.0f;
    to[(ALBEDO + 0) * BUNDLE] = lane(albedo->x, i);
    to[(ALBEDO + 1) * BUNDLE] = lane(albedo->y, i);
    to[(ALBEDO + 2) * BUNDLE] = lane(albedo->z, i);
    to[RED * BUNDLE] = to[GREEN * BUNDLE] = to[BLUE * BUNDLE] = to[ILLUMINANCE * BUNDLE] = 0.0f;
}

/* Sample i, which is in lane `at` of what is given, begins path number b->count of the bundle. */
static void set_out(const view_run_state *v, path_bundle *b, int32_t *sample_of,
                    const sample_id *ids, int i, vvec3 place, vvec3 direction)
{
    int at = i % LANES, p = b->count++;
    sample_of[p] = i;
    b->x[p] = lane(place.x, at), b->y[p] = lane(place.y, at), b->z[p] = lane(place.z, at);
    b->nx[p]    = lane(direction.x, at);
    b->ny[p]    = lane(direction.y, at);
    b->nz[p]    = lane(direction.z, at);
    b->index[p] = ids[i].index;
    b->set[p]   = ids[i].scramble;
    b->seed[p]  = seed_of(v, &ids[i]);
}

/* Where a path from the eye is called for: L is not E times something. */
static vmask is_not_plain(const view_run_state *v, const view_scratch *w, int k, vmask met,
                          const vsurface *at, const vshading *shading)
{
    const scene *s  = v->s;
    vmask not_plain = w->passed[k];
    if (s->narrow) {
        vint does = vgather_int(s->material_does, vkeep_int(met, at->material));
        not_plain = not_plain | (met & ((does & DOES_NARROW) != 0));
    }
    if (s->hollow) {
        vrgb through = materials_through(s->materials, at->material, shading, met);
        not_plain    = not_plain | (met & (vrgb_luminance(through) > 0.0f));
    }
    if (s->smooth || s->textured) {
        vvec3 turned = vsub(shading->n, shading->flat);
        not_plain    = not_plain | (met & (vdot(turned, turned) > 0.0f));
    }
    return not_plain;
}

/* Sets out the paths of packet k, and notes what is seen there besides its light. */
static void begin_packet(view_run_state *v, view_scratch *w, const sample_id *ids, int count, int k,
                         float *values)
{
    const scene *s = v->s;
    vmask met      = w->active[k] & (w->hits[k].instance >= 0);
    vsurface at;
    vshading shading;
    vfloat width = v->camera.spread * w->hits[k].distance;
    scene_shade(s, &w->hits[k], &w->rays[k].direction, width, met, &at, &shading);
    vmask not_plain = is_not_plain(v, w, k, met, &at, &shading);
    vrgb albedo     = materials_albedo(s->materials, at.material, &shading, met);
    for (int i = 0; i < LANES && k * LANES + i < count; i++) {
        int sample = k * LANES + i;
        bool seen  = vbits(met) >> i & 1;
        note_surface(plain_of(v, values) + sample, seen, i, &w->hits[k], &shading.n, &albedo);
        if (seen) {
            w->bundle.error[w->bundle.count] = lane(at.error, i);
            set_out(v, &w->bundle, w->sample_of, ids, sample, at.position, at.normal);
        }
        if (vbits(not_plain) >> i & 1)
            set_out(v, &w->eye, w->eye_sample_of, ids, sample, w->rays[k].origin,
                    w->rays[k].direction);
    }
    if (s->glows) {
        vfloat left = vsplat((float)s->study->maintenance);
        vrgb glow   = materials_emission(s->materials, at.material, &shading, met & ~not_plain);
        add_emitted(v, values, k, count, vscale(glow, left), s->glow_group, s->glow_dimming);
    }
    add_skies(v, w, values, k, count);
    for (int l = 0; l < w->before; l++)
        add_lamp(v, w, values, k, count, w->lamps[l], w->active[k] & ~not_plain);
}

static void begin_paths(view_run_state *v, view_scratch *w, const sample_id *ids, int count,
                        float *values)
{
    w->bundle.count = w->eye.count = 0;
    memset(layer_of(v, values, 0), 0, sizeof(float) * OF_LAYER * BUNDLE * (size_t)v->layers);
    for (int k = 0; k * LANES < count; k++) {
        look_through(v, w, k);
        begin_packet(v, w, ids, count, k, values);
    }
}

static float luminance_at(const float *rgb, int i)
{
    vec3 l = { rgb[i], rgb[BUNDLE + i], rgb[2 * BUNDLE + i] };
    return (float)LUMENS_PER_WATT * rgb_luminance(l);
}

/* Adds the light that the surface seen by sample i gives back, of irradiance e on it. */
static void add_reflected(float *rgb, float *illuminance, const float *albedo, bool plain, int i,
                          const float e[3])
{
    for (int c = 0; plain && c < 3; c++)
        rgb[c * BUNDLE + i] += 0.318309886f * albedo[c * BUNDLE + i] * e[c];
    illuminance[i] = (float)LUMENS_PER_WATT * rgb_luminance((vec3){ e[0], e[1], e[2] });
}

/* The hits that paths p and so on begin at, and whether they see their front. */
static vmask hits_of(const view_run_state *v, const view_scratch *w, int p, vhit *hit, vmask *front)
{
    const path_bundle *b = &w->bundle;
    float u[LANES] = { 0 }, t[LANES]         = { 0 };
    int32_t instance[LANES], triangle[LANES] = { 0 };
    for (int i = 0; i < LANES; i++) {
        instance[i] = -1;
        if (p + i >= b->count)
            continue;
        int sample     = w->sample_of[p + i];
        const vhit *at = &w->hits[sample / LANES];
        instance[i]    = lane(at->instance, sample % LANES);
        triangle[i]    = lane(at->triangle, sample % LANES);
        u[i]           = lane(at->u, sample % LANES);
        t[i]           = lane(at->v, sample % LANES);
    }
    *hit        = (vhit){ .instance = vload_int(instance), .triangle = vload_int(triangle) };
    hit->u      = vload(u);
    hit->v      = vload(t);
    vmask lanes = hit->instance >= 0;
    vsurface at;
    world_surface(v->s->world, hit, lanes, &at);
    vvec3 n = { vload(b->nx + p), vload(b->ny + p), vload(b->nz + p) };
    *front  = vdot(at.normal, n) > 0.0f;
    return lanes;
}

/* Focused light that lies on what is seen. */
static void add_focused(const view_run_state *v, view_scratch *w)
{
    path_bundle *b = &w->bundle;
    for (int p = 0; p < b->count; p += LANES) {
        vhit hit;
        vmask front, lanes = hits_of(v, w, p, &hit, &front);
        vint set = vload_int((const int32_t *)b->set + p);
        for (int l = v->layers ? 0 : -1; l < v->layers; l++) {
            vrgb e, coarse;
            float of[3][LANES];
            illumination_map_look(v->maps.focused, &hit, front, vkeep_int(lanes, set), l, lanes, &e,
                                  &coarse);
            float dimmed = l < 0 ? 1.0f : scene_dimming_of_group(v->s, l);
            vstore(of[0], e.x), vstore(of[1], e.y), vstore(of[2], e.z);
            for (int i = 0; i < LANES && p + i < b->count; i++) {
                for (int c = 0; c < 3; c++) {
                    b->indirect[c][p + i] += dimmed * of[c][i];
                    if (l >= 0)
                        b->layers[l][c][p + i] += of[c][i];
                }
                b->smoothed[p + i] += dimmed * lane(vrgb_luminance(vsub(e, coarse)), i);
            }
        }
    }
}

/* What the paths from what is seen have found; of the samples marked, not of what is seen. */
static void take_paths(const view_run_state *v, const view_scratch *w, const bool *by_eye,
                       float *values)
{
    const path_bundle *b = &w->bundle;
    float *plain = plain_of(v, values), *albedo = plain + ALBEDO * BUNDLE;
    for (int p = 0; p < b->count; p++) {
        int i      = w->sample_of[p];
        float e[3] = { b->direct[0][p] + b->indirect[0][p], b->direct[1][p] + b->indirect[1][p],
                       b->direct[2][p] + b->indirect[2][p] };
        if (b->smoothed && !by_eye[i]) {
            vec3 back = { albedo[i], albedo[BUNDLE + i], albedo[2 * BUNDLE + i] };
            plain[SMOOTHED * BUNDLE + i] =
                (float)LUMENS_PER_WATT * 0.318309886f * rgb_luminance(back) * b->smoothed[p];
        }
        add_reflected(plain + RED * BUNDLE, plain + ILLUMINANCE * BUNDLE, albedo, !by_eye[i], i, e);
        for (int l = 0; l < v->layers; l++) {
            float own[3] = { b->layers[l][0][p], b->layers[l][1][p], b->layers[l][2][p] };
            float *to    = layer_of(v, values, l);
            add_reflected(to, to + 3 * BUNDLE, albedo, !by_eye[i], i, own);
        }
    }
}

/* And those from the eye, of samples that are marked. */
static void take_eye_paths(const view_run_state *v, const view_scratch *w, bool *by_eye,
                           float *values)
{
    const path_bundle *b = &w->eye;
    float *rgb           = plain_of(v, values) + RED * BUNDLE;
    for (int p = 0; p < b->count; p++) {
        int i     = w->eye_sample_of[p];
        by_eye[i] = true;
        if (b->smoothed)
            plain_of(v, values)[SMOOTHED * BUNDLE + i] = (float)LUMENS_PER_WATT * b->smoothed[p];
        for (int c = 0; c < 3; c++)
            rgb[c * BUNDLE + i] = b->direct[c][p] + b->indirect[c][p];
        for (int l = 0; l < v->layers; l++)
            for (int c = 0; c < 3; c++)
                layer_of(v, values, l)[c * BUNDLE + i] = b->layers[l][c][p];
    }
}

void view_sample(void *context, int thread, const sample_id *ids, int count, float *values)
{
    view_run_state *v   = context;
    view_scratch *w     = &v->threads[thread];
    const float *rgb    = plain_of(v, values) + RED * BUNDLE;
    bool by_eye[BUNDLE] = { false };
    trace_camera(v, w, ids, count);
    begin_paths(v, w, ids, count, values);
    path_trace(w->paths, &w->bundle, &v->paths);
    if (v->maps.focused)
        add_focused(v, w);
    if (w->eye.count > 0) {
        path_trace(w->paths, &w->eye, &v->eye_paths);
        take_eye_paths(v, w, by_eye, values);
    }
    take_paths(v, w, by_eye, values);
    for (int i = 0; i < count; i++) {
        values[LUMINANCE * BUNDLE + i] = luminance_at(rgb, i);
        float full                     = 0.0f;
        for (int l = 0; l < v->layers; l++) {
            float own = luminance_at(layer_of(v, values, l), i);
            full += own;
            values[(FIRST_LAYER + l) * BUNDLE + i] = own;
        }
        if (v->layers)
            values[FULL_LUMINANCE * BUNDLE + i] = full;
    }
}
