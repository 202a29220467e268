/* sim/cmd_sky.c -- lux4 sky: the study's sky and sun, as a panorama and as a picture to look at. */
#include "core/color.h"
#include "sim/command.h"
#include "sim/daylight_report.h"
#include "sim/sky_picture.h"
#include "sim/tone.h"

#include <string.h>

static const char *const extensions[] = { ".exr", ".png" };
enum { EXTENSIONS = 2, WIDTH = 2048 /* 0.18 degrees a pixel: a third of the sun */, SIDE = 768 };
static const char name[] = "sky"; /* of its files */

/* What is told of it, lx and cd/m^2. */
typedef struct sky_figures {
    double sky_lx;    /* on level ground, without the sun */
    double sun_lx;    /* the same of the sun; its part that is below the horizon gives nothing */
    double square_lx; /* of the sun, on a surface square to its beam */
    double zenith;    /* cd/m^2 */
    int suns;
    sun_figures sun;
} sky_figures;

static double lux_of(vec3 e) { return LUMENS_PER_WATT * (double)rgb_luminance(e); }

static sky_figures figures_of(const scene *s)
{
    vvec3 up      = vspread((vec3){ 0, 0, 1 });
    sky_figures f = { .suns = s->sun_count };
    for (int i = 0; i < s->sky_count; i++) {
        vrgb zenith = sky_radiance(s->skies[i].sky, &up, ALL_LANES);
        f.zenith += LUMENS_PER_WATT * (double)lane(vrgb_luminance(zenith), 0);
        if (!s->skies[i].ground)
            f.sky_lx += lux_of(s->skies[i].sky->horizontal);
    }
    for (int i = s->light_count - s->sun_count; i < s->light_count; i++) {
        f.sun     = sun_figures_of(s->lights[i]);
        double lx = lux_of(f.sun.irradiance);
        f.square_lx += lx;
        f.sun_lx += lx * fmax((double)f.sun.to_sun.z, 0.0);
    }
    return f;
}

/* ---- files ----------------------------------------------------------------------------------- */

static bool write_exr(const command_context *c, const scene *s, const sky_figures *f,
                      const char *path, lux_error *err)
{
    float *rgb[3];
    char date[CAP_DATE];
    int width = c->line->width ? c->line->width : WIDTH;
    if (!sky_panorama_picture(c->a, s, width, rgb, err))
        return false;
    image_channel channels[3] = { { "R", rgb[0] }, { "G", rgb[1] }, { "B", rgb[2] } };
    image_attribute attributes[MOST_ATTRIBUTES] = {
        { "whiteLuminance", ATTRIBUTE_FLOAT, NULL, (float)LUMENS_PER_WATT },
        { "lux4:radianceUnit", ATTRIBUTE_STRING, "W/(sr m^2)", 0 },
        { "lux4:sky", ATTRIBUTE_STRING, s->study->sky.name, 0 },
        { "lux4:skyIlluminance", ATTRIBUTE_FLOAT, NULL, (float)f->sky_lx },
        { "lux4:sunIlluminance", ATTRIBUTE_FLOAT, NULL, (float)f->square_lx },
        { "lux4:study", ATTRIBUTE_STRING, output_study_name(s->study), 0 },
        { "lux4:version", ATTRIBUTE_STRING, LUX4_VERSION, 0 },
    };
    image im = { .width         = width,
                 .height        = width / 2,
                 .channel_count = 3,
                 .channels      = channels,
                 .attribute_count =
                     output_attributes(attributes, date, s->study, s->moments, false),
                 .attributes = attributes };
    return image_write_exr(path, &im, c->line->half, c->notices, err);
}

/* Looking up, as maps of the sky have it: north up, east to the left. */
static bool write_png(const command_context *c, const scene *s, const char *path, lux_error *err)
{
    camera up = { .width      = SIDE,
                  .height     = SIDE,
                  .projection = PROJECTION_FISHEYE,
                  .right      = { -1, 0, 0 },
                  .up         = { 0, 1, 0 },
                  .forward    = { 0, 0, 1 } };
    float *rgb[3];
    tone_options o = { .exposure_ev = c->line->exposure_ev };
    uint8_t *bytes = arena_array(c->a, uint8_t, 3 * (size_t)SIDE * SIDE, err);
    return bytes && sky_picture(c->a, s, &up, rgb, err) &&
           tone_photographic(rgb[0], rgb[1], rgb[2], SIDE, SIDE, &o, bytes, c->a, err) &&
           image_write_rgb8(path, SIDE, SIDE, bytes, err);
}

/* ---- what is printed ------------------------------------------------------------------------- */

static double azimuth_of(const scene *s, vec3 to)
{
    double azimuth = atan2((double)to.x, (double)to.y) * (180.0 / M_PI) - s->study->site.north_deg;
    return azimuth - 360.0 * floor(azimuth / 360.0);
}

static double elevation_of(vec3 to)
{
    return asin(fmin(fmax((double)to.z, -1.0), 1.0)) * (180.0 / M_PI);
}

static void print_table(const scene *s, const sky_figures *f)
{
    printf("on level ground  %12.0f lx of the sky\n", f->sky_lx);
    if (f->suns)
        printf("                 %12.0f lx of the sun, %.0f lx square to it\n", f->sun_lx,
               f->square_lx);
    printf("                 %12.0f lx together\n", f->sky_lx + f->sun_lx);
    printf("at the zenith    %12.0f cd/m2\n", f->zenith);
    if (f->suns)
        printf(
            "the sun's place  azimuth %.2f (clockwise from north), elevation %.2f, diameter %.2f "
            "degrees\n",
            azimuth_of(s, f->sun.to_sun), elevation_of(f->sun.to_sun), f->sun.diameter_deg);
}

static void json_value(const char *key, double value)
{
    printf(",\"%s\":", key);
    json_number(stdout, value);
}

static void print_json(const scene *s, const daylight_report *r, const sky_figures *f,
                       const char *exr, const char *png)
{
    bool sun = f->suns > 0;
    putchar('{');
    daylight_report_json(s->study, r);
    json_value("sky_horizontal_lx", f->sky_lx);
    json_value("sun_horizontal_lx", f->sun_lx);
    json_value("sun_normal_lx", f->square_lx);
    json_value("zenith_cd_m2", f->zenith);
    json_value("sun_azimuth_deg", sun ? azimuth_of(s, f->sun.to_sun) : (double)NAN);
    json_value("sun_elevation_deg", sun ? elevation_of(f->sun.to_sun) : (double)NAN);
    json_value("sun_diameter_deg", sun ? f->sun.diameter_deg : (double)NAN);
    fputs(",\"exr\":", stdout);
    json_string(stdout, exr);
    fputs(",\"png\":", stdout);
    json_string(stdout, png);
    puts("}");
}

/* ---- the command ----------------------------------------------------------------------------- */

/* Whether a grid or view would have the same files. */
static bool name_free(const study *s, lux_error *err)
{
    bool taken = false;
    for (int i = 0; i < s->grid_count; i++)
        taken = taken || !strcmp(s->grids[i].name, name);
    for (int i = 0; i < s->view_count; i++)
        taken = taken || !strcmp(s->views[i].name, name);
    return !taken || failed(err, ERR_ARGUMENT,
                            "%s: a grid or view is called `%s`, as the files of this command are",
                            s->path, name);
}

static bool may_run(const command_context *c, const scene *s, lux_error *err)
{
    if (s->moment_count == 0)
        return failed(err, ERR_ARGUMENT, "%s: the study has no `sky`", s->study->path);
    return name_free(s->study, err) &&
           output_check(s->study, &c->line->place, name, extensions, EXTENSIONS, err);
}

static int sky_command(const command_context *c, lux_error *err)
{
    daylight_report r;
    const scene *s = command_scene(c, err);
    if (!s || !may_run(c, s, err) || !daylight_report_of(c->a, s->study, s, &r, err))
        return exit_code_of(err, true);
    sky_figures f   = figures_of(s);
    const char *exr = output_path(c->a, s->study, &c->line->place, name, ".exr", err);
    const char *png = exr ? output_path(c->a, s->study, &c->line->place, name, ".png", err) : NULL;
    if (!png || !image_pictures_ready(err) || !write_exr(c, s, &f, exr, err) ||
        !write_png(c, s, png, err))
        return exit_code_of(err, false);
    terminal_clear(c->terminal);
    if (c->line->json) {
        print_json(s, &r, &f, exr, png);
        return EXIT_DONE;
    }
    daylight_report_print(s->study, &r);
    print_table(s, &f);
    printf("written: %s, %s\n", exr, png);
    return EXIT_DONE;
}

const command command_sky = {
    .name    = "sky",
    .files   = "STUDY.yaml",
    .summary = "the study's sky and sun as a panorama .exr and a fisheye .png",
    .help    = "sky.exr is all around, zenith at the top, +y of the scene in the middle, R G B in\n"
               "W/(sr m2) (times 179: cd/m2): read back as {model: panorama, file: sky.exr} it gives\n"
               "the same light; the sun in it is found again and made a lamp (but with --half, whose\n"
               "numbers cannot hold it). Nothing of the building is in it. sky.png looks up: north\n"
               "(+y) is up, east to the left, as on maps of stars. Printed: place and time, the sun,\n"
               "by which formulae sky and sun are as bright as they are, illuminance on level ground\n"
               "in lx, luminance at the zenith in cd/m2.\n",
    .options = " -o --overwrite --variant --threads --width --half --exposure --json --quiet ",
    .run     = sky_command,
};
