/* sim/daylight_write.c -- see daylight_write.h. */
#include "sim/daylight_write.h"

#include "core/color.h"
#include "core/file.h"
#include "core/image.h"
#include "sim/grid_write.h"
#include "sim/output.h"

#include <stdio.h>

/* ---- tables ---------------------------------------------------------------------------------- */

static bool commit(output_file *f, run_end end, lux_error *err)
{
    if (end == RUN_INTERRUPTED)
        fprintf(f->stream, "# partial: %s\n", run_end_text(end));
    return file_commit(f, err);
}

bool daylight_write_csv(const char *path, const daylight_series *s, lux_error *err)
{
    output_file f;
    if (!file_create(&f, path, err))
        return false;
    fputs("time,x,y,z,nx,ny,nz,illuminance_lx,direct_lx,indirect_lx,half_width_lx\n", f.stream);
    for (int h = 0; h < s->count; h++) {
        const grid_moment *m = &s->light[h];
        for (int k = 0; k < s->plan.sensor_count; k++) {
            fprintf(f.stream, "%s,", s->moments[h].text);
            grid_write_place(f.stream, &s->plan.sensors[k]);
            fprintf(f.stream, ",%.9g,%.9g,%.9g,%.9g\n", m->illuminance[k], m->direct[k],
                    fmax(m->illuminance[k] - m->direct[k], 0.0), m->half_width[k]);
        }
    }
    return commit(&f, s->end, err);
}

bool daylight_write_sun(const char *path, const daylight_series *s, lux_error *err)
{
    output_file f;
    if (!file_create(&f, path, err))
        return false;
    fprintf(f.stream, "x,y,z,nx,ny,nz,%s\n", s->dates > 1 ? "sun_hours_per_day" : "sun_hours");
    for (int k = 0; k < s->plan.sensor_count; k++) {
        grid_write_place(f.stream, &s->plan.sensors[k]);
        fprintf(f.stream, ",%.9g\n", s->sun_hours[k]);
    }
    return commit(&f, s->end, err);
}

bool daylight_factor_write_csv(const char *path, const daylight_factor *d, lux_error *err)
{
    output_file f;
    if (!file_create(&f, path, err))
        return false;
    fputs("x,y,z,nx,ny,nz,daylight_factor_percent,sky_percent,external_percent,"
          "internal_percent,half_width_percent\n",
          f.stream);
    for (int k = 0; k < d->plan->sensor_count; k++) {
        grid_write_place(f.stream, &d->plan->sensors[k]);
        fprintf(f.stream, ",%.9g,%.9g,%.9g,%.9g,%.9g\n", d->all[k], d->sky[k], d->external[k],
                d->internal[k], d->half_width[k]);
    }
    return commit(&f, d->plan->end, err);
}

/* ---- pictures -------------------------------------------------------------------------------- */

/* What a channel is called, and its values by sensor; NULL: there is no such channel. */
typedef struct plane {
    const char *name;
    const double *values;
} plane;

enum { MOST_PLANES = 6 };

static bool add_planes(arena *a, const grid_result *plan, const plane *planes, int count, image *to,
                       lux_error *err)
{
    to->width    = plan->columns;
    to->height   = plan->rows;
    to->channels = arena_array(a, image_channel, MOST_PLANES, err);
    for (int i = 0; to->channels && i < count; i++) {
        if (!planes[i].values)
            continue;
        float *pixels = grid_pixels(a, plan, planes[i].values, 0.0, err);
        if (!pixels)
            return false;
        to->channels[to->channel_count++] = (image_channel){ planes[i].name, pixels };
    }
    return to->channels != NULL;
}

static image_attribute text_attribute(const char *name, const char *text)
{
    return (image_attribute){ name, ATTRIBUTE_STRING, text, 0.0f };
}

static image_attribute number_attribute(const char *name, double number)
{
    return (image_attribute){ name, ATTRIBUTE_FLOAT, NULL, (float)number };
}

static bool add_moment(arena *a, const daylight_series *s, int h, image *to, lux_error *err)
{
    const grid_moment *m = &s->light[h];
    size_t n             = (size_t)s->plan.sensor_count;
    double *indirect     = arena_array(a, double, n, err);
    for (size_t k = 0; indirect && k < n; k++)
        indirect[k] = fmax(m->illuminance[k] - m->direct[k], 0.0);
    plane planes[] = { { "Y", m->illuminance },
                       { "direct.Y", m->direct },
                       { "indirect.Y", indirect },
                       { "halfWidth.Y", m->half_width },
                       { "sun.Y", m->sun } };
    to->part       = s->moments[h].text[0] ? s->moments[h].text : "undated";
    return indirect && add_planes(a, &s->plan, planes, 5, to, err);
}

/* Every part says whose it is: readers look at the first, people at any. */
static bool add_attributes(arena *a, const study *from, const daylight_series *s, int h, image *to,
                           lux_error *err)
{
    const moment *m     = &s->moments[h];
    image_attribute *at = arena_array(a, image_attribute, MOST_ATTRIBUTES, err);
    char *date          = at ? arena_array(a, char, CAP_DATE, err) : NULL;
    if (!date)
        return false;
    int count   = 0;
    at[count++] = number_attribute("whiteLuminance", LUMENS_PER_WATT);
    at[count++] = number_attribute("lux4:accuracy", s->asked);
    at[count++] = number_attribute("lux4:accuracyReached", s->reached);
    at[count++] = text_attribute("lux4:grid", s->plan.grid->name);
    at[count++] = text_attribute("lux4:quantity", grid_quantity_name(s->plan.grid->quantity));
    at[count++] = text_attribute("lux4:study", output_study_name(from));
    at[count++] = text_attribute("lux4:unit", "lx");
    at[count++] = text_attribute("lux4:version", LUX4_VERSION);
    at[count++] = text_attribute("lux4:interval", s->left_to_chance ? s->left_to_chance : "valid");
    at[count++] = text_attribute("lux4:time", m->text);
    if (m->sun_known) {
        at[count++] = number_attribute("lux4:sunAzimuth", m->sun.azimuth_deg);
        at[count++] = number_attribute("lux4:sunElevation", m->sun.elevation_deg);
    }
    to->attributes      = at;
    to->attribute_count = output_attributes(at, date, from, m, s->end == RUN_INTERRUPTED);
    return true;
}

bool daylight_write_exr(const char *path, const study *from, const daylight_series *s,
                        lux_error *err)
{
    arena a      = { 0 };
    image *parts = arena_array(&a, image, (size_t)s->count + 1, err);
    bool good    = parts != NULL;
    for (int h = 0; good && h < s->count; h++)
        good =
            add_moment(&a, s, h, &parts[h], err) && add_attributes(&a, from, s, h, &parts[h], err);
    good = good && image_write_exr_parts(path, parts, s->count, err);
    arena_clear(&a);
    return good;
}

bool daylight_factor_write_exr(const char *path, const study *from, const daylight_factor *d,
                               lux_error *err)
{
    char date[CAP_DATE];
    const grid_result *r                = d->plan;
    image_attribute at[MOST_ATTRIBUTES] = {
        number_attribute("lux4:accuracy", r->asked),
        number_attribute("lux4:accuracyReached", r->reached),
        text_attribute("lux4:grid", r->grid->name),
        text_attribute("lux4:quantity", "daylight factor"),
        text_attribute("lux4:study", output_study_name(from)),
        text_attribute("lux4:unit", "%"),
        text_attribute("lux4:version", LUX4_VERSION),
        text_attribute("lux4:interval", r->left_to_chance ? r->left_to_chance : "valid"),
    };
    plane planes[]     = { { "Y", d->all },
                           { "sky.Y", d->sky },
                           { "external.Y", d->external },
                           { "internal.Y", d->internal },
                           { "halfWidth.Y", d->half_width } };
    arena a            = { 0 };
    image im           = { .attributes = at };
    im.attribute_count = output_attributes(at, date, from, NULL, r->end == RUN_INTERRUPTED);
    bool good =
        add_planes(&a, r, planes, 5, &im, err) && image_write_exr(path, &im, false, NULL, err);
    arena_clear(&a);
    return good;
}
