/* sim/swatch.c -- see swatch.h. The room is a study, the ball and the floor a model in memory. */
#include "sim/swatch.h"

#include "sim/gltf.h"
#include "sim/render.h"

#include <string.h>

static const char room[] =
    "lux4: 1\n"
    "room: {size: [6, 6, 3], reflectance: 0.5}\n"
    "scene: ball\n"
    "lights:\n"
    "  - {type: rect, at: [1.6, 1.8, 2.9], aim_at: [3, 3, 0.5], size: [2, 1], luminance: 3000}\n"
    "  - {type: disk, at: [5, 2.2, 2.6], aim_at: [3, 3, 0.5], radius: 0.1, luminance: 60000}\n"
    "views: [{name: ball, eye: [3, 0.4, 1.2], target: [3, 3, 0.45], fov: 31, size: [256, 256]}]\n";

static const double ACCURACY = 1.0; /* if not said: 32 samples for all but a few pixels */

/* ---- the model ------------------------------------------------------------------------------- */

enum { RINGS = 96, SECTORS = 192, SQUARES = 16 };
enum { OF_BALL, OF_DARK, OF_LIGHT, MATERIALS };
enum {
    CORNERS   = (RINGS + 1) * SECTORS + 4 * SQUARES * SQUARES,
    TRIANGLES = 2 * SECTORS * (RINGS - 1) + 2 * SQUARES * SQUARES,
};

static const double RADIUS = 0.5, SQUARE = 0.25, LIFTED = 0.001; /* m */
static const dvec3 CENTRE = { 3.0, 3.0, 0.501 };

typedef struct model {
    vec3 *positions, *normals;
    uint32_t *corners, *material;
    uint32_t position_count, triangle_count;
} model;

static void add_corner(model *m, dvec3 at) { m->positions[m->position_count++] = d3_to_float(at); }

/* The ball's is smooth: its normals point away from the centre. */
static void add_triangle(model *m, uint32_t a, uint32_t b, uint32_t c, uint32_t made_of)
{
    const uint32_t at[3] = { a, b, c }, t = m->triangle_count++;
    for (uint32_t k = 0; k < 3; k++) {
        dvec3 out             = d3_sub(d3_from(m->positions[at[k]]), CENTRE);
        m->corners[3 * t + k] = at[k];
        if (made_of == OF_BALL)
            m->normals[3 * t + k] = d3_to_float(d3_scale(out, 1.0 / d3_length(out)));
    }
    m->material[t] = made_of;
}

/* Rings of corners from the top down. */
static void add_ball(model *m)
{
    for (int i = 0; i < (RINGS + 1) * SECTORS; i++) {
        double theta = M_PI * (i / SECTORS) / RINGS, phi = 2.0 * M_PI * (i % SECTORS) / SECTORS;
        dvec3 n = { sin(theta) * cos(phi), sin(theta) * sin(phi), cos(theta) };
        add_corner(m, d3_add(CENTRE, d3_scale(n, RADIUS)));
    }
    for (uint32_t r = 0; r < RINGS; r++)
        for (uint32_t s = 0; s < SECTORS; s++) {
            uint32_t a = r * SECTORS + s, b = r * SECTORS + (s + 1) % SECTORS;
            if (r > 0)
                add_triangle(m, a, a + SECTORS, b, OF_BALL);
            if (r + 1 < RINGS)
                add_triangle(m, b, a + SECTORS, b + SECTORS, OF_BALL);
        }
}

static void add_floor(model *m)
{
    for (int i = 0; i < SQUARES * SQUARES; i++) {
        int column = i % SQUARES, row = i / SQUARES;
        dvec3 p       = { CENTRE.x + (column - SQUARES / 2) * SQUARE,
                          CENTRE.y + (row - SQUARES / 2) * SQUARE, LIFTED };
        uint32_t from = m->position_count, of = (column + row) % 2 ? OF_LIGHT : OF_DARK;
        for (int k = 0; k < 4; k++)
            add_corner(m, (dvec3){ p.x + k % 2 * SQUARE, p.y + k / 2 * SQUARE, p.z });
        add_triangle(m, from, from + 1, from + 3, of);
        add_triangle(m, from, from + 3, from + 2, of);
    }
}

static const char *const names[MATERIALS + 1] = { "ball", "dark", "light", "" };

/* One mesh in its own place. */
static bool make_rest(arena *a, gltf *g, const model *m, lux_error *err)
{
    g->materials  = arena_array(a, gltf_material, MATERIALS + 1, err);
    g->meshes     = g->materials ? arena_new(a, gltf_mesh, err) : NULL;
    g->placements = g->meshes ? arena_new(a, gltf_placement, err) : NULL;
    g->nodes      = g->placements ? arena_new(a, gltf_node, err) : NULL;
    if (!g->nodes)
        return false;
    const transform here = { { { 1, 0, 0, 0 }, { 0, 1, 0, 0 }, { 0, 0, 1, 0 } } };
    g->material_count    = MATERIALS + 1;
    g->mesh_count = g->placement_count = g->node_count = 1;
    for (int i = 0; i <= MATERIALS; i++)
        g->materials[i] = (gltf_material){ .name                 = names[i],
                                           .base_color           = { 1, 1, 1 },
                                           .alpha                = 1,
                                           .roughness            = 1,
                                           .ior                  = 1.5f,
                                           .specular             = 1,
                                           .specular_color       = { 1, 1, 1 },
                                           .attenuation_distance = INFINITY,
                                           .attenuation_color    = { 1, 1, 1 } };
    g->meshes[0]     = (gltf_mesh){ .name      = "",
                                    .triangles = { .positions      = m->positions,
                                                   .corners        = m->corners,
                                                   .material       = m->material,
                                                   .position_count = m->position_count,
                                                   .triangle_count = m->triangle_count,
                                                   .normals        = m->normals } };
    g->placements[0] = (gltf_placement){ .place = here };
    g->nodes[0]      = (gltf_node){ .name = "", .place = here, .parent = -1 };
    return true;
}

static const gltf *make_model(arena *a, lux_error *err)
{
    model m     = { 0 };
    gltf *g     = arena_new(a, gltf, err);
    m.positions = g ? arena_array(a, vec3, CORNERS, err) : NULL;
    m.normals   = m.positions ? arena_array(a, vec3, 3 * TRIANGLES, err) : NULL;
    m.corners   = m.normals ? arena_array(a, uint32_t, 3 * TRIANGLES, err) : NULL;
    m.material  = m.corners ? arena_array(a, uint32_t, TRIANGLES, err) : NULL;
    if (!m.material)
        return NULL;
    add_ball(&m);
    add_floor(&m);
    return make_rest(a, g, &m, err) ? g : NULL;
}

/* ---- the picture ----------------------------------------------------------------------------- */

static study_material matt(const char *name, float reflectance)
{
    return (study_material){ .match       = name,
                             .surface     = SURFACE_MATT,
                             .reflectance = { reflectance, reflectance, reflectance },
                             .exponent    = (double)NAN };
}

static bool render(arena *a, const study_material *m, const run_options *o, view_result *out,
                   lux_error *err)
{
    const study *parsed = study_parse(a, "swatch", NULL, room, strlen(room), NULL, err);
    const gltf *ball    = parsed ? make_model(a, err) : NULL;
    if (!ball)
        return false;
    study_material made[MATERIALS] = { [OF_BALL]  = *m,
                                       [OF_DARK]  = matt(names[OF_DARK], 0.15f),
                                       [OF_LIGHT] = matt(names[OF_LIGHT], 0.6f) };
    made[OF_BALL].match            = names[OF_BALL];
    study s                        = *parsed;
    s.materials                    = made;
    s.material_count               = MATERIALS;

    scene_options of_scene = { .threads = o->threads, .models = &ball };
    run_options run        = *o;
    run.accuracy           = isnan(o->accuracy) ? ACCURACY : o->accuracy;
    const scene *whole     = scene_new(a, &s, &of_scene, NULL, err);
    return whole && view_run(a, whole, &s.views[0], &run, out, err);
}

bool swatch_write(const study_material *m, const char *picture, const run_options *o,
                  lux_error *err)
{
    arena a = { 0 };
    view_result r;
    bool good = render(&a, m, o, &r, err);
    if (good && r.end == RUN_INTERRUPTED)
        good = failed(err, ERR_INTERRUPTED, "%s: interrupted", picture);
    good = good && view_write_png(picture, &r, 0.0, err);
    arena_clear(&a);
    return good;
}
