/* sim/scene_bounds.c -- where a scene's surfaces are, how often each mesh stands. */
#include "sim/room.h"
#include "sim/scene_build.h"

enum { MOST_PLACED = 1 << 24 }; /* meshes in their places, all copies counted */

int scene_first_use(const scene_build *b, int i)
{
    int j = 0;
    while (b->files[j] != b->files[i])
        j++;
    return j;
}

/* How often each mesh of each file stands in the scene. */
static bool count_places(scene_build *b)
{
    const study *s  = b->study;
    size_t all      = 0;
    uint32_t **made = arena_array(b->a, uint32_t *, (size_t)s->scene_count + 1, b->err);
    if (!made)
        return false;
    for (int i = 0; i < s->scene_count; i++) {
        const gltf *g = b->files[i];
        size_t copies = (size_t)s->scenes[i].at_count;
        int first     = scene_first_use(b, i);
        made[i] = first < i ? made[first] : arena_array(b->a, uint32_t, g->mesh_count + 1, b->err);
        if (!made[i])
            return false;
        all += copies * g->placement_count;
        if (all > MOST_PLACED)
            return study_failed(s, s->scenes[i].where, b->err, ERR_ARGUMENT,
                                "more than %d meshes are placed in the scene", MOST_PLACED);
        for (uint32_t k = 0; k < g->placement_count; k++)
            made[i][g->placements[k].mesh] += (uint32_t)copies;
    }
    b->times = made;
    return true;
}

/* ---- the box --------------------------------------------------------------------------------- */

static void grow(dvec3 *low, dvec3 *high, dvec3 p)
{
    *low  = (dvec3){ fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z) };
    *high = (dvec3){ fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z) };
}

/* Around each corner or, for a mesh that stands several times, around its own box: once looked at,
 * a mesh costs no more for standing a thousand times. */
static void grow_by_places(scene_build *b, int i, uint32_t mesh_index, const transform *places,
                           size_t count)
{
    const mesh *m = &b->files[i]->meshes[mesh_index].triangles;
    dvec3 low = { HUGE_VAL, HUGE_VAL, HUGE_VAL }, high = { -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    for (uint32_t v = 0; v < m->position_count; v++) {
        dvec3 p = d3_from(m->positions[v]);
        if (count == 1)
            grow(&b->low, &b->high, transform_point(places, p));
        grow(&low, &high, p);
    }
    for (size_t k = 0; count > 1 && m->position_count && k < count; k++)
        for (int c = 0; c < 8; c++) {
            dvec3 p = { c & 1 ? low.x : high.x, c & 2 ? low.y : high.y, c & 4 ? low.z : high.z };
            grow(&b->low, &b->high, transform_point(&places[k], p));
        }
}

/* All places of all meshes of file i, sorted by mesh. */
static bool grow_by_file(scene_build *b, int i)
{
    const gltf *g = b->files[i];
    arena scratch = { 0 };
    size_t *next = arena_array(&scratch, size_t, (size_t)g->mesh_count + 2, b->err), all = 0;
    for (uint32_t m = 0; next && m < g->mesh_count; m++) {
        next[m] = all;
        all += b->times[i][m];
    }
    transform *places = next ? arena_array(&scratch, transform, all + 1, b->err) : NULL;
    for (int j = i; places && j < b->study->scene_count; j++) {
        const study_scene *s = &b->study->scenes[j];
        for (uint32_t k = 0; b->files[j] == g && k < g->placement_count; k++)
            for (int c = 0; c < s->at_count; c++) {
                transform copy = scene_copy_place(s, c);
                places[next[g->placements[k].mesh]++] =
                    transform_product(&copy, &g->placements[k].place);
            }
    }
    size_t first = 0;
    for (uint32_t m = 0; places && m < g->mesh_count; m++) {
        grow_by_places(b, i, m, places + first, b->times[i][m]);
        first += b->times[i][m];
    }
    arena_clear(&scratch);
    return places != NULL;
}

/* Rounded to whole metres, so that round coordinates stay round. */
static double middle(double low, double high)
{
    return low <= high ? round(0.5 * (low + high)) : 0;
}

static dvec3 box_middle(dvec3 low, dvec3 high)
{
    return (dvec3){ middle(low.x, high.x), middle(low.y, high.y), middle(low.z, high.z) };
}

/* Without surfaces, what is near the first lamp that has a place counts. */
static dvec3 middle_of_lamps(const study *s)
{
    for (int i = 0; i < s->luminaire_count; i++)
        if (s->luminaires[i].at_count)
            return box_middle(s->luminaires[i].at[0], s->luminaires[i].at[0]);
    for (int i = 0; i < s->light_count; i++)
        if (s->lights[i].at_count)
            return box_middle(s->lights[i].at[0], s->lights[i].at[0]);
    return (dvec3){ 0, 0, 0 };
}

bool build_bounds(scene_build *b)
{
    b->low  = (dvec3){ HUGE_VAL, HUGE_VAL, HUGE_VAL };
    b->high = (dvec3){ -HUGE_VAL, -HUGE_VAL, -HUGE_VAL };
    if (!count_places(b))
        return false;
    if (b->study->room.given) {
        dvec3 r = b->study->room.size;
        grow(&b->low, &b->high, (dvec3){ 0, 0, 0 });
        grow(&b->low, &b->high, r);
    }
    for (int i = 0; i < b->study->scene_count; i++)
        if (scene_first_use(b, i) == i && !grow_by_file(b, i))
            return false;
    b->centre = box_middle(b->low, b->high);
    if (!(b->low.x <= b->high.x))
        b->centre = middle_of_lamps(b->study);
    else if (!(d3_finite(b->low) && d3_finite(b->high) && d3_length(d3_sub(b->high, b->low)) < 1e9))
        return failed(b->err, ERR_ARGUMENT, "%s: the scene is larger than a million kilometres",
                      b->study->path);
    return true;
}
