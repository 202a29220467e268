/* sim/grid_write.c -- see grid_write.h. */
#include "sim/grid_write.h"

#include "core/color.h"
#include "core/file.h"
#include "core/image.h"

#include <stdio.h>
#include <string.h>

void grid_write_place(FILE *to, const grid_sensor *at)
{
    fprintf(to, "%.12g,%.12g,%.12g,%.12g,%.12g,%.12g", at->at.x, at->at.y, at->at.z, at->normal.x,
            at->normal.y, at->normal.z);
}

bool grid_write_csv(const char *path, const scene *s, const grid_result *r, lux_error *err)
{
    output_file f;
    if (!file_create(&f, path, err))
        return false;
    fputs("x,y,z,nx,ny,nz,illuminance_lx,direct_lx,indirect_lx,half_width_lx", f.stream);
    for (int l = 0; l < r->layer_count; l++)
        fprintf(f.stream, ",%s_lx", s->groups[l]);
    fputc('\n', f.stream);
    for (int k = 0; k < r->sensor_count; k++) {
        grid_write_place(f.stream, &r->sensors[k]);
        fprintf(f.stream, ",%.9g,%.9g,%.9g,%.9g", r->illuminance[k], r->direct[k], r->indirect[k],
                r->half_width[k]);
        for (int l = 0; l < r->layer_count; l++)
            fprintf(f.stream, ",%.9g", r->layers[l].illuminance[k]);
        fputc('\n', f.stream);
    }
    if (r->end == RUN_INTERRUPTED)
        fprintf(f.stream, "# partial: %s\n", run_end_text(r->end));
    return file_commit(&f, err);
}

/* ---- EXR ------------------------------------------------------------------------------------- */

float *grid_pixels(arena *a, const grid_result *r, const double *values, double all, lux_error *err)
{
    float *pixels = arena_array(a, float, (size_t)r->columns *(size_t)r->rows, err);
    for (int k = 0; pixels && k < r->sensor_count; k++) {
        int row = r->rows - 1 - r->cell[k] / r->columns, column = r->cell[k] % r->columns;
        pixels[(size_t)row * (size_t)r->columns + (size_t)column] =
            (float)(values ? values[k] : all);
    }
    return pixels;
}

/* Channels as they are made: names and values live in the arena. */
typedef struct exr_work {
    arena a;
    const grid_result *r;
    image_channel *channels;
    int count;
    lux_error *err;
} exr_work;

/* A channel of `values` by sensor, or of `otherwise` where they are NULL; cells without one: 0. */
static bool add_channel(exr_work *w, const char *name, const double *values, double otherwise)
{
    float *pixels           = grid_pixels(&w->a, w->r, values, otherwise, w->err);
    w->channels[w->count++] = (image_channel){ name, pixels };
    return pixels != NULL;
}

static bool add_layer_channel(exr_work *w, const char *group, const char *what,
                              const double *values)
{
    size_t bytes = strlen(group) + strlen(what) + sizeof "group..";
    char *name   = arena_array(&w->a, char, bytes, w->err);
    if (!name)
        return false;
    snprintf(name, bytes, "group.%s.%s", group, what);
    return add_channel(w, name, values, 0.0);
}

/* 1 in cells without a sensor. */
static bool add_left_out(exr_work *w)
{
    if (!w->r->left_out)
        return true;
    if (!add_channel(w, "leftOut.Y", NULL, 1.0))
        return false;
    float *pixels = (float *)w->channels[w->count - 1].values;
    for (int i = 0; i < w->r->columns * w->r->rows; i++)
        pixels[i] = 1.0f - pixels[i];
    return true;
}

static bool make_channels(exr_work *w, const scene *s)
{
    const grid_result *r = w->r;
    w->channels = arena_array(&w->a, image_channel, 5 + 3 * (size_t)r->layer_count, w->err);
    bool good   = w->channels && add_channel(w, "Y", r->illuminance, 0.0) &&
                add_channel(w, "direct.Y", r->direct, 0.0) &&
                add_channel(w, "indirect.Y", r->indirect, 0.0) &&
                add_channel(w, "halfWidth.Y", r->half_width, 0.0) && add_left_out(w);
    for (int l = 0; good && l < r->layer_count; l++) {
        const grid_layer *layer = &r->layers[l];
        good                    = add_layer_channel(w, s->groups[l], "Y", layer->illuminance) &&
               add_layer_channel(w, s->groups[l], "direct.Y", layer->direct) &&
               add_layer_channel(w, s->groups[l], "halfWidth.Y", layer->half_width);
    }
    return good;
}

bool grid_write_exr(const char *path, const scene *s, const grid_result *r, notices *n,
                    lux_error *err)
{
    exr_work w = { .r = r, .err = err };
    bool good  = make_channels(&w, s);
    if (good) {
        char date[CAP_DATE];
        image_attribute attributes[MOST_ATTRIBUTES] = {
            { "whiteLuminance", ATTRIBUTE_FLOAT, NULL, (float)LUMENS_PER_WATT },
            { "lux4:accuracy", ATTRIBUTE_FLOAT, NULL, (float)r->asked },
            { "lux4:accuracyReached", ATTRIBUTE_FLOAT, NULL, (float)r->reached },
            { "lux4:grid", ATTRIBUTE_STRING, r->grid->name, 0 },
            { "lux4:quantity", ATTRIBUTE_STRING, grid_quantity_name(r->grid->quantity), 0 },
            { "lux4:study", ATTRIBUTE_STRING, output_study_name(s->study), 0 },
            { "lux4:unit", ATTRIBUTE_STRING, "lx", 0 },
            { "lux4:version", ATTRIBUTE_STRING, LUX4_VERSION, 0 },
            { "lux4:interval", ATTRIBUTE_STRING, r->left_to_chance ? r->left_to_chance : "valid",
              0 },
        };
        bool partial = r->end == RUN_INTERRUPTED;
        image im     = { .width         = r->columns,
                         .height        = r->rows,
                         .channel_count = w.count,
                         .channels      = w.channels,
                         .attribute_count =
                             output_attributes(attributes, date, s->study, s->moments, partial),
                         .attributes = attributes };
        good         = image_write_exr(path, &im, false, n, err);
    }
    arena_clear(&w.a);
    return good;
}
