/* sim/view_write.c -- the result of a view as files: render.h. */
#include "core/color.h"
#include "core/image.h"
#include "sim/output.h"
#include "sim/render.h"
#include "sim/tone.h"

#include <stdio.h>
#include <string.h>

enum { PLAIN_CHANNELS = 12, LAYER_CHANNELS = 5 };

/* "group.NAME.R" and so on, with names in a; NULL if memory is out. */
static image_channel *channels_of(arena *a, const scene *s, const view_result *r, int *count,
                                  lux_error *err)
{
    const image_channel plain[PLAIN_CHANNELS] = {
        { "R", r->radiance[0] },          { "G", r->radiance[1] },
        { "B", r->radiance[2] },          { "illuminance.Y", r->illuminance },
        { "halfWidth.Y", r->half_width }, { "Z", r->distance },
        { "normal.X", r->normal[0] },     { "normal.Y", r->normal[1] },
        { "normal.Z", r->normal[2] },     { "albedo.R", r->albedo[0] },
        { "albedo.G", r->albedo[1] },     { "albedo.B", r->albedo[2] },
    };
    static const char *const names[LAYER_CHANNELS] = { "R", "G", "B", "illuminance.Y",
                                                       "halfWidth.Y" };
    size_t room        = PLAIN_CHANNELS + LAYER_CHANNELS * (size_t)r->layer_count;
    image_channel *all = arena_array(a, image_channel, room, err);
    *count             = PLAIN_CHANNELS;
    if (all)
        memcpy(all, plain, sizeof plain);
    for (int l = 0; all && l < r->layer_count; l++) {
        const view_layer *layer = &r->layers[l];
        float *values[]         = { layer->radiance[0], layer->radiance[1], layer->radiance[2],
                                    layer->illuminance, layer->half_width };
        for (int c = 0; c < LAYER_CHANNELS; c++) {
            size_t bytes = strlen(s->groups[l]) + strlen(names[c]) + sizeof "group..";
            char *name   = arena_array(a, char, bytes, err);
            if (!name)
                return NULL;
            snprintf(name, bytes, "group.%s.%s", s->groups[l], names[c]);
            all[(*count)++] = (image_channel){ name, values[c] };
        }
    }
    return all;
}

bool view_write_exr(const char *path, const scene *s, const view_result *r, bool half, notices *n,
                    lux_error *err)
{
    arena scratch = { 0 };
    int channel_count;
    char date[CAP_DATE];
    image_channel *channels                     = channels_of(&scratch, s, r, &channel_count, err);
    image_attribute attributes[MOST_ATTRIBUTES] = {
        { "whiteLuminance", ATTRIBUTE_FLOAT, NULL, (float)LUMENS_PER_WATT },
        { "lux4:accuracy", ATTRIBUTE_FLOAT, NULL, (float)r->asked },
        { "lux4:accuracyReached", ATTRIBUTE_FLOAT, NULL, (float)r->reached },
        { "lux4:halfWidthUnit", ATTRIBUTE_STRING, "cd/m^2", 0 },
        { "lux4:illuminanceUnit", ATTRIBUTE_STRING, "lx", 0 },
        { "lux4:radianceUnit", ATTRIBUTE_STRING, "W/(sr m^2)", 0 },
        { "lux4:study", ATTRIBUTE_STRING, output_study_name(s->study), 0 },
        { "lux4:version", ATTRIBUTE_STRING, LUX4_VERSION, 0 },
        { "lux4:view", ATTRIBUTE_STRING, r->view->name, 0 },
        { "lux4:interval", ATTRIBUTE_STRING, r->left_to_chance ? r->left_to_chance : "valid", 0 },
    };
    bool partial = r->end == RUN_INTERRUPTED;
    image im     = { .width         = r->width,
                     .height        = r->height,
                     .channel_count = channel_count,
                     .channels      = channels,
                     .attribute_count =
                         output_attributes(attributes, date, s->study, s->moments, partial),
                     .attributes = attributes };
    bool good    = channels && image_write_exr(path, &im, half, n, err);
    arena_clear(&scratch);
    return good;
}

bool view_write_png(const char *path, const view_result *r, double exposure_ev, lux_error *err)
{
    arena scratch  = { 0 };
    uint8_t *rgb   = arena_array(&scratch, uint8_t, 3 * (size_t)r->width * (size_t)r->height, err);
    tone_options o = { .exposure_ev = exposure_ev };
    bool good      = rgb &&
                tone_photographic(r->radiance[0], r->radiance[1], r->radiance[2], r->width,
                                  r->height, &o, rgb, &scratch, err) &&
                image_write_rgb8(path, r->width, r->height, rgb, err);
    arena_clear(&scratch);
    return good;
}
