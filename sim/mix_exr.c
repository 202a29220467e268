/* sim/mix_exr.c -- see mix.h: layers of an image, found by their names and summed.
 *
 * A group's name may hold dots, and so is what is left of group.NAME.LAYER once the longest
 * LAYER that the kind of picture has is taken off.
 */
#include "sim/mix.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

/* The channels that are mixed, each behind those whose names end in its own. */
typedef struct layers {
    const char *names[5];
    int count, needed; /* the first `needed` every group must have */
} layers;

static const layers of_view = { { "R", "G", "B", "illuminance.Y", "halfWidth.Y" }, 5, 3 };
static const layers of_grid = { { "Y", "direct.Y", "halfWidth.Y" }, 3, 1 };

static const layers *layers_of(const mix *m)
{
    return m->kind == MIX_VIEW_EXR ? &of_view : &of_grid;
}

static const image_channel *channel(const image *im, const char *name)
{
    for (int c = 0; c < im->channel_count; c++)
        if (!strcmp(im->channels[c].name, name))
            return &im->channels[c];
    return NULL;
}

/* How long NAME is in "group.NAME.LAYER"; 0 if it is no such name. */
static size_t group_length(const char *name, const layers *l)
{
    static const char prefix[] = "group.";
    size_t before = strlen(prefix), all = strlen(name), shortest = 0;
    if (strncmp(name, prefix, before) != 0)
        return 0;
    for (int k = 0; k < l->count; k++) {
        size_t end = strlen(l->names[k]) + 1;
        if (all <= before + end || name[all - end] != '.' ||
            strcmp(name + all - end + 1, l->names[k]) != 0)
            continue;
        size_t length = all - before - end;
        shortest      = !shortest || length < shortest ? length : shortest;
    }
    return shortest;
}

static const float *layer(const mix *m, int group, const char *name)
{
    char full[1024];
    snprintf(full, sizeof full, "group.%s.%s", m->groups[group].name, name);
    const image_channel *c = channel(&m->im, full);
    return c ? c->values : NULL;
}

/* ---- reading --------------------------------------------------------------------------------- */

static bool all_finite(const mix *m, lux_error *err)
{
    size_t width = (size_t)m->im.width, pixels = width * (size_t)m->im.height;
    for (int c = 0; c < m->im.channel_count; c++)
        for (size_t i = 0; i < pixels; i++)
            if (!isfinite(m->im.channels[c].values[i]))
                return failed(err, ERR_FORMAT,
                              "%s: channel %.60s: expected finite numbers, found another at column "
                              "%zu of row %zu",
                              m->path, m->im.channels[c].name, i % width, i / width);
    return true;
}

static bool is_view(const image *im)
{
    for (int c = 0; c < im->channel_count; c++) {
        const char *name = im->channels[c].name;
        size_t length    = strlen(name);
        if (!strncmp(name, "group.", 6) && length > 8 && !strcmp(name + length - 2, ".R"))
            return true;
    }
    return false;
}

bool mix_read_exr(arena *a, mix *m, lux_error *err)
{
    if (!image_read_exr(m->path, a, &m->im, err) || !all_finite(m, err))
        return false;
    m->kind         = is_view(&m->im) ? MIX_VIEW_EXR : MIX_GRID_EXR;
    const layers *l = layers_of(m);
    m->groups       = arena_array(a, mix_group, (size_t)m->im.channel_count, err);
    for (int c = 0; m->groups && c < m->im.channel_count; c++) {
        const char *name = m->im.channels[c].name;
        size_t length    = group_length(name, l);
        if (length && mix_group_add(a, m, name + strlen("group."), length, err) < 0)
            return false;
    }
    for (int g = 0; m->groups && g < m->group_count; g++)
        for (int k = 0; k < l->needed; k++)
            if (!layer(m, g, l->names[k]))
                return failed(err, ERR_FORMAT, "%s: expected a channel group.%.60s.%s, found none",
                              m->path, m->groups[g].name, l->names[k]);
    return m->groups;
}

/* ---- the mixture ----------------------------------------------------------------------------- */

/* Adds factor x layer of each group; false if a group has no such layer. */
static bool add_layers(const mix *m, const char *name, double sign, double *sum)
{
    size_t pixels = (size_t)m->im.width * (size_t)m->im.height;
    for (int g = 0; g < m->group_count; g++)
        if (!layer(m, g, name))
            return false;
    for (int g = 0; g < m->group_count; g++) {
        const float *values = layer(m, g, name);
        double factor       = sign * m->groups[g].factor;
        for (size_t i = 0; i < pixels; i++)
            sum[i] += factor * (double)values[i];
    }
    return true;
}

typedef struct mixing {
    const mix *m;
    arena *a;
    image *out;
    double *sum; /* scratch, a pixel */
} mixing;

/* A mixed channel, if its layers are there: `name`, less `minus` unless that is NULL. */
static bool mix_channel(mixing *x, const char *as, const char *name, const char *minus,
                        lux_error *err)
{
    size_t pixels = (size_t)x->m->im.width * (size_t)x->m->im.height;
    memset(x->sum, 0, pixels * sizeof *x->sum);
    if (!add_layers(x->m, name, 1.0, x->sum) || (minus && !add_layers(x->m, minus, -1.0, x->sum)))
        return true;
    float *values = arena_array(x->a, float, pixels, err);
    for (size_t i = 0; values && i < pixels; i++)
        values[i] = (float)(minus ? fmax(x->sum[i], 0.0) : x->sum[i]);
    x->out->channels[x->out->channel_count++] = (image_channel){ as, values };
    return values;
}

/* Channels that are no mixture are those of the result. */
static bool mix_channels(mixing *x, lux_error *err)
{
    const mix *m    = x->m;
    const layers *l = layers_of(m);
    for (int c = 0; c < m->im.channel_count; c++) {
        const char *name = m->im.channels[c].name;
        bool mixed       = m->kind == MIX_GRID_EXR && !strcmp(name, "indirect.Y");
        for (int k = 0; k < l->count; k++)
            mixed = mixed || !strcmp(name, l->names[k]);
        if (!mixed)
            x->out->channels[x->out->channel_count++] = m->im.channels[c];
    }
    for (int k = 0; k < l->count; k++)
        if (!mix_channel(x, l->names[k], l->names[k], NULL, err))
            return false;
    return m->kind != MIX_GRID_EXR || mix_channel(x, "indirect.Y", "Y", "direct.Y", err);
}

/* "general=0.5 sky=1" */
static char *mix_text(const mix *m, arena *a, lux_error *err)
{
    size_t room = 1;
    for (int g = 0; g < m->group_count; g++)
        room += strlen(m->groups[g].name) + 32;
    char *text = arena_array(a, char, room, err);
    for (int g = 0; text && g < m->group_count; g++) {
        size_t used = strlen(text);
        snprintf(text + used, room - used, "%s%s=%.9g", g ? " " : "", m->groups[g].name,
                 m->groups[g].factor);
    }
    return text;
}

static bool mix_attributes(const mix *m, arena *a, image *out, lux_error *err)
{
    const char *text = mix_text(m, a, err);
    out->attributes  = arena_array(a, image_attribute, (size_t)m->im.attribute_count + 1, err);
    if (!text || !out->attributes)
        return false;
    for (int i = 0; i < m->im.attribute_count; i++)
        if (strcmp(m->im.attributes[i].name, "lux4:mix") != 0)
            out->attributes[out->attribute_count++] = m->im.attributes[i];
    out->attributes[out->attribute_count++] =
        (image_attribute){ "lux4:mix", ATTRIBUTE_STRING, text, 0 };
    return true;
}

/* Over the cells that have a sensor. */
static double average(const image *im, const char *name)
{
    double sum = 0.0, count = 0.0;
    size_t pixels             = (size_t)im->width * (size_t)im->height;
    const image_channel *c    = channel(im, name);
    const image_channel *none = channel(im, "leftOut.Y");
    for (size_t i = 0; c && i < pixels; i++) {
        if (none && none->values[i] != 0.0f)
            continue;
        sum += (double)c->values[i];
        count += 1.0;
    }
    return count > 0.0 ? sum / count : (double)NAN;
}

bool mix_image(const mix *m, arena *a, image *out, double *average_lx, lux_error *err)
{
    size_t pixels = (size_t)m->im.width * (size_t)m->im.height;
    size_t most   = (size_t)m->im.channel_count + 6;
    arena scratch = { 0 };
    mixing x      = { .m = m, .a = a, .out = out };
    *out          = (image){ .width = m->im.width, .height = m->im.height };
    out->channels = arena_array(a, image_channel, most, err);
    x.sum         = out->channels ? arena_array(&scratch, double, pixels, err) : NULL;
    bool good     = x.sum && mix_channels(&x, err) && mix_attributes(m, a, out, err);
    arena_clear(&scratch);
    if (good)
        *average_lx = m->kind == MIX_GRID_EXR ? average(out, "Y") : (double)NAN;
    return good;
}
