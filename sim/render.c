/* sim/render.c -- see render.h. A pixel is the mean over its area of
 *
 *     L = L_emitted + rho / pi * E
 *
 * with E the irradiance of what the camera's ray meets, estimated by a path that begins there, and
 * L_emitted what surfaces and lamps on the way there send out by themselves. (A lamp is seen
 * through: it is no surface.)
 */
#include "sim/render.h"

#include "core/color.h"
#include "core/sampler.h"
#include "sim/accuracy.h"
#include "sim/path.h"
#include "sim/seen_lamps.h"

#include <string.h>

/* What accuracy_run() averages. The luminance comes first: it is held to the accuracy. */
enum {
    LUMINANCE,
    RED,
    GREEN,
    BLUE,
    ILLUMINANCE,
    SEEN, /* 1 where the ray meets a surface; the next are 0 elsewhere */
    DISTANCE,
    NORMAL,
    ALBEDO   = NORMAL + 3,
    CHANNELS = ALBEDO + 3,
};

/* In a layered scene the luminances of all light undimmed and of groups, which are judged as well,
 * stand between the first and the others; behind all stand, for each group, red, green, blue and
 * illuminance. */
enum { FULL_LUMINANCE = 1, FIRST_LAYER = 2, OF_LAYER = 4 };

enum { PACKETS = BUNDLE / LANES, TILE = 8 /* pixels a side, sampled together */ };
_Static_assert((int)BUNDLE <= (int)PATHS, "what is asked for at once fits a path bundle");

typedef struct view_scratch {
    path_tracer *paths;
    path_bundle bundle;
    vray rays[PACKETS];
    vmask active[PACKETS];
    vhit hits[PACKETS];
    int32_t sample_of[BUNDLE]; /* of each path */
    int32_t *lamps;            /* that the rays may meet */
    int before;
    int64_t ray_count;
} view_scratch;

typedef struct view_run_state {
    const scene *s;
    const run_options *o;
    camera camera;
    view_scratch *threads;
    path_options paths;
    int layers; /* 0 unless the scene is layered */
    seen_lamps shown;
    uint32_t seed;
} view_run_state;

/* How many channels a layered scene has between LUMINANCE and the others. */
static int before_plain(const view_run_state *v)
{
    return v->layers ? FIRST_LAYER - 1 + v->layers : 0;
}

/* Where the channels above begin: all but LUMINANCE. */
static float *plain_of(const view_run_state *v, float *values)
{
    return values + before_plain(v) * BUNDLE;
}

/* Red, green, blue and illuminance of a layer. */
static float *layer_of(const view_run_state *v, float *values, int layer)
{
    return plain_of(v, values) + (CHANNELS + OF_LAYER * layer) * BUNDLE;
}

/* Items are pixels tile by tile, so that those sampled together see the same things. */
static void pixel_of(const camera *c, uint32_t item, int *x, int *y)
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

/* ---- what the camera's rays meet ------------------------------------------------------------- */

static void trace_camera(view_run_state *v, view_scratch *w, const sample_id *ids, int count)
{
    int packets = (count + LANES - 1) / LANES;
    for (int k = 0; k < packets; k++) {
        float x[LANES] = { 0 }, y[LANES] = { 0 };
        int32_t index[LANES] = { 0 }, seed[LANES] = { 0 };
        for (int i = 0; i < LANES && k * LANES + i < count; i++) {
            const sample_id *id = &ids[k * LANES + i];
            int px, py;
            pixel_of(&v->camera, id->item, &px, &py);
            x[i] = (float)px, y[i] = (float)py;
            index[i] = (int32_t)id->index;
            seed[i]  = (int32_t)hash_u32(seed_of(v, id));
        }
        vsample4 u   = vsobol4(vunsigned(vload_int(index)), vunsigned(vload_int(seed)));
        w->rays[k]   = camera_ray(&v->camera, vload(x) + u.x, vload(y) + u.y);
        w->active[k] = (vlane_index() + k * LANES) < count;
    }
    world_first_hit(v->s->world, w->rays, w->active, packets, RAYS_COHERENT, w->hits);
    w->before = lamps_before(v->s, &v->shown, w->rays, w->active, packets, w->lamps);
    w->ray_count += count;
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
                     int count, int l)
{
    const light *lamp       = v->s->lights[l];
    const scene_light *info = &v->s->light_info[l];
    vlight_hit hit;
    vmask seen =
        lamp->type->hit(lamp, &w->rays[k].origin, &w->rays[k].direction, w->active[k], &hit);
    seen = seen & (hit.dist < w->hits[k].distance);
    if (vany(seen))
        add_emitted(v, values, k, count, vkeep3(seen, hit.radiance), info->group, info->dimming);
}

/* What of a surface is seen besides light. */
static void note_surface(float *to, bool seen, int i, const vhit *hit, const vvec3 *n,
                         const vrgb *albedo)
{
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

/* Sets out a path where each ray met something, and what is seen there besides its light. */
static void begin_paths(view_run_state *v, view_scratch *w, const sample_id *ids, int count,
                        float *values)
{
    path_bundle *b = &w->bundle;
    b->count       = 0;
    memset(layer_of(v, values, 0), 0, sizeof(float) * OF_LAYER * BUNDLE * (size_t)v->layers);
    for (int k = 0; k * LANES < count; k++) {
        vmask met = w->active[k] & (w->hits[k].instance >= 0);
        vsurface at;
        world_surface(v->s->world, &w->hits[k], met, &at);
        vmask back  = vdot(w->rays[k].direction, at.normal) > 0.0f;
        vvec3 n     = vselect3(back, vneg(at.normal), at.normal);
        vrgb albedo = materials_reflectance(v->s->materials, at.material, met);
        for (int i = 0; i < LANES && k * LANES + i < count; i++) {
            int at_sample = k * LANES + i;
            bool seen     = vbits(met) >> i & 1;
            note_surface(plain_of(v, values) + at_sample, seen, i, &w->hits[k], &n, &albedo);
            if (!seen)
                continue;
            int p           = b->count++;
            w->sample_of[p] = at_sample;
            b->x[p] = lane(at.position.x, i), b->y[p] = lane(at.position.y, i);
            b->z[p] = lane(at.position.z, i), b->error[p] = lane(at.error, i);
            b->nx[p] = lane(n.x, i), b->ny[p] = lane(n.y, i), b->nz[p] = lane(n.z, i);
            b->index[p] = ids[at_sample].index;
            b->seed[p]  = seed_of(v, &ids[at_sample]);
        }
        if (v->s->glows)
            add_emitted(v, values, k, count, materials_emission(v->s->materials, at.material, NULL, met),
                        v->s->glow_group, v->s->glow_dimming);
        for (int l = 0; l < w->before; l++)
            add_lamp(v, w, values, k, count, w->lamps[l]);
    }
}

static float luminance_at(const float *rgb, int i)
{
    vec3 l = { rgb[i], rgb[BUNDLE + i], rgb[2 * BUNDLE + i] };
    return (float)LUMENS_PER_WATT * rgb_luminance(l);
}

/* Adds the light that the surface seen by sample i gives back, of irradiance e on it. */
static void add_reflected(float *rgb, float *illuminance, const float *albedo, int i,
                          const float e[3])
{
    for (int c = 0; c < 3; c++)
        rgb[c * BUNDLE + i] += 0.318309886f * albedo[c * BUNDLE + i] * e[c];
    illuminance[i] = (float)LUMENS_PER_WATT * rgb_luminance((vec3){ e[0], e[1], e[2] });
}

static void sample_pixels(void *context, int thread, const sample_id *ids, int count, float *values)
{
    view_run_state *v = context;
    view_scratch *w   = &v->threads[thread];
    path_bundle *b    = &w->bundle;
    float *plain = plain_of(v, values), *albedo = plain + ALBEDO * BUNDLE;
    trace_camera(v, w, ids, count);
    begin_paths(v, w, ids, count, values);
    path_trace(w->paths, b, &v->paths);

    for (int p = 0; p < b->count; p++) {
        int i      = w->sample_of[p];
        float e[3] = { b->direct[0][p] + b->indirect[0][p], b->direct[1][p] + b->indirect[1][p],
                       b->direct[2][p] + b->indirect[2][p] };
        add_reflected(plain + RED * BUNDLE, plain + ILLUMINANCE * BUNDLE, albedo, i, e);
        for (int l = 0; l < v->layers; l++) {
            float own[3] = { b->layers[l][0][p], b->layers[l][1][p], b->layers[l][2][p] };
            float *to    = layer_of(v, values, l);
            add_reflected(to, to + 3 * BUNDLE, albedo, i, own);
        }
    }
    for (int i = 0; i < count; i++) {
        values[LUMINANCE * BUNDLE + i] = luminance_at(plain + RED * BUNDLE, i);
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

/* ---- a run ----------------------------------------------------------------------------------- */

static bool make_planes(arena *a, view_result *out, lux_error *err)
{
    float **planes[] = { &out->radiance[0], &out->radiance[1], &out->radiance[2], &out->illuminance,
                         &out->half_width,  &out->distance,    &out->normal[0],   &out->normal[1],
                         &out->normal[2],   &out->albedo[0],   &out->albedo[1],   &out->albedo[2] };
    for (size_t i = 0; i < sizeof planes / sizeof *planes; i++) {
        *planes[i] = arena_array(a, float, (size_t)out->width *(size_t)out->height, err);
        if (!*planes[i])
            return false;
    }
    out->layers = arena_array(a, view_layer, (size_t)out->layer_count + 1, err);
    for (int l = 0; out->layers && l < out->layer_count; l++) {
        view_layer *layer = &out->layers[l];
        float **own[]     = { &layer->radiance[0], &layer->radiance[1], &layer->radiance[2],
                              &layer->illuminance, &layer->half_width };
        for (size_t i = 0; i < sizeof own / sizeof *own; i++) {
            *own[i] = arena_array(a, float, (size_t)out->width *(size_t)out->height, err);
            if (!*own[i])
                return false;
        }
    }
    return out->layers != NULL;
}

/* The layers of pixel i, which is number `to` of the picture. */
static void take_layers(const view_run_state *v, const accuracy_result *got, view_result *out,
                        size_t i, size_t to)
{
    size_t n           = (size_t)(out->width * out->height);
    double maintenance = v->s->study->maintenance;
    double seen        = got->mean[(size_t)(SEEN + before_plain(v)) * n + i];
    for (int l = 0; l < v->layers; l++) {
        view_layer *layer = &out->layers[l];
        const double *mean =
            got->mean + (size_t)(CHANNELS + before_plain(v) + OF_LAYER * l) * n + i;
        for (size_t c = 0; c < 3; c++)
            layer->radiance[c][to] = (float)(maintenance * mean[c * n]);
        layer->illuminance[to] = seen > 0.0 ? (float)(maintenance * mean[3 * n] / seen) : 0.0f;
        layer->half_width[to] =
            (float)(maintenance * got->half_width[(size_t)(FIRST_LAYER + l) * n + i]);
    }
}

static void take_pixels(const view_run_state *v, const accuracy_result *got, view_result *out)
{
    int items          = out->width * out->height;
    double maintenance = v->s->study->maintenance;
    const double *mean = got->mean + (size_t)(before_plain(v) * items); /* as plain_of() */
    double logs = 0.0, bright = 0.0;
    for (int i = 0; i < items; i++) {
        int x, y;
        pixel_of(&v->camera, (uint32_t)i, &x, &y);
        size_t to = (size_t)y * (size_t)out->width + (size_t)x, n = (size_t)items, from = (size_t)i;
        double seen = mean[SEEN * n + from], length2 = 0.0;
        for (size_t c = 0; c < 3; c++) {
            out->radiance[c][to] = (float)(maintenance * mean[(RED + c) * n + from]);
            out->albedo[c][to] = seen > 0.0 ? (float)(mean[(ALBEDO + c) * n + from] / seen) : 0.0f;
            length2 += mean[(NORMAL + c) * n + from] * mean[(NORMAL + c) * n + from];
        }
        for (size_t c = 0; c < 3; c++)
            out->normal[c][to] =
                length2 > 0.0 ? (float)(mean[(NORMAL + c) * n + from] / sqrt(length2)) : 0.0f;
        out->illuminance[to] =
            seen > 0.0 ? (float)(maintenance * mean[ILLUMINANCE * n + from] / seen) : 0.0f;
        out->distance[to]   = seen > 0.0 ? (float)(mean[DISTANCE * n + from] / seen) : 0.0f;
        out->half_width[to] = (float)(maintenance * got->half_width[i]);
        double luminance    = maintenance * got->mean[LUMINANCE * n + from];
        take_layers(v, got, out, from, to);
        if (luminance > 0.0)
            logs += log(luminance), bright += 1.0;
    }
    out->log_average = bright > 0.0 ? exp(logs / bright) : 0.0;
    out->reached     = got->reached;
    out->end         = got->end;
}

static bool make_threads(view_run_state *v, arena *a, lux_error *err)
{
    v->shown   = lamps_that_show(a, v->s, err);
    v->threads = v->shown.lamps ? arena_array(a, view_scratch, (size_t)v->o->threads, err) : NULL;
    for (int t = 0; v->threads && t < v->o->threads; t++) {
        view_scratch *w = &v->threads[t];
        w->paths        = path_tracer_new(a, v->s, err);
        if (v->layers)
            w->bundle.layers = arena_array(a, path_sums, 2 * (size_t)v->layers, err);
        w->lamps = arena_array(a, int32_t, (size_t)v->shown.count + 1, err);
        if (!w->paths || !w->lamps || (v->layers && !w->bundle.layers))
            return false;
    }
    return v->threads != NULL;
}

static bool run(arena *a, arena *scratch, view_run_state *v, view_result *out, lux_error *err)
{
    if (!make_planes(a, out, err) || !make_threads(v, scratch, err))
        return false;
    accuracy_desc d = { .items         = out->width * out->height,
                        .channels      = CHANNELS + before_plain(v) + OF_LAYER * v->layers,
                        .judged        = 1 + before_plain(v),
                        .accuracy      = out->asked,
                        .needed        = 0.98,
                        .floor         = FLOOR_LOG_MEAN,
                        .first_samples = 1,
                        .threads       = v->o->threads,
                        .deadline      = v->o->deadline,
                        .progress      = v->o->progress,
                        .sample        = sample_pixels,
                        .context       = v };
    accuracy_result got;
    if (!accuracy_run(scratch, &d, &got, err))
        return false;
    if (!got.complete)
        return failed(err, ERR_INTERRUPTED, "interrupted before view %s had its first picture",
                      out->view->name);
    take_pixels(v, &got, out);
    return true;
}

bool view_run(arena *a, const scene *s, const study_view *view, const run_options *o,
              view_result *out, lux_error *err)
{
    double begun     = clock_seconds();
    arena scratch    = { 0 };
    uint32_t seed    = hash_text_u32(hash_u32(~o->seed), view->name);
    view_run_state v = { .s      = s,
                         .o      = o,
                         .paths  = { .lamps = true, .bounce = !o->direct_only },
                         .layers = s->layered ? s->group_count : 0,
                         .seed   = seed };
    if (!camera_of_view(s, view, &v.camera, err))
        return false;
    *out = (view_result){ .view        = view,
                          .layer_count = v.layers,
                          .width       = v.camera.width,
                          .height      = v.camera.height,
                          .asked = isnan(o->accuracy) ? VIEW_DEFAULT_PERCENT / 100.0 : o->accuracy,
                          .left_to_chance = scene_left_to_chance(s, o->direct_only) };
    progress_begin(o->progress, view->name);
    bool good = run(a, &scratch, &v, out, err);
    for (int t = 0; good && t < o->threads; t++)
        out->rays += v.threads[t].ray_count + path_rays(v.threads[t].paths);
    out->seconds = clock_seconds() - begun;
    arena_clear(&scratch);
    return good;
}
