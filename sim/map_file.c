/* sim/map_file.c -- see illumination_map.h: maps in files.
 *
 *     lux4maps  head  sheets  nodes  dimming of groups  values  checksum
 *
 * in the order of this machine's bytes, which `head.order` tells. A file is of a scene if its
 * fingerprints are: of geometry, of what materials do with light from some directions, of the first
 * particles that lights send out, and of how the map was asked for. Pieces of meshes follow from
 * the geometry, and are made anew.
 */
#include "sim/map_parts.h"

#include "core/file.h"

#include <string.h>

#define MAGIC "lux4maps"
enum { ORDER = 0x01020304, VERSION = 1 };
enum { PRINTED_PARTICLES = 4096 };
static const size_t most_file = (size_t)4 << 30; /* bytes */

typedef struct map_head {
    uint32_t order, version;
    uint64_t print[PRINTS], dimmed; /* dimmed: of what each lamp is dimmed to */
    uint32_t kind, slots, sensors, sheet_room, node_count, groups;
    map_figures figures;
} map_head;

/* ---- fingerprints ---------------------------------------------------------------------------- */

/* FNV-1a (Fowler, Noll, Vo), 64 bits. */
static const uint64_t fnv_start = 0xcbf29ce484222325;
static uint64_t fnv(uint64_t h, const void *bytes, size_t size)
{
    const unsigned char *b = bytes;
    for (size_t i = 0; i < size; i++)
        h = (h ^ b[i]) * 0x100000001b3;
    return h;
}

static uint64_t fnv_text(uint64_t h, const char *text)
{
    return text ? fnv(h, text, strlen(text) + 1) : fnv(h, "", 1);
}

static uint64_t fnv_packet(uint64_t h, vfloat a)
{
    float first = lane(a, 0);
    return fnv(h, &first, sizeof first);
}

static uint64_t print_of_mesh(uint64_t h, const world *w, int32_t instance)
{
    for (int32_t t = 0; t < world_triangles(w, instance); t++) {
        dvec3 c[3];
        uint32_t made_of = world_triangle(w, instance, t, c);
        h                = fnv(h, c, sizeof c);
        h                = fnv(h, &made_of, sizeof made_of);
    }
    return h;
}

static bool print_of_geometry(const scene *s, uint64_t *print, lux_error *err)
{
    arena scratch  = { 0 };
    const world *w = s->world;
    int32_t n      = world_instances(w);
    uint32_t most  = 0;
    for (int32_t i = 0; i < n; i++)
        most = world_mesh(w, i) >= most ? world_mesh(w, i) + 1 : most;
    bool *seen = arena_array(&scratch, bool, (size_t)most + 1, err);
    uint64_t h = fnv(fnv_start, &s->centre, sizeof s->centre);
    for (int32_t i = 0; seen && i < n; i++) {
        transform place = world_place(w, i);
        uint32_t of     = world_mesh(w, i);
        int32_t owner   = world_owner(w, i);
        h               = fnv(h, &place, sizeof place);
        h               = fnv(h, &of, sizeof of);
        h               = fnv(h, &owner, sizeof owner);
        if (!seen[of])
            h = print_of_mesh(h, w, i);
        seen[of] = true;
    }
    *print = h;
    arena_clear(&scratch);
    return seen != NULL;
}

/* What the material does with light that meets it steeply and slanting. */
static uint64_t print_of_deeds(uint64_t h, const scene *s, int index)
{
    static const vec3 ways[] = { { 0.0f, 0.0f, 1.0f },
                                 { 0.6f, 0.0f, 0.8f },
                                 { 0.0f, 0.96f, 0.28f } };
    vint which               = vsplat_int(index);
    for (int i = 0; i < 3; i++) {
        vshading at = { .wo       = vspread(ways[i]),
                        .n        = vspread((vec3){ 0, 0, 1 }),
                        .flat     = vspread((vec3){ 0, 0, 1 }),
                        .front    = ALL_LANES,
                        .distance = vsplat(1.0f),
                        .look     = look_plain(s->materials[index]) };
        vrgb albedo = materials_albedo(s->materials, which, &at, ALL_LANES);
        vrgb passes = materials_through(s->materials, which, &at, ALL_LANES);
        h           = fnv_packet(fnv_packet(fnv_packet(h, albedo.x), albedo.y), albedo.z);
        h           = fnv_packet(fnv_packet(fnv_packet(h, passes.x), passes.y), passes.z);
        for (int k = 0; k < 3; k++) {
            vvec3 wi  = vspread((vec3){ -ways[k].x, ways[k].y, ways[k].z });
            vrgb back = materials_reflect(s->materials, which, &at, &wi, ALL_LANES, NULL);
            h         = fnv_packet(fnv_packet(fnv_packet(h, back.x), back.y), back.z);
        }
    }
    return h;
}

static uint64_t print_of_materials(const scene *s)
{
    uint64_t h = fnv_start;
    for (int i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->material_info[i];
        h                       = fnv_text(fnv_text(fnv_text(h, m->name), m->kind), m->file);
        h                       = fnv(h, &m->reflectance, sizeof m->reflectance);
        h                       = fnv(h, &m->transmittance, sizeof m->transmittance);
        h                       = fnv(h, &m->there, sizeof m->there);
        h                       = fnv(h, &s->material_does[i], sizeof s->material_does[i]);
        h                       = print_of_deeds(h, s, i);
    }
    return h;
}

static uint64_t print_of_particle(uint64_t h, const vparticle *p, int i)
{
    const float numbers[] = { lane(p->ray.origin.x, i),    lane(p->ray.origin.y, i),
                              lane(p->ray.origin.z, i),    lane(p->ray.direction.x, i),
                              lane(p->ray.direction.y, i), lane(p->ray.direction.z, i),
                              lane(p->flux.x, i),          lane(p->flux.y, i),
                              lane(p->flux.z, i) };
    const int32_t whose[] = { lane(p->source, i), lane(p->group, i), lane(p->spare, i) };
    return fnv(fnv(h, numbers, sizeof numbers), whose, sizeof whose);
}

static bool print_of_lights(const scene *s, uint64_t *print, lux_error *err)
{
    arena scratch     = { 0 };
    const emission *e = emission_new(&scratch, s, err);
    uint64_t h        = fnv(fnv_start, &s->layered, sizeof s->layered);
    for (int g = 0; g < s->group_count; g++)
        h = fnv_text(h, s->groups[g]);
    h = fnv(h, &s->study->maintenance, sizeof s->study->maintenance);
    for (int k = 0; e && k < PRINTED_PARTICLES; k += LANES) {
        vparticle p;
        vuint index = vunsigned(vlane_index() + k);
        vmask drawn = emission_draw(e, index, vsplat_uint(1), ALL_LANES, &p);
        for (int bits = vbits(drawn); bits; bits &= bits - 1)
            h = print_of_particle(h, &p, __builtin_ctz((unsigned)bits));
    }
    *print = h;
    arena_clear(&scratch);
    return e != NULL;
}

static uint64_t print_of_run(const map_options *o)
{
    const double accuracy = o->particles > 0 ? 0.0 : o->accuracy;
    const int32_t kind    = (int32_t)o->light;
    uint64_t h            = fnv(fnv_start, &o->seed, sizeof o->seed);
    h                     = fnv(h, &kind, sizeof kind);
    h                     = fnv(h, &o->particles, sizeof o->particles);
    h                     = fnv(h, &accuracy, sizeof accuracy);
    if (!o->sensors || o->light != MAP_FOCUSED)
        return h;
    h = fnv(h, &o->sensors->side, sizeof o->sensors->side);
    h = fnv(h, &o->sensors->quantity, sizeof o->sensors->quantity);
    for (int i = 0; i < o->sensors->count; i++) {
        h = fnv(h, &o->sensors->at[i], sizeof *o->sensors->at);
        h = fnv(h, &o->sensors->normal[i], sizeof *o->sensors->normal);
    }
    return h;
}

bool map_prints(const scene *s, const map_options *o, uint64_t print[PRINTS], lux_error *err)
{
    print[PRINT_MATERIALS] = print_of_materials(s);
    print[PRINT_RUN]       = print_of_run(o);
    return print_of_geometry(s, &print[PRINT_GEOMETRY], err) &&
           print_of_lights(s, &print[PRINT_LIGHTS], err);
}

static uint64_t print_of_dimming(const scene *s)
{
    uint64_t h = fnv(fnv_start, &s->glow_dimming, sizeof s->glow_dimming);
    for (int l = 0; l < s->light_count; l++)
        h = fnv(h, &s->light_info[l].dimming, sizeof s->light_info[l].dimming);
    return h;
}

/* ---- writing --------------------------------------------------------------------------------- */

static void put(output_file *f, uint64_t *sum, const void *from, size_t bytes)
{
    *sum = fnv(*sum, from, bytes);
    if (bytes > 0)
        fwrite(from, 1, bytes, f->stream); /* what is lost, file_commit() finds */
}

static size_t value_count(size_t bins, uint32_t slots) { return bins * slots * SCRAMBLES * 3; }

bool illumination_map_write(const char *path, const illumination_map *m, lux_error *err)
{
    output_file f;
    if (!file_create(&f, path, err))
        return false;
    map_head head;
    memset(&head, 0, sizeof head); /* what lies between members, too */
    head.order      = ORDER;
    head.version    = VERSION;
    head.dimmed     = print_of_dimming(m->s);
    head.kind       = (uint32_t)m->kind;
    head.slots      = (uint32_t)m->slots;
    head.sensors    = (uint32_t)m->sensors;
    head.sheet_room = m->cells.sheet_room;
    head.node_count = (uint32_t)m->cells.node_count;
    head.groups     = (uint32_t)m->s->group_count;
    head.figures    = m->figures;
    memcpy(head.print, m->print, sizeof head.print);

    uint64_t sum = fnv_start;
    put(&f, &sum, MAGIC, strlen(MAGIC));
    put(&f, &sum, &head, sizeof head);
    put(&f, &sum, m->cells.sheets, head.sheet_room * sizeof *m->cells.sheets);
    put(&f, &sum, m->cells.nodes, head.node_count * sizeof *m->cells.nodes);
    put(&f, &sum, m->dimming, head.groups * sizeof *m->dimming);
    put(&f, &sum, m->values, value_count(map_bins(m), head.slots) * sizeof *m->values);
    uint64_t all = sum;
    put(&f, &sum, &all, sizeof all);
    return file_commit(&f, err);
}

/* ---- reading --------------------------------------------------------------------------------- */

static void *damaged(lux_error *err, const char *path, const char *what)
{
    return failed(err, ERR_FORMAT, "%s: damaged: %s", path, what);
}

typedef struct map_bytes {
    const char *at;
    size_t left;
} map_bytes;

static bool get(map_bytes *b, void *to, size_t bytes)
{
    if (bytes > b->left)
        return false;
    if (bytes > 0)
        memcpy(to, b->at, bytes);
    b->at += bytes;
    b->left -= bytes;
    return true;
}

/* How large the rest must be; SIZE_MAX where that is beyond any file. */
static size_t rest_of(const map_head *h)
{
    double bins  = (double)h->node_count + 2.0 * (double)h->sensors;
    double bytes = (double)h->sheet_room * sizeof(map_sheet) +
                   (double)h->node_count * sizeof(map_node) + (double)h->groups * sizeof(float) +
                   bins * (double)h->slots * SCRAMBLES * 3 * sizeof(float) + sizeof(uint64_t);
    return bytes <= (double)most_file ? (size_t)bytes : SIZE_MAX;
}

static const char *sheets_wrong(const scene *s, const map_cells *c)
{
    uint32_t empty = 0;
    for (uint32_t i = 0; i < c->sheet_room; i++) {
        const map_sheet *at = &c->sheets[i];
        empty += at->root == -1;
        if (at->root == -1)
            continue;
        if (at->root < 0 || at->root >= c->node_count || c->nodes[at->root].parent != -1)
            return "a tree without a root";
        if (at->instance < 0 || at->instance >= world_instances(s->world) ||
            (at->front != 0 && at->front != 1))
            return "a tree that lies nowhere";
        if (at->piece < 0 || at->piece >= c->meshes[world_mesh(s->world, at->instance)].pieces)
            return "a tree that lies nowhere";
    }
    return empty > 0 ? NULL : "a table that is full";
}

/* Children come behind their parents, so that ways down end. */
static const char *nodes_wrong(const map_cells *c)
{
    for (int32_t i = 0; i < c->node_count; i++) {
        const map_node *n = &c->nodes[i];
        if (!(n->area >= 0.0 && n->area <= 1e30))
            return "a cell's area";
        if (n->parent < -1 || n->parent >= i ||
            (n->walled != NODE_FREE && n->walled != NODE_WALLED))
            return "a cell";
        if (n->child == 0)
            continue;
        if (n->child <= i || n->child >= c->node_count - 1 || n->split < -3 ||
            c->nodes[n->child].parent != i || c->nodes[n->child + 1].parent != i)
            return "a cell's halves";
    }
    return NULL;
}

static const char *values_wrong(const illumination_map *m)
{
    size_t n = value_count(map_bins(m), (uint32_t)m->slots);
    for (size_t i = 0; i < n; i++)
        if (!isfinite(m->values[i]))
            return "a value";
    return NULL;
}

static bool get_arrays(arena *a, map_bytes *b, const map_head *h, illumination_map *m,
                       float *dimmed, lux_error *err)
{
    map_cells *c  = &m->cells;
    size_t values = value_count((size_t)h->node_count + 2 * (size_t)h->sensors, h->slots);
    c->sheet_room = h->sheet_room;
    c->node_count = (int32_t)h->node_count;
    c->sheets     = arena_array(a, map_sheet, h->sheet_room, err);
    c->nodes      = arena_array(a, map_node, (size_t)h->node_count + 1, err);
    m->values     = arena_array(a, float, values + 1, err);
    return c->sheets && c->nodes && m->values &&
           get(b, c->sheets, h->sheet_room * sizeof *c->sheets) &&
           get(b, c->nodes, h->node_count * sizeof *c->nodes) &&
           get(b, dimmed, h->groups * sizeof *dimmed) &&
           get(b, m->values, values * sizeof *m->values);
}

/* Of which scene a file is. */
static const char *differs_in(const map_head *h, const uint64_t print[PRINTS])
{
    static const char *const of[PRINTS] = { [PRINT_GEOMETRY]  = "geometry",
                                            [PRINT_MATERIALS] = "materials",
                                            [PRINT_LIGHTS]    = "lights",
                                            [PRINT_RUN]       = "seed, particles or accuracy" };
    for (int i = 0; i < PRINTS; i++)
        if (h->print[i] != print[i])
            return of[i];
    return NULL;
}

/* All light, as groups are now dimmed; false where lamps of a group differ, and have changed. */
static bool dim_anew(illumination_map *m, uint64_t dimmed, const float *before)
{
    if (dimmed == print_of_dimming(m->s))
        return true;
    for (int g = 0; g < m->slots - 1; g++)
        if (isnan(m->dimming[g]) || isnan(before[g]))
            return false;
    for (size_t bin = 0; m->slots > 1 && bin < map_bins(m); bin++)
        for (size_t i = 0; i < SCRAMBLES * 3; i++) {
            double sum = 0.0;
            for (int g = 0; g < m->slots - 1; g++)
                sum +=
                    (double)m->dimming[g] * (double)m->values[map_value_at(m, bin, 1 + g, 0) + i];
            m->values[map_value_at(m, bin, 0, 0) + i] = (float)sum;
        }
    return true;
}

/* The head, if the file is whole. */
static bool open_bytes(const char *path, map_bytes *b, map_head *h, lux_error *err)
{
    char magic[sizeof MAGIC - 1];
    const char *begin = b->at;
    size_t size       = b->left;
    if (!get(b, magic, sizeof magic) || memcmp(magic, MAGIC, sizeof magic) != 0)
        return failed(err, ERR_FORMAT, "%s: no file of illumination maps", path);
    if (!get(b, h, sizeof *h))
        return damaged(err, path, "it ends early");
    if (h->order != ORDER || h->version != VERSION)
        return failed(err, ERR_UNSUPPORTED, "%s: maps of another version or machine", path);
    if (b->left != rest_of(h))
        return damaged(err, path, "its size");
    uint64_t sum;
    memcpy(&sum, begin + size - sizeof sum, sizeof sum);
    return sum == fnv(fnv_start, begin, size - sizeof sum) ||
           damaged(err, path, "its checksum") != NULL;
}

static const illumination_map *read_bytes(arena *a, const char *path, map_bytes *b,
                                          illumination_map *m, const map_options *o,
                                          const char **why, lux_error *err)
{
    map_head h;
    uint64_t print[PRINTS];
    if (!open_bytes(path, b, &h, err) || !map_prints(m->s, o, print, err))
        return NULL;
    *why = differs_in(&h, print);
    if (*why)
        return NULL;
    int sensors  = o->sensors && o->light == MAP_FOCUSED ? o->sensors->count : 0;
    float *after = NULL;
    if (h.kind != (uint32_t)o->light || h.slots != (uint32_t)m->slots ||
        h.sensors != (uint32_t)sensors || h.groups != (uint32_t)m->s->group_count ||
        h.node_count >= INT32_MAX || h.sheet_room == 0 || (h.sheet_room & (h.sheet_room - 1)))
        return damaged(err, path, "its counts");
    float *before = arena_array(a, float, (size_t)h.groups + 1, err);
    m->sensors    = sensors;
    m->figures    = h.figures;
    memcpy(m->print, h.print, sizeof m->print);
    if (!before || !map_dimmings(a, m->s, &after, err) ||
        !map_meshes_new(a, m->s, &m->cells, err) || !get_arrays(a, b, &h, m, before, err))
        return NULL;
    m->dimming        = after;
    const char *wrong = nodes_wrong(&m->cells);
    wrong             = wrong ? wrong : sheets_wrong(m->s, &m->cells);
    wrong             = wrong ? wrong : values_wrong(m);
    if (wrong)
        return damaged(err, path, wrong);
    if (!dim_anew(m, h.dimmed, before)) {
        *why = "dimming of lamps within a group";
        return NULL;
    }
    return map_find_smoothing(a, m, err) ? m : NULL;
}

const illumination_map *illumination_map_read(arena *a, const char *path, const scene *s,
                                              const map_options *o, const char **why,
                                              lux_error *err)
{
    *why       = NULL;
    FILE *file = fopen(path, "rb");
    if (!file)
        return NULL;
    fclose(file);
    arena scratch               = { 0 };
    map_bytes b                 = { 0 };
    b.at                        = file_read(&scratch, path, most_file, &b.left, err);
    illumination_map *m         = b.at ? arena_new(a, illumination_map, err) : NULL;
    const illumination_map *got = NULL;
    if (m) {
        *m = (illumination_map){
            .s = s, .kind = o->light, .seed = o->seed, .slots = s->layered ? 1 + s->group_count : 1
        };
        got = read_bytes(a, path, &b, m, o, why, err);
    }
    arena_clear(&scratch);
    return got;
}
