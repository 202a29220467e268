/* tests/lab.c -- see lab.h. */
#include "tests/lab.h"

#include "sim/light_maps.h"
#include "tests/folder.h"
#include "tests/gltf_text.h"
#include "tests/test.h"
#include "tests/transports.h"

#include <stdio.h>

void lab_open(lab *l) { *l = (lab){ .folder = folder_new() }; }

void lab_close(lab *l)
{
    arena_clear(&l->a);
    folder_free(l->folder);
}

void lab_write(lab *l, const char *name, const char *format, ...)
{
    va_list args;
    va_start(args, format);
    int length = vsnprintf(NULL, 0, format, args);
    va_end(args);
    char *text = arena_array(&l->a, char, (size_t)length + 1, NULL);
    va_start(args, format);
    vsnprintf(text, (size_t)length + 1, format, args);
    va_end(args);
    folder_write(l->folder, name, text);
}

/* ---- models ---------------------------------------------------------------------------------- */

void quads_of_box(dvec3 low, dvec3 high, quad out[6])
{
    dvec3 c[8];
    for (int i = 0; i < 8; i++)
        c[i] = (dvec3){ i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z };
    out[0] = (quad){ { c[0], c[2], c[3], c[1] } };
    out[1] = (quad){ { c[4], c[5], c[7], c[6] } };
    out[2] = (quad){ { c[0], c[1], c[5], c[4] } };
    out[3] = (quad){ { c[2], c[6], c[7], c[3] } };
    out[4] = (quad){ { c[0], c[4], c[6], c[2] } };
    out[5] = (quad){ { c[1], c[3], c[7], c[5] } };
}

static void to_gltf(dvec3 p, float out[3])
{
    out[0] = (float)p.x;
    out[1] = (float)p.z;
    out[2] = (float)-p.y;
}

char *lab_mesh(lab *l, const quad *q, int count, const dvec3 *place, int places)
{
    size_t corners = 12 * (size_t)count, all = corners + 3 * (size_t)places;
    size_t size     = (all + 6 * (size_t)count) * 4;
    float *position = arena_array(&l->a, float, size / 4, NULL);
    uint32_t *index = (uint32_t *)(position + all);
    float low[3]    = { HUGE_VALF, HUGE_VALF, HUGE_VALF };
    float high[3]   = { -HUGE_VALF, -HUGE_VALF, -HUGE_VALF };
    for (int i = 0; i < 4 * count; i++) {
        to_gltf(q[i / 4].corner[i % 4], position + 3 * i);
        for (int k = 0; k < 3; k++) {
            low[k]  = fminf(low[k], position[3 * i + k]);
            high[k] = fmaxf(high[k], position[3 * i + k]);
        }
    }
    for (int i = 0; i < places; i++)
        to_gltf(place[i], position + corners + 3 * i);
    for (int i = 0; i < 6 * count; i++) {
        static const uint32_t around[] = { 0, 1, 2, 0, 2, 3 };
        index[i]                       = (uint32_t)(4 * (i / 6)) + around[i % 6];
    }
    return text_of(
        &l->a,
        "\"buffers\":[{\"byteLength\":%zu,\"uri\":\"%s\"}],\"bufferViews\":[{\"buffer\":0,"
        "\"byteLength\":%zu},{\"buffer\":0,\"byteOffset\":%zu,\"byteLength\":%zu}],"
        "\"accessors\":[{\"bufferView\":0,\"componentType\":5126,\"type\":\"VEC3\","
        "\"count\":%d,\"min\":[%.9g,%.9g,%.9g],\"max\":[%.9g,%.9g,%.9g]},{\"bufferView\":1,"
        "\"componentType\":5125,\"type\":\"SCALAR\",\"count\":%d}%s],\"meshes\":[{"
        "\"primitives\":[{\"attributes\":{\"POSITION\":0},\"indices\":1,\"material\":0}]}]",
        size, data_uri(&l->a, position, size), 4 * all, 4 * all, size - 4 * all, 4 * count,
        (double)low[0], (double)low[1], (double)low[2], (double)high[0], (double)high[1],
        (double)high[2], 6 * count,
        places ? text_of(&l->a,
                         ",{\"bufferView\":0,\"byteOffset\":%zu,\"componentType\":5126,"
                         "\"type\":\"VEC3\",\"count\":%d}",
                         4 * corners, places)
               : "");
}

void lab_quads(lab *l, const char *name, const quad *q, int count, const char *made_of)
{
    lab_write(l, name,
              "{\"asset\":{\"version\":\"2.0\"},\"extensionsUsed\":["
              "\"KHR_materials_emissive_strength\"],\"scenes\":[{\"nodes\":[0]}],\"nodes\":[{"
              "\"mesh\":0}],\"materials\":[{%s}],%s}",
              made_of, lab_mesh(l, q, count, NULL, 0));
}

char *lab_glow(lab *l, double luminance)
{
    return text_of(&l->a,
                   "\"name\":\"Glow\",\"emissiveFactor\":[1,1,1],\"extensions\":{"
                   "\"KHR_materials_emissive_strength\":{\"emissiveStrength\":%.9g}},"
                   "\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1],\"metallicFactor\":0}",
                   luminance);
}

void lab_speck(lab *l, const char *name)
{
    quad q = { { { 0, 0, -30 }, { 0.01, 0, -30 }, { 0.01, 0.01, -30 }, { 0, 0.01, -30 } } };
    lab_quads(l, name, &q, 1,
              "\"name\":\"Speck\",\"pbrMetallicRoughness\":{\"baseColorFactor\":[0,0,0,1],"
              "\"metallicFactor\":0}");
}

/* ---- runs ------------------------------------------------------------------------------------ */

const scene *lab_scene(lab *l, const char *yaml)
{
    char path[4096];
    folder_write(l->folder, "study.yaml", yaml);
    snprintf(path, sizeof path, "%s/study.yaml", l->folder);
    lux_error err  = { 0 };
    const study *s = study_read(&l->a, path, NULL, NULL, &err);
    const scene *made =
        s ? scene_new(&l->a, s, &(scene_options){ .threads = 1 }, NULL, &err) : NULL;
    if (!made)
        fail_msg("%s", err.text);
    return made;
}

/* The study with a grid of these sensors. */
static const scene *scene_of_probes(lab *l, const char *yaml, const char *grid, const lab_probe *p,
                                    int count)
{
    char *text = text_of(&l->a, "x,y,z,nx,ny,nz\n");
    for (int i = 0; i < count; i++)
        text = text_of(&l->a, "%s%.17g,%.17g,%.17g,%.17g,%.17g,%.17g\n", text, p[i].at.x, p[i].at.y,
                       p[i].at.z, p[i].normal.x, p[i].normal.y, p[i].normal.z);
    folder_write(l->folder, "probes.csv", text);
    return lab_scene(l,
                     text_of(&l->a, "lux4: 1\n%s\ngrids: [{name: probes, points: probes.csv%s}]\n",
                             yaml, grid ? grid : ""));
}

void lab_measure(lab *l, const char *yaml, const char *grid, const lab_probe *p, int count,
                 const run_options *o, grid_result *out)
{
    const scene *s      = scene_of_probes(l, yaml, grid, p, count);
    run_options options = *o;
    options.seed        = options.seed ? options.seed : 1;
    grid_of_scene(&l->a, s, 0, &options, out);
    assert_int_equal(out->sensor_count, count);
}

void lab_check(const char *what, const grid_result *r, const double *want, double exact,
               double accuracy)
{
    const double stretch = 4.0728 / 2.1314;
    double mean          = 0.0;
    for (int k = 0; k < r->sensor_count; k++)
        mean += want[k] / r->sensor_count;
    for (int k = 0; k < r->sensor_count; k++) {
        double off    = fabs(r->illuminance[k] - want[k]) - exact * want[k];
        double enough = accuracy * fmax(want[k], 0.1 * mean);
        if (!(off <= fmax(stretch * r->half_width[k], enough)))
            fail_msg("%s, sensor %d: %.9g lx +- %.3g, not %.9g: %.2g of it off", what, k,
                     r->illuminance[k], r->half_width[k], want[k], off / want[k]);
        if (!(r->half_width[k] <= 1.05 * accuracy * fmax(want[k], 0.1 * mean)))
            fail_msg("%s, sensor %d: %.9g lx +- %.3g is not as sure as asked for", what, k,
                     r->illuminance[k], r->half_width[k]);
    }
}

void lab_check_all_ways(const char *what, const char *yaml, lab *l, const lab_probe *p, int count,
                        const double *want, double exact, double accuracy)
{
    const scene *s = scene_of_probes(l, yaml, NULL, p, count);
    for (int t = 0; t < TRANSPORTS; t++) {
        const illumination_map *map = NULL; /* which roulette of paths does not touch */
        for (int d = 0; d < ROULETTE_DEPTHS; d++) {
            grid_result r;
            run_options o = { .accuracy      = accuracy,
                              .deadline      = HUGE_VAL,
                              .threads       = 1,
                              .seed          = (uint32_t)(11 + 7 * d),
                              .transport     = transports[t],
                              .roulette_from = roulette_depths[d] };
            if (o.transport == TRANSPORT_MAPS && !map)
                assert_true(light_maps_indirect(&l->a, s, &o, accuracy, &map, NULL, NULL));
            o.indirect = map;
            grid_of_scene(&l->a, s, 0, &o, &r);
            /* Maps do not grow finer for one sensor's sake, and what they smooth is told */
            double told = o.transport == TRANSPORT_MAPS ? 2.0 : 1.0;
            lab_check(what, &r, want, exact, told * accuracy);
        }
    }
}

/* ---- Lambert's formula ----------------------------------------------------------------------- */

/* What of the polygon lies above the horizon, corners as seen from the point. */
static int cut(const dvec3 *v, int count, dvec3 normal, dvec3 *out)
{
    int n = 0;
    for (int i = 0; i < count; i++) {
        dvec3 a = v[i], b = v[(i + 1) % count];
        double x = d3_dot(a, normal), y = d3_dot(b, normal);
        if (x >= 0.0)
            out[n++] = a;
        if ((x < 0.0) != (y < 0.0))
            out[n++] = d3_add(a, d3_scale(d3_sub(b, a), x / (x - y)));
    }
    return n;
}

double polygon_lux(const dvec3 *corner, int count, dvec3 p, dvec3 normal)
{
    dvec3 seen[8], above[16];
    for (int i = 0; i < count; i++)
        seen[i] = d3_sub(corner[i], p);
    int n      = cut(seen, count, d3_scale(normal, 1.0 / d3_length(normal)), above);
    double sum = 0.0;
    for (int i = 0; i < n; i++) {
        dvec3 a = above[i], b = above[(i + 1) % n], g = d3_cross(a, b);
        double sine = d3_length(g);
        if (sine > 0.0)
            sum += atan2(sine, d3_dot(a, b)) * d3_dot(g, normal) / sine;
    }
    return 0.5 * fabs(sum) / d3_length(normal);
}
