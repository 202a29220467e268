/* sim/render.c -- see render.h. A pixel is the mean over its area of
 *
 *     L = L_emitted + rho / pi * E
 *
 * with E the irradiance of what the camera's ray meets, estimated by a path that begins there.
 */
#include "sim/render.h"

#include "core/color.h"
#include "core/sampler.h"
#include "sim/accuracy.h"
#include "sim/path.h"

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

enum { PACKETS = BUNDLE / LANES, TILE = 8 /* pixels a side, sampled together */ };
_Static_assert((int)BUNDLE <= (int)PATHS, "what is asked for at once fits a path bundle");

typedef struct view_scratch {
    path_tracer *paths;
    path_bundle bundle;
    vray rays[PACKETS];
    vmask active[PACKETS];
    vhit hits[PACKETS];
    int32_t sample_of[BUNDLE]; /* of each path */
    int64_t ray_count;
} view_scratch;

typedef struct view_run_state {
    const scene *s;
    const run_options *o;
    camera camera;
    view_scratch *threads;
    uint32_t seed;
} view_run_state;

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
    w->ray_count += count;
}

/* Sets out a path where each ray met something, and what is seen there besides light. */
static void begin_paths(view_run_state *v, view_scratch *w, const sample_id *ids, int count,
                        float *values)
{
    path_bundle *b = &w->bundle;
    b->count       = 0;
    for (int k = 0; k * LANES < count; k++) {
        vmask met = w->active[k] & (w->hits[k].instance >= 0);
        vsurface at;
        world_surface(v->s->world, &w->hits[k], met, &at);
        vmask back  = vdot(w->rays[k].direction, at.normal) > 0.0f;
        vvec3 n     = vselect3(back, vneg(at.normal), at.normal);
        vrgb albedo = materials_albedo(v->s->materials, at.material, met);
        vrgb glow   = materials_emission(v->s->materials, at.material, met);
        for (int i = 0; i < LANES && k * LANES + i < count; i++) {
            int at_sample             = k * LANES + i;
            float *to                 = values + at_sample;
            bool seen                 = vbits(met) >> i & 1;
            to[SEEN * BUNDLE]         = seen;
            to[DISTANCE * BUNDLE]     = seen ? lane(w->hits[k].distance, i) : 0.0f;
            to[(NORMAL + 0) * BUNDLE] = seen ? lane(n.x, i) : 0.0f;
            to[(NORMAL + 1) * BUNDLE] = seen ? lane(n.y, i) : 0.0f;
            to[(NORMAL + 2) * BUNDLE] = seen ? lane(n.z, i) : 0.0f;
            to[(ALBEDO + 0) * BUNDLE] = lane(albedo.x, i);
            to[(ALBEDO + 1) * BUNDLE] = lane(albedo.y, i);
            to[(ALBEDO + 2) * BUNDLE] = lane(albedo.z, i);
            to[RED * BUNDLE]          = lane(glow.x, i);
            to[GREEN * BUNDLE]        = lane(glow.y, i);
            to[BLUE * BUNDLE]         = lane(glow.z, i);
            to[ILLUMINANCE * BUNDLE]  = 0.0f;
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
    }
}

static void sample_pixels(void *context, int thread, const sample_id *ids, int count, float *values)
{
    view_run_state *v = context;
    view_scratch *w   = &v->threads[thread];
    path_bundle *b    = &w->bundle;
    trace_camera(v, w, ids, count);
    begin_paths(v, w, ids, count, values);
    path_trace(w->paths, b, true, !v->o->direct_only);

    for (int p = 0; p < b->count; p++) {
        float *to = values + w->sample_of[p], e[3];
        for (int c = 0; c < 3; c++) {
            e[c] = b->lamp[c][p] + b->glow[c][p] + b->indirect[c][p];
            to[(RED + c) * BUNDLE] += 0.318309886f * to[(ALBEDO + c) * BUNDLE] * e[c];
        }
        to[ILLUMINANCE * BUNDLE] =
            (float)LUMENS_PER_WATT * rgb_luminance((vec3){ e[0], e[1], e[2] });
    }
    for (int i = 0; i < count; i++) {
        vec3 rgb                       = { values[RED * BUNDLE + i], values[GREEN * BUNDLE + i],
                                           values[BLUE * BUNDLE + i] };
        values[LUMINANCE * BUNDLE + i] = (float)LUMENS_PER_WATT * rgb_luminance(rgb);
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
    return true;
}

static void take_pixels(const view_run_state *v, const accuracy_result *got, view_result *out)
{
    int items          = out->width * out->height;
    double maintenance = v->s->study->maintenance;
    const double *mean = got->mean;
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
        double luminance    = maintenance * mean[LUMINANCE * n + from];
        if (luminance > 0.0)
            logs += log(luminance), bright += 1.0;
    }
    out->log_average = bright > 0.0 ? exp(logs / bright) : 0.0;
    out->reached     = got->reached;
    out->end         = got->end;
}

static bool make_threads(view_run_state *v, arena *a, lux_error *err)
{
    v->threads = arena_array(a, view_scratch, (size_t)v->o->threads, err);
    for (int t = 0; v->threads && t < v->o->threads; t++) {
        v->threads[t].paths = path_tracer_new(a, v->s, err);
        if (!v->threads[t].paths)
            return false;
    }
    return v->threads != NULL;
}

static bool run(arena *a, arena *scratch, view_run_state *v, view_result *out, lux_error *err)
{
    if (!make_planes(a, out, err) || !make_threads(v, scratch, err))
        return false;
    accuracy_desc d = { .items         = out->width * out->height,
                        .channels      = CHANNELS,
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
    view_run_state v = { .s = s, .o = o, .seed = seed };
    if (!camera_of_view(s, view, &v.camera, err))
        return false;
    *out = (view_result){ .view   = view,
                          .width  = v.camera.width,
                          .height = v.camera.height,
                          .asked  = isnan(o->accuracy) ? VIEW_DEFAULT_PERCENT / 100.0 : o->accuracy,
                          .left_to_chance = scene_left_to_chance(s, o->direct_only) };
    progress_begin(o->progress, view->name);
    bool good = run(a, &scratch, &v, out, err);
    for (int t = 0; good && t < o->threads; t++)
        out->rays += v.threads[t].ray_count + path_rays(v.threads[t].paths);
    out->seconds = clock_seconds() - begun;
    arena_clear(&scratch);
    return good;
}
