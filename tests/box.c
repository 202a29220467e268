/* tests/box.c -- a closed box as a scene, without study or file: what furnaces are made of. */
#include "tests/box.h"

#include "sim/room.h"
#include "tests/test.h"

/* The glowing triangles as lights, and no lamps. */
static void add_emitters(arena *a, scene *s, const mesh *m, const vec3 emission[ROOM_MATERIALS])
{
    const light **lights = arena_array(a, const light *, ROOM_TRIANGLES, NULL);
    int32_t *of          = arena_array(a, int32_t, ROOM_TRIANGLES, NULL);
    int32_t *numbers     = arena_array(a, int32_t, ROOM_TRIANGLES, NULL);
    int64_t *first       = arena_new(a, int64_t, NULL);
    light_set *set       = arena_new(a, light_set, NULL);
    for (uint32_t t = 0; t < m->triangle_count; t++) {
        triangle_desc d = { .radiance = emission[m->material[t]] };
        for (uint32_t c = 0; c < 3; c++)
            d.corner[c] = m->positions[m->corners[3 * t + c]];
        of[t] = -1;
        if (!(d.radiance.x > 0.0f))
            continue;
        of[t]                      = s->emitter_count;
        numbers[s->emitter_count]  = s->emitter_count;
        lights[s->emitter_count++] = light_triangle(a, &d, NULL);
    }
    *set             = (light_set){ .lights   = numbers,
                                    .emitters = s->emitter_count,
                                    .tree     = light_tree_new(a, lights, s->emitter_count, NULL) };
    s->lights        = lights;
    s->first_emitter = first;
    s->emitter_of    = of;
    s->sets          = set;
    s->set_count     = 1;
    s->glow_set      = *set;
    s->glow_dimming  = 1.0f;
    assert_non_null(set->tree);
}

const scene *box_scene(arena *a, dvec3 size, const vec3 reflectance[ROOM_MATERIALS],
                       const vec3 emission[ROOM_MATERIALS], bool lid)
{
    dvec3 corner[ROOM_POSITIONS];
    vec3 *positions    = arena_array(a, vec3, ROOM_POSITIONS, NULL);
    uint32_t *corners  = arena_array(a, uint32_t, 3 * ROOM_TRIANGLES, NULL);
    uint32_t *made_of  = arena_array(a, uint32_t, ROOM_TRIANGLES, NULL);
    const material **m = arena_array(a, const material *, ROOM_MATERIALS, NULL);
    scene *s           = arena_new(a, scene, NULL);
    study *from        = arena_new(a, study, NULL);
    room_box(size, corner, corners, made_of);
    for (int i = 0; i < ROOM_POSITIONS; i++)
        positions[i] = d3_to_float(corner[i]);

    bool glows = false;
    for (int i = 0; i < ROOM_MATERIALS; i++) {
        m[i] = material_diffuse(a, &(diffuse_desc){ reflectance[i], { .emission = emission[i] } },
                                NULL);
        assert_non_null(m[i]);
        glows |= emission[i].x > 0.0f;
    }

    /* Without its lid, the ceiling, which comes second of the six faces, is left out */
    uint32_t *shown = arena_array(a, uint32_t, 3 * ROOM_TRIANGLES, NULL);
    uint32_t *of = arena_array(a, uint32_t, ROOM_TRIANGLES, NULL), count = 0;
    for (uint32_t t = 0; t < ROOM_TRIANGLES; t++) {
        if (!lid && made_of[t] == ROOM_CEILING)
            continue;
        for (uint32_t c = 0; c < 3; c++)
            shown[3 * count + c] = corners[3 * t + c];
        of[count++] = made_of[t];
    }
    mesh box          = { positions, shown, of, ROOM_POSITIONS, count };
    world_instance in = { .place = TRANSFORM_IDENTITY };
    *from    = (study){ .path = "box", .folder = ".", .maintenance = 1.0, .accuracy = (double)NAN };
    s->study = from;
    s->world = world_new(a, &(world_desc){ &box, 1, &in, 1, TRIANGLE_WATERTIGHT, 1 }, NULL);
    s->high  = size;
    s->material_count = ROOM_MATERIALS;
    s->materials      = m;
    s->glows          = glows;
    s->reflects       = true;
    add_emitters(a, s, &box, emission);
    assert_non_null(s->world);
    return s;
}
