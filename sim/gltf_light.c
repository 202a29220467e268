/* sim/gltf_light.c -- lights at nodes: punctual ones, measured ones, glowing areas.
 *
 * KHR_lights_punctual; EXT_lights_ies; EXT_lights_area as Khronos' pull request 2525 drafts it: its
 * text (type, intensity, size, rect.aspect) and an older schema (shape, luminance, width, height,
 * radius). Each is a list at the root of the file, and an index into it at a node.
 */
#include "sim/gltf_source.h"

#include <float.h>
#include <stdio.h>
#include <string.h>

static const char *const extensions[LIGHT_LISTS] = {
    [LIST_PUNCTUAL] = "KHR_lights_punctual",
    [LIST_IES]      = "EXT_lights_ies",
    [LIST_AREA]     = "EXT_lights_area",
};

/* Of all photometric files within a scene: views may overlap, so that few bytes stand for many. */
static const size_t embedded_most = (size_t)1 << 26;

/* ---- the lists of the file ---- */

static vec3 color_of(const double c[3]) { return (vec3){ (float)c[0], (float)c[1], (float)c[2] }; }

static bool read_punctual(reader *r, uint32_t i, gltf_light *to, lux_error *err)
{
    const source_light *l  = &r->source->lights[i];
    static const char at[] = "/extensions/KHR_lights_punctual/lights";
    if (!strcmp(l->type, "spot") && !(l->inner < l->outer))
        return failed(err, ERR_FORMAT,
                      "%s: %s/%u/spot: innerConeAngle %g, wanted less than outerConeAngle %g",
                      r->file->path, at, i, l->inner, l->outer);
    if (l->ranged)
        tally_add(r, TALLY_RANGE, "%s/%u", at, i);
    *to = (gltf_light){
        .name      = read_name(r, l->name, err),
        .kind      = !strcmp(l->type, "point")  ? GLTF_POINT
                     : !strcmp(l->type, "spot") ? GLTF_SPOT
                                                : GLTF_DIRECTIONAL,
        .color     = color_of(l->color),
        .intensity = l->intensity,
        .inner     = l->inner,
        .outer     = l->outer,
    };
    return to->name != NULL;
}

/* Puts the bytes of a photometric file, and a NUL, into the result. */
static bool keep_bytes(reader *r, const char *pointer, const uint8_t *bytes, size_t size,
                       gltf_light *to, lux_error *err)
{
    if (size == 0)
        return failed(err, ERR_FORMAT, "%s: %s: no bytes, wanted a photometric file", r->file->path,
                      pointer);
    if (size > embedded_most - r->embedded)
        return failed(err, ERR_UNSUPPORTED,
                      "%s: %s: with it more than %zu bytes of photometric files", r->file->path,
                      pointer, embedded_most);
    char *copy = arena_array(r->a, char, size + 1, err);
    if (!copy)
        return false;
    r->embedded += size;
    to->photometry_bytes = memcpy(copy, bytes, size);
    to->photometry_size  = size;
    return true;
}

static bool read_profile(reader *r, uint32_t i, gltf_light *to, lux_error *err)
{
    const gltf_file *f      = r->file;
    const source_content *c = &f->profiles[i];
    const uint8_t *bytes    = NULL;
    size_t size             = 0;
    const char *path        = NULL;
    char pointer[80];
    snprintf(pointer, sizeof pointer, "/extensions/EXT_lights_ies/lights/%u%s", i,
             c->uri ? "/uri" : "/bufferView");
    if (c->uri && c->view >= 0)
        return failed(err, ERR_FORMAT, "%s: %s: there is a bufferView too, wanted one of them",
                      f->path, pointer);
    if (!content_locate(r, c, pointer, &bytes, &size, &path, err))
        return false;

    size_t length = strlen(f->path) + strlen(pointer) + 3;
    char *label   = arena_array(r->a, char, length, err);
    *to           = (gltf_light){ .name            = read_name(r, r->source->profile_names[i], err),
                                  .kind            = GLTF_IES,
                                  .photometry_name = label };
    if (!label || !to->name)
        return false;
    snprintf(label, length, "%s: %s", f->path, pointer);
    if (!path)
        return keep_bytes(r, pointer, bytes, size, to, err);
    to->photometry_path = read_name(r, path, err);
    return to->photometry_path != NULL;
}

static bool read_area(reader *r, uint32_t i, gltf_light *to, lux_error *err)
{
    const source_area *l = &r->source->areas[i];
    if (*l->type && *l->shape && strcmp(l->type, l->shape) != 0)
        return failed(err, ERR_FORMAT,
                      "%s: /extensions/EXT_lights_area/lights/%u: type \"%s\", but shape \"%s\"",
                      r->file->path, i, l->type, l->shape);
    *to = (gltf_light){ .name      = read_name(r, l->name, err),
                        .color     = color_of(l->color),
                        .intensity = l->intensity };
    if (!strcmp(*l->type ? l->type : l->shape, "rect")) {
        to->kind   = GLTF_AREA_RECT;
        to->width  = l->width > 0.0 ? l->width : l->size * l->aspect;
        to->height = l->height > 0.0 ? l->height : l->size;
    } else {
        to->kind   = GLTF_AREA_DISK;
        to->radius = l->radius > 0.0 ? l->radius : 0.5 * l->size;
    }
    return to->name != NULL;
}

bool read_lights(reader *r, lux_error *err)
{
    static bool (*const read[LIGHT_LISTS])(reader *, uint32_t, gltf_light *, lux_error *) = {
        [LIST_PUNCTUAL] = read_punctual, [LIST_IES] = read_profile, [LIST_AREA] = read_area
    };
    r->light_count[LIST_PUNCTUAL] = r->source->light_count;
    r->light_count[LIST_IES]      = r->file->profile_count;
    r->light_count[LIST_AREA]     = r->source->area_count;
    for (int k = 0; k < LIGHT_LISTS; k++) {
        r->lights[k] = arena_array(r->file->scratch, gltf_light, r->light_count[k], err);
        if (!r->lights[k])
            return false;
        for (uint32_t i = 0; i < r->light_count[k]; i++)
            if (!read[k](r, i, &r->lights[k][i], err))
                return false;
    }
    return true;
}

/* ---- those of a node ---- */

uint32_t node_light_count(const source_node *n)
{
    uint32_t count = 0;
    for (int k = 0; k < LIGHT_LISTS; k++)
        count += n->light[k] >= 0;
    return count;
}

bool node_lights_valid(const reader *r, uint32_t i, lux_error *err)
{
    const source_node *n = &r->source->nodes[i];
    for (int k = 0; k < LIGHT_LISTS; k++)
        if (n->light[k] >= 0 && !index_valid(r, n->light[k], r->light_count[k], "light", err,
                                             "/nodes/%u/extensions/%s/light", i, extensions[k]))
            return false;
    return true;
}

/* The multiplier and the colour that the node gives to a profile. */
static void tint(reader *r, uint32_t i, gltf_light *to)
{
    const source_node *n = &r->source->nodes[i];
    to->multiplier       = n->multiplier;
    to->color            = color_of(n->tint);
    if (to->color.x > 1.0f || to->color.y > 1.0f || to->color.z > 1.0f)
        tally_add(r, TALLY_TINT, "/nodes/%u/extensions/EXT_lights_ies/color", i);
    to->color =
        (vec3){ fminf(to->color.x, 1.0f), fminf(to->color.y, 1.0f), fminf(to->color.z, 1.0f) };
}

/* Multiplies an area's size by the largest scale of its place: how long the axes have become. */
static bool scale_area(const reader *r, uint32_t i, gltf_light *to, lux_error *err)
{
    double scale = 0.0;
    for (int k = 0; k < 3; k++) {
        dvec3 axis = { k == 0, k == 1, k == 2 };
        scale      = fmax(scale, d3_length(transform_vector(&to->place, axis)));
    }
    to->width *= scale;
    to->height *= scale;
    to->radius *= scale;

    /* Lights are made in float: what is 0 or infinite there is no area */
    double first  = to->kind == GLTF_AREA_RECT ? to->width : to->radius;
    double second = to->kind == GLTF_AREA_RECT ? to->height : to->radius;
    double area = first * second, least = (double)FLT_MIN, most = (double)FLT_MAX;
    return (fmax(first, fmax(second, area)) <= most && area >= least) ||
           failed(err, ERR_FORMAT,
                  "%s: /nodes/%u/extensions/EXT_lights_area/light: %g by %g m, wanted %g to %g m^2",
                  r->file->path, i, first, second, least, most);
}

bool node_lights_add(reader *r, uint32_t i, uint32_t number, const transform *place, lux_error *err)
{
    const source_node *n = &r->source->nodes[i];
    for (int k = 0; k < LIGHT_LISTS; k++) {
        if (n->light[k] < 0)
            continue;
        const gltf_light *l = &r->lights[k][n->light[k]];
        if (l->kind != GLTF_POINT && transform_determinant(place) == 0) {
            tally_add(r, TALLY_SINGULAR, "/nodes/%u", i);
            continue;
        }
        gltf_light *to = &r->out->lights[r->out->light_count++];
        *to            = *l;
        to->node       = number;
        to->place      = *place;
        if (!*to->name && !(to->name = read_name(r, n->name, err)))
            return false;
        if (k == LIST_IES)
            tint(r, i, to);
        if (k == LIST_AREA && !scale_area(r, i, to, err))
            return false;
    }
    return true;
}
