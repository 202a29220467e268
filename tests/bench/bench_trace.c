/* tests/bench/bench_trace.c -- rays a second, beside one ray at a time and beside Embree 3.
 *
 *     bench_trace ONE_LANE_PROGRAM    the table; the program is this one, built with WIDTH=1
 *     bench_trace --serve             what runs in that: reads "scene kind", writes seconds
 *
 * All sides trace the same rays through the same triangles on one thread, in turn, in short
 * rounds, so that whatever else the machine does meets all of them; the best round counts, by
 * the thread's own clock. Embree gets its rays laid out as it wants them before its clock
 * starts. "robust" is its mode that keeps rays from slipping through edges, as ours does.
 */
#include "core/packet_math.h"
#include "core/world.h"
#include "sim/gltf.h"
#include "tests/shapes.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>
#include <unistd.h>

enum { SIDE = 512, RAYS = SIDE * SIDE, PACKETS = RAYS / LANES, BATCH = 256 / LANES };
enum { SCENES = 5, ROUNDS = 9 };
typedef enum kind { CAMERA, SHADOW, DIFFUSE, KINDS } kind;

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- scenes: the office, the same modelled finer, a room full of glass, a car ---------------- */

static const struct {
    const char *file;
    vec3 lamp; /* m, to which shadow rays go */
} models[SCENES] = {
    { "data/office/office.glb", { 5.4f, 3.9f, 2.85f } },
    { "build/bench/office-65000.glb", { 5.4f, 3.9f, 2.85f } },
    { "build/bench/office-270000.glb", { 5.4f, 3.9f, 2.85f } },
    { "data/glass/glass.glb", { 2.15f, 2.05f, 1.7f } },
    { "data/car/car.glb", { 1.2f, -5.2f, 2.2f } },
};

/* All triangles of the file in one mesh, as Embree gets them too; *eye: its first camera. */
static void read_scene(shape *s, transform *eye, const char *path)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    const gltf *g = gltf_read(&a, path, NULL, &err);
    if (!g || !g->camera_count) {
        fprintf(stderr, "bench_trace: %s\n", g ? "no camera" : err.text);
        exit(1);
    }
    for (uint32_t k = 0; k < g->placement_count; k++) {
        const gltf_placement *p = &g->placements[k];
        const mesh *m           = &g->meshes[p->mesh].triangles;
        uint32_t first          = s->position_count;
        for (uint32_t v = 0; v < m->position_count; v++)
            shape_point(s, d3_to_float(transform_point(&p->place, d3_from(m->positions[v]))));
        for (uint32_t t = 0; t < m->triangle_count; t++)
            shape_triangle(s, first + m->corners[3 * t], first + m->corners[3 * t + 1],
                           first + m->corners[3 * t + 2]);
    }
    *eye = g->cameras[0].place;
    arena_clear(&a);
}

/* ---- rays ------------------------------------------------------------------------------------ */

typedef struct scene {
    arena memory;
    shape s;
    transform eye; /* looks along -z */
    world *w;
    vray *rays[KINDS];
    vmask *active[KINDS];
    vhit *hits;
    vmask *blocked;
} scene;

static void *room_for(size_t count, size_t size)
{
    void *p = aligned_alloc(64, (count * size + 63) / 64 * 64);
    if (!p)
        abort();
    return p;
}

/* Every second bit of n: neighbouring numbers are neighbouring pixels. */
static int even_bits(int n)
{
    int r = 0;
    for (int k = 0; k < 12; k++)
        r |= (n >> 2 * k & 1) << k;
    return r;
}

static void camera_rays(scene *c)
{
    vec3 eye = d3_to_float(transform_point(&c->eye, (dvec3){ 0, 0, 0 }));
    for (int n = 0; n < RAYS; n++) {
        double x = 2.0 * (even_bits(n) + 0.5) / SIDE - 1.0;
        double y = 2.0 * (even_bits(n >> 1) + 0.5) / SIDE - 1.0;
        dvec3 d  = transform_vector(&c->eye, (dvec3){ 0.7 * x, 0.7 * y, -1.0 });
        ray_set(&c->rays[CAMERA][n / LANES], n % LANES, eye,
                d3_to_float(d3_scale(d, 1.0 / d3_length(d))), INFINITY);
    }
    for (int i = 0; i < PACKETS; i++)
        c->active[CAMERA][i] = ALL_LANES;
}

/* From where the camera's rays end to a lamp, and anywhere by the cosine law */
static void further_rays(scene *c, vec3 at)
{
    const vvec3 lamp = vspread(at);
    uint32_t seed    = 5;
    for (int i = 0; i < PACKETS; i++) {
        vsurface s;
        vmask met = c->hits[i].instance >= vsplat_int(0);
        world_surface(c->w, &c->hits[i], met, &s);
        vvec3 seen = c->rays[CAMERA][i].direction;
        s.normal   = vselect3(vdot(s.normal, seen) > 0.0f, vneg(s.normal), s.normal);

        vvec3 way            = vnormalize(vsub(lamp, s.position));
        vvec3 start          = vray_start(&s, &way);
        vfloat reach         = vlength(vsub(lamp, start));
        c->rays[SHADOW][i]   = (vray){ start, way, reach };
        c->active[SHADOW][i] = met & (vdot(way, s.normal) > 0.0f);

        float a[LANES], b[LANES];
        for (int k = 0; k < LANES; k++) {
            a[k] = random_unit(&seed);
            b[k] = random_unit(&seed);
        }
        vfloat x, y;
        vvec3 u, v;
        vsquare_to_disk(vload(a), vload(b), &x, &y);
        vframe(s.normal, &u, &v);
        vfloat z     = vsqrt(vmax(vsplat(1e-6f), 1.0f - x * x - y * y));
        vvec3 bounce = vadd(vadd(vscale(u, x), vscale(v, y)), vscale(s.normal, z));
        c->rays[DIFFUSE][i] =
            (vray){ vray_start(&s, &bounce), vnormalize(bounce), vsplat(INFINITY) };
        c->active[DIFFUSE][i] = met;
    }
}

static double trace(scene *c, kind k)
{
    double start  = seconds();
    ray_hint hint = k == DIFFUSE ? RAYS_INCOHERENT : RAYS_COHERENT;
    for (int i = 0; i < PACKETS; i += BATCH) {
        if (k == SHADOW)
            world_any_hit(c->w, c->rays[k] + i, c->active[k] + i, NULL, BATCH, hint,
                          c->blocked + i);
        else
            world_first_hit(c->w, c->rays[k] + i, c->active[k] + i, BATCH, hint, c->hits + i);
    }
    return seconds() - start;
}

static void scene_make(scene *c, int number)
{
    read_scene(&c->s, &c->eye, models[number].file);
    static const world_instance one = { .place = TRANSFORM_IDENTITY };
    mesh m                          = shape_mesh(&c->s);
    lux_error err;
    c->w = world_new(&c->memory, &(world_desc){ &m, 1, &one, 1, TRIANGLE_WATERTIGHT, 1 }, &err);
    if (!c->w)
        abort();
    for (int k = 0; k < KINDS; k++) {
        c->rays[k]   = room_for(PACKETS, sizeof(vray));
        c->active[k] = room_for(PACKETS, sizeof(vmask));
        memset(c->rays[k], 0, PACKETS * sizeof(vray));
    }
    c->hits    = room_for(PACKETS, sizeof(vhit));
    c->blocked = room_for(PACKETS, sizeof(vmask));
    camera_rays(c);
    trace(c, CAMERA);
    further_rays(c, models[number].lamp);
}

static void scene_clear(scene *c)
{
    for (int k = 0; k < KINDS; k++) {
        free(c->rays[k]);
        free(c->active[k]);
    }
    free(c->hits);
    free(c->blocked);
    shape_clear(&c->s);
    arena_clear(&c->memory);
    *c = (scene){ 0 };
}

/* ---- one lane, in a process of its own ------------------------------------------------------- */

static int serve(void)
{
    scene c  = { 0 };
    int have = -1, number, k;
    while (scanf("%d %d", &number, &k) == 2) {
        if (number != have) {
            scene_clear(&c);
            scene_make(&c, number);
            have = number;
        }
        printf("%.9g\n", trace(&c, (kind)k));
        fflush(stdout);
    }
    scene_clear(&c);
    return 0;
}

#if PACKET_WIDTH == 4
#include <embree3/rtcore.h>

/* ---- Embree ---------------------------------------------------------------------------------- */

typedef struct embree {
    RTCDevice device;
    RTCScene scene;
    struct RTCRayHit4 *rays;
    int *valid;
} embree;

static embree embree_make(const char *options, bool robust, const scene *c)
{
    embree e        = { .device = rtcNewDevice(options) };
    e.scene         = rtcNewScene(e.device);
    e.rays          = room_for(PACKETS, sizeof *e.rays);
    e.valid         = room_for(RAYS, sizeof *e.valid);
    RTCGeometry g   = rtcNewGeometry(e.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    void *positions = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                              sizeof(vec3), c->s.position_count);
    void *corners   = rtcSetNewGeometryBuffer(g, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                              c->s.triangle_count);
    memcpy(positions, c->s.positions, c->s.position_count * sizeof(vec3));
    memcpy(corners, c->s.corners, c->s.triangle_count * (size_t)12);
    rtcCommitGeometry(g);
    rtcAttachGeometry(e.scene, g);
    rtcReleaseGeometry(g);
    if (robust)
        rtcSetSceneFlags(e.scene, RTC_SCENE_FLAG_ROBUST);
    rtcCommitScene(e.scene);
    return e;
}

static double embree_trace(embree *e, const scene *c, kind k)
{
    memset(e->rays, 0, PACKETS * sizeof *e->rays);
    for (int i = 0; i < PACKETS; i++) {
        const vray *r      = &c->rays[k][i];
        struct RTCRay4 *to = &e->rays[i].ray;
        vstore(to->org_x, r->origin.x);
        vstore(to->org_y, r->origin.y);
        vstore(to->org_z, r->origin.z);
        vstore(to->dir_x, r->direction.x);
        vstore(to->dir_y, r->direction.y);
        vstore(to->dir_z, r->direction.z);
        vstore(to->tfar, r->reach);
        vstore_int(e->valid + i * LANES, c->active[k][i]);
        memset(to->mask, -1, sizeof to->mask);
        memset(e->rays[i].hit.geomID, -1, sizeof e->rays[i].hit.geomID);
        memset(e->rays[i].hit.instID, -1, sizeof e->rays[i].hit.instID);
    }
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    context.flags =
        k == DIFFUSE ? RTC_INTERSECT_CONTEXT_FLAG_INCOHERENT : RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    double start = seconds();
    for (int i = 0; i < PACKETS; i++) {
        if (k == SHADOW)
            rtcOccluded4(e->valid + i * LANES, e->scene, &context, &e->rays[i].ray);
        else
            rtcIntersect4(e->valid + i * LANES, e->scene, &context, &e->rays[i]);
    }
    return seconds() - start;
}

/* Rays of which Embree says something else, by more than 20 um and 1e-4 of the distance. */
static int differing(const embree *e, const scene *c, kind k)
{
    int n = 0;
    for (int i = 0; i < PACKETS; i++) {
        vfloat other = vload(e->rays[i].ray.tfar);
        vmask apart  = k == SHADOW ? c->blocked[i] ^ (other < 0.0f)
                                   : ~(vabs(c->hits[i].distance - other) <= 1e-4f * other + 2e-5f);
        n += __builtin_popcount((unsigned)vbits(apart & c->active[k][i]));
    }
    return n;
}

static void embree_clear(embree *e)
{
    rtcReleaseScene(e->scene);
    rtcReleaseDevice(e->device);
    free(e->rays);
    free(e->valid);
}

/* ---- the table ------------------------------------------------------------------------------- */

typedef struct server {
    FILE *to, *from;
} server;

static server server_start(const char *program)
{
    int there[2], back[2];
    if (pipe(there) || pipe(back))
        abort();
    pid_t child = fork();
    if (child == 0) {
        dup2(there[0], 0);
        dup2(back[1], 1);
        close(there[1]);
        close(back[0]);
        execl(program, program, "--serve", (char *)NULL);
        _exit(1);
    }
    close(there[0]);
    close(back[1]);
    return (server){ fdopen(there[1], "w"), fdopen(back[0], "r") };
}

static double server_trace(server *s, int scene_number, kind k)
{
    double t = 0.0;
    fprintf(s->to, "%d %d\n", scene_number, (int)k);
    fflush(s->to);
    if (fscanf(s->from, "%lf", &t) != 1) {
        fprintf(stderr, "bench_trace: the program of one lane does not answer\n");
        exit(1);
    }
    return t;
}

enum { OURS, ONE_LANE, EMBREE, ROBUST, EMBREE_BEST, SIDES };
static const char *const kind_names[KINDS] = { "camera", "shadow", "diffuse" };

static void print_row(int triangles, kind k, double rays, const double best[SIDES], int apart)
{
    printf("%8d  %-8s", triangles, kind_names[k]);
    for (int i = 0; i < SIDES; i++)
        printf("%9.2f", 1e-6 * rays / best[i]);
    printf("%9.2f%9.2f%9.2f%7d\n", best[ONE_LANE] / best[OURS], best[EMBREE] / best[OURS],
           best[ROBUST] / best[OURS], apart);
    fflush(stdout);
}

static int count_active(const scene *c, kind k)
{
    int n = 0;
    for (int i = 0; i < PACKETS; i++)
        n += __builtin_popcount((unsigned)vbits(c->active[k][i]));
    return n;
}

static void bench_scene(int number, server *one_lane)
{
    scene c = { 0 };
    scene_make(&c, number);
    embree sse    = embree_make("threads=1,isa=sse4.2", false, &c);
    embree robust = embree_make("threads=1,isa=sse4.2", true, &c);
    embree full   = embree_make("threads=1", false, &c);
    for (int k = 0; k < KINDS; k++) {
        double best[SIDES] = { HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL, HUGE_VAL };
        for (int round = 0; round < ROUNDS; round++) {
            best[OURS]        = fmin(best[OURS], trace(&c, (kind)k));
            best[EMBREE]      = fmin(best[EMBREE], embree_trace(&sse, &c, (kind)k));
            best[ONE_LANE]    = fmin(best[ONE_LANE], server_trace(one_lane, number, (kind)k));
            best[ROBUST]      = fmin(best[ROBUST], embree_trace(&robust, &c, (kind)k));
            best[EMBREE_BEST] = fmin(best[EMBREE_BEST], embree_trace(&full, &c, (kind)k));
        }
        print_row((int)c.s.triangle_count, (kind)k, count_active(&c, (kind)k), best,
                  differing(&sse, &c, (kind)k));
    }
    world_stats s = world_statistics(c.w);
    printf("%8d  %.0f bytes a triangle, built in %.2f s on one thread\n", (int)s.triangles,
           (double)s.bytes / (double)s.triangles, s.build_seconds);
    embree_clear(&sse);
    embree_clear(&robust);
    embree_clear(&full);
    scene_clear(&c);
}

static int table(const char *one_lane)
{
    server s = server_start(one_lane);
    printf("million rays a second, one thread; best of %d rounds\n", ROUNDS);
    printf(
        "                   WIDTH=%d  WIDTH=1   Embree   Embree   Embree  ratio of WIDTH=%d to   "
        "hits\n"
        "triangles rays                       sse4.2   robust     best  WIDTH=1   sse4.2   robust"
        "  apart\n",
        LANES, LANES);
    for (int i = 0; i < SCENES; i++)
        bench_scene(i, &s);
    fclose(s.to);
    fclose(s.from);
    return 0;
}
#else
static int table(const char *one_lane)
{
    fprintf(stderr, "bench_trace: wants WIDTH=4, beside %s\n", one_lane);
    return 1;
}
#endif

int main(int argc, char **argv)
{
    if (argc == 2 && strcmp(argv[1], "--serve") == 0)
        return serve();
    if (argc == 2)
        return table(argv[1]);
    fprintf(stderr, "use: bench_trace ONE_LANE_PROGRAM\n");
    return 2;
}
