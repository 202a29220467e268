/* sim/grid_write.c -- see grid_write.h. */
#include "sim/grid_write.h"

#include "core/color.h"
#include "core/file.h"
#include "core/image.h"

#include <stdio.h>

bool grid_write_csv(const char *path, const grid_result *r, lux_error *err)
{
    output_file f;
    if (!file_create(&f, path, err))
        return false;
    fputs("x,y,z,nx,ny,nz,illuminance_lx,direct_lx,indirect_lx,half_width_lx\n", f.stream);
    for (int k = 0; k < r->sensor_count; k++) {
        const grid_sensor *s = &r->sensors[k];
        fprintf(f.stream, "%.12g,%.12g,%.12g,%.12g,%.12g,%.12g,%.9g,%.9g,%.9g,%.9g\n", s->at.x,
                s->at.y, s->at.z, s->normal.x, s->normal.y, s->normal.z, r->illuminance[k],
                r->direct[k], r->indirect[k], r->half_width[k]);
    }
    if (r->end == RUN_INTERRUPTED)
        fprintf(f.stream, "# partial: %s\n", run_end_text(r->end));
    return file_commit(&f, err);
}

bool grid_write_exr(const char *path, const scene *s, const grid_result *r, notices *n,
                    lux_error *err)
{
    arena scratch = { 0 };
    size_t pixels = (size_t)r->sensor_count;
    const struct {
        const char *name;
        const double *values;
    } layers[] = { { "Y", r->illuminance },
                   { "direct.Y", r->direct },
                   { "indirect.Y", r->indirect },
                   { "halfWidth.Y", r->half_width } };
    enum { LAYERS = sizeof layers / sizeof *layers };
    image_channel channels[LAYERS];
    bool good = true;

    for (int c = 0; c < LAYERS && good; c++) {
        float *values = arena_array(&scratch, float, pixels, err);
        good          = values != NULL;
        channels[c]   = (image_channel){ layers[c].name, values };
        for (int k = 0; good && k < r->sensor_count; k++) {
            int row = r->rows - 1 - k / r->columns, column = k % r->columns;
            values[(size_t)row * (size_t)r->columns + (size_t)column] = (float)layers[c].values[k];
        }
    }
    if (good) {
        image_attribute attributes[] = {
            { "whiteLuminance", ATTRIBUTE_FLOAT, NULL, (float)LUMENS_PER_WATT },
            { "lux4:accuracy", ATTRIBUTE_FLOAT, NULL, (float)r->asked },
            { "lux4:accuracyReached", ATTRIBUTE_FLOAT, NULL, (float)r->reached },
            { "lux4:grid", ATTRIBUTE_STRING, r->grid->name, 0 },
            { "lux4:quantity", ATTRIBUTE_STRING, "illuminance", 0 },
            { "lux4:study", ATTRIBUTE_STRING, output_study_name(s->study), 0 },
            { "lux4:unit", ATTRIBUTE_STRING, "lx", 0 },
            { "lux4:version", ATTRIBUTE_STRING, LUX4_VERSION, 0 },
            { "lux4:interval", ATTRIBUTE_STRING, r->left_to_chance ? r->left_to_chance : "valid",
              0 },
            { "lux4:partial", ATTRIBUTE_STRING, "interrupted", 0 }, /* the last: left out else */
        };
        int count = sizeof attributes / sizeof *attributes;
        image im  = { .width           = r->columns,
                      .height          = r->rows,
                      .channel_count   = LAYERS,
                      .channels        = channels,
                      .attribute_count = r->end == RUN_INTERRUPTED ? count : count - 1,
                      .attributes      = attributes };
        good      = image_write_exr(path, &im, false, n, err);
    }
    arena_clear(&scratch);
    return good;
}
