/* sim/cmd_check.c -- lux4 check: reads a study and all that it names, and simulates nothing. */
#include "sim/camera.h"
#include "sim/command.h"
#include "sim/daylight_report.h"
#include "sim/sensor.h"

#include <limits.h>
#include <string.h>

static const double mebi = 1024.0 * 1024.0;

/* What a grid or view of that many sensors or pixels keeps while it runs, bytes. */
static double bytes_of_sensors(double sensors) { return sensors * 350.0; }
static double bytes_of_pixels(double pixels) { return pixels * 520.0; }
/* What a picture needs while it is loaded: as four floats a texel, beside its file of at most four
 * bytes a texel. */
static double bytes_of_picture(double decoded) { return 1.25 * decoded; }
/* What reads pictures: OpenImageIO with the libraries behind it, as measured. */
static const double bytes_of_reader = 117.0 * 1024.0 * 1024.0;

typedef struct findings {
    const study *study; /* as read: of a series the scene has the first moment */
    daylight_report daylight;
    world_stats world;
    double textures; /* bytes */
    double picture;  /* bytes, of the largest while it is loaded: before there is a world */
    double largest;  /* bytes, of the grid or view that needs most */
    double lumens;   /* of all lights that are not far away */
    int name_width;  /* of lights, groups, grids and views */
} findings;

/* With what the program takes in any case. */
static double bytes_to_run(const findings *f)
{
    double reader = f->textures > 0.0 ? bytes_of_reader : 0.0;
    return f->textures + fmax((double)f->world.bytes + f->largest, f->picture) + reader +
           8.0 * mebi;
}

/* "up", "along +x", ...: where the sensors of a plane look. */
static const char *direction_of(dvec3 n)
{
    if (fabs(n.z) > 0.99)
        return n.z > 0.0 ? "up" : "down";
    if (fabs(n.x) > 0.99)
        return n.x > 0.0 ? "along +x" : "along -x";
    if (fabs(n.y) > 0.99)
        return n.y > 0.0 ? "along +y" : "along -y";
    return "aslant";
}

static void print_grid(const grid_result *r, int width)
{
    const study_grid *g = r->grid;
    fputs("  grid ", stdout);
    print_words(stdout, g->name, width, INT_MAX);
    printf(" %8d sensors", r->sensor_count);
    if (g->points)
        printf(", of %s", g->points);
    else
        printf(", %d x %d, %.3g x %.3g m apart%s", r->columns, r->rows,
               d3_length(g->u) / r->columns, d3_length(g->v) / r->rows,
               g->en12464 ? " (EN 12464-1)" : "");
    if (g->quantity != QUANTITY_PLANAR)
        printf(", %s", grid_quantity_name(g->quantity));
    if (!g->points && !quantity_is_round(g->quantity))
        printf(", looking %s", direction_of(r->sensors[0].normal));
    if (r->left_out)
        printf("; %d more inside furniture left out", r->left_out);
    putchar('\n');
}

static bool look_at_grids(const command_context *c, const scene *s, findings *f, bool print,
                          lux_error *err)
{
    for (int i = 0; i < s->study->grid_count; i++) {
        grid_result r;
        if (!grid_sensors(c->a, s, &s->study->grids[i], &r, err))
            return false;
        f->largest = fmax(f->largest, bytes_of_sensors(r.sensor_count));
        if (print)
            print_grid(&r, f->name_width);
    }
    return true;
}

static bool look_at_views(const scene *s, findings *f, bool print, lux_error *err)
{
    for (int i = 0; i < s->study->view_count; i++) {
        camera cam;
        const study_view *v = &s->study->views[i];
        if (!camera_of_view(s, v, &cam, err))
            return false;
        f->largest = fmax(f->largest, bytes_of_pixels((double)cam.width * cam.height));
        if (!print)
            continue;
        fputs("  view ", stdout);
        print_words(stdout, v->name, f->name_width, INT_MAX);
        printf(" %4d x %d pixels%s", cam.width, cam.height, v->camera ? ", camera " : "");
        print_words(stdout, v->camera ? v->camera : "", 0, INT_MAX);
        putchar('\n');
    }
    return true;
}

/* ---- materials ------------------------------------------------------------------------------- */

/* One number if all channels have it. */
static void print_share(vec3 c, int width)
{
    char text[64];
    if (c.x == c.y && c.x == c.z)
        snprintf(text, sizeof text, "%.3f", (double)c.x);
    else
        snprintf(text, sizeof text, "%.3f %.3f %.3f", (double)c.x, (double)c.y, (double)c.z);
    printf("%*s", width, text);
}

/* What passes the surface or its holes. */
static vec3 let_through(const scene_material *m)
{
    vec3 t       = v3_scale(m->transmittance, (float)m->there);
    double holes = 1.0 - m->there;
    return (vec3){ (float)((double)t.x + holes), (float)((double)t.y + holes),
                   (float)((double)t.z + holes) };
}

static bool is_dark(vec3 c) { return c.x == 0.0f && c.y == 0.0f && c.z == 0.0f; }

/* What is not plain about a material. */
static void print_notes(const scene_material *m)
{
    vec3 through = let_through(m);
    if (!is_dark(through)) {
        printf("   lets through ");
        print_share(through, 0);
    }
    if (m->file) {
        fputs("   of ", stdout);
        print_words(stdout, m->file, 0, INT_MAX);
        printf(", reciprocity error %.1f %%", 100.0 * m->reciprocity);
        if (m->scaled_by < 1.0)
            printf(", scaled by %.4g", m->scaled_by);
    }
    if (m->textured)
        printf("   textured");
    if (m->holes)
        printf("   with holes");
    if (m->box)
        printf("   closed boxes");
    if (m->exterior)
        printf("   outside");
    if (!is_dark(m->emission))
        printf("   glows, %g %g %g cd/m2", (double)m->emission.x, (double)m->emission.y,
               (double)m->emission.z);
    printf("%s\n", m->overridden ? "   (by the study)" : "");
}

static void print_materials(const scene *s)
{
    int width = 20;
    for (int i = 0; i < s->material_count; i++)
        if (s->material_info[i].used)
            width = print_width(s->material_info[i].name, width);
    print_words(stdout, "materials", width + 2, INT_MAX);
    printf("   kind       reflects R, G, B\n");
    for (int i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->material_info[i];
        if (!m->used)
            continue;
        fputs("  ", stdout);
        print_words(stdout, m->name[0] ? m->name : "(unnamed)", width, INT_MAX);
        printf("   %-10s", m->kind);
        print_share(v3_scale(m->reflectance, (float)m->there), 17);
        print_notes(m);
    }
}

/* ---- lights ---------------------------------------------------------------------------------- */

static bool is_same(const scene_light *a, const scene_light *b)
{
    return !strcmp(a->name, b->name) && a->lumens == b->lumens && a->group == b->group &&
           a->dimmed_to == b->dimmed_to && a->luminaire == b->luminaire &&
           a->color.x == b->color.x && a->color.y == b->color.y && a->color.z == b->color.z;
}

/* What is not plain about a light. */
static void print_kind(const scene *s, const scene_light *l)
{
    vec3 c = l->color;
    if (s->group_count > 1)
        printf("   group %s", s->groups[l->group]);
    if (l->dimmed_to != 1.0)
        printf("   dimmed to %.4g", l->dimmed_to);
    if (c.x != 1.0f || c.y != 1.0f || c.z != 1.0f)
        printf("   colour %.3g %.3g %.3g", (double)c.x, (double)c.y, (double)c.z);
    if (l->luminaire && l->luminaire->nodes) {
        fputs("   at nodes ", stdout);
        print_words(stdout, l->luminaire->nodes, 0, INT_MAX);
    }
    putchar('\n');
}

static void print_line(const char *name, int width, int count, double lumens)
{
    fputs("  ", stdout);
    print_words(stdout, name[0] ? name : "(unnamed)", width, INT_MAX);
    if (isfinite(lumens))
        printf(" %7d %13.1f", count, lumens);
    else
        printf(" %7d %13s", count, "far away");
}

/* A line for lamps that follow one another and are the same. */
static void print_lights(const scene *s, const findings *f)
{
    if (s->light_count + s->emitter_count == 0)
        return;
    print_words(stdout, "lights", f->name_width + 2, INT_MAX);
    printf(" %7s %13s\n", "number", "each/lm");
    for (int i = 0, same; i < s->light_count; i += same) {
        const scene_light *l = &s->light_info[i];
        for (same = 1; i + same < s->light_count && is_same(l, &s->light_info[i + same]);)
            same++;
        print_line(l->name, f->name_width, same, l->lumens);
        print_kind(s, l);
    }
    if (s->emitter_count) {
        print_line("glowing surfaces", f->name_width, 1, scene_glow_lumens(s));
        printf("   %d triangles\n", s->emitter_count);
    }
    fputs("  ", stdout);
    print_words(stdout, "all", f->name_width, INT_MAX);
    printf(" %7d %13.1f%s\n", s->light_count + (s->emitter_count > 0), f->lumens,
           s->study->maintenance_given ? "   initial" : "");
}

/* ---- groups ---------------------------------------------------------------------------------- */

typedef struct group_sum {
    int lights;
    double lumens; /* of those that are not far away */
} group_sum;

static bool sum_groups(arena *a, const scene *s, group_sum **out, lux_error *err)
{
    group_sum *sums = *out = arena_array(a, group_sum, (size_t)s->group_count + 1, err);
    for (int i = 0; sums && i < s->light_count; i++) {
        const scene_light *l = &s->light_info[i];
        sums[l->group].lights++;
        sums[l->group].lumens += isfinite(l->lumens) ? l->lumens : 0.0;
    }
    if (sums && s->emitter_count) {
        sums[s->glow_group].lights++;
        sums[s->glow_group].lumens += scene_glow_lumens(s);
    }
    return sums != NULL;
}

static void print_groups(const scene *s, const findings *f, const group_sum *sums)
{
    if (s->group_count < 2)
        return;
    print_words(stdout, "groups", f->name_width + 2, INT_MAX);
    printf(" %7s %13s\n", "lights", "all/lm");
    for (int g = 0; g < s->group_count; g++) {
        print_line(s->groups[g], f->name_width, sums[g].lights, sums[g].lumens);
        putchar('\n');
    }
}

static void print_world(const scene *s, const findings *f)
{
    const world_stats *w = &f->world;
    printf("%s: good\n", s->study->path);
    if (s->low.x <= s->high.x)
        printf("geometry   %llu triangles, %llu with every instance; x %g to %g, y %g to %g, z %g "
               "to %g m\n",
               (unsigned long long)w->triangles, (unsigned long long)w->placed_triangles, s->low.x,
               s->high.x, s->low.y, s->high.y, s->low.z, s->high.z);
    else
        printf("geometry   none\n");
    if (w->triangles)
        printf("           %.0f bytes a triangle, built in %.2f s\n",
               (double)w->bytes / (double)w->triangles, w->build_seconds);
}

/* Daylight is looked for everywhere, but by portals first. */
static void print_portals(const scene *s)
{
    if (s->sky_count == 0 && s->sun_count == 0)
        return;
    fputs("portals    ", stdout);
    print_words(stdout, s->portals_from ? s->portals_from : "none", 0, INT_MAX);
    putchar('\n');
}

static void print_json(const scene *s, const findings *f, const group_sum *sums)
{
    fputs("{\"study\":", stdout);
    json_string(stdout, s->study->path);
    putchar(',');
    daylight_report_json(f->study, &f->daylight);
    printf(",\"triangles\":%llu,\"placed_triangles\":%llu,\"bytes_per_triangle\":",
           (unsigned long long)f->world.triangles, (unsigned long long)f->world.placed_triangles);
    json_number(stdout,
                f->world.triangles ? (double)f->world.bytes / (double)f->world.triangles : 0.0);
    printf(",\"materials\":%d,\"lights\":%d,\"lumens\":", s->material_count, s->light_count);
    json_number(stdout, f->lumens);
    printf(",\"glowing_triangles\":%d,\"groups\":[", s->emitter_count);
    for (int g = 0; g < s->group_count; g++) {
        fputs(g ? ",{\"name\":" : "{\"name\":", stdout);
        json_string(stdout, s->groups[g]);
        printf(",\"lights\":%d,\"lumens\":", sums[g].lights);
        json_number(stdout, sums[g].lumens);
        putchar('}');
    }
    putchar(']');
    printf(",\"grids\":%d,\"views\":%d,\"memory_bytes\":", s->study->grid_count,
           s->study->view_count);
    json_number(stdout, bytes_to_run(f));
    puts("}");
}

static int name_width(const scene *s)
{
    int width = 0;
    for (int i = 0; i < s->light_count; i++)
        width = print_width(s->light_info[i].name, width);
    for (int i = 0; i < s->group_count; i++)
        width = print_width(s->groups[i], width);
    for (int i = 0; i < s->study->grid_count; i++)
        width = print_width(s->study->grids[i].name, width);
    for (int i = 0; i < s->study->view_count; i++)
        width = print_width(s->study->views[i].name, width);
    return width;
}

/* The study at the first of its moments. */
static const study *at_first_moment(const command_context *c, const study *s, lux_error *err)
{
    int count;
    study *first        = arena_new(c->a, study, err);
    const moment *found = first ? moments_of(c->a, s, &s->when, &count, c->notices, err) : NULL;
    if (!found)
        return NULL;
    *first      = *s;
    first->when = (study_when){ .where = s->when.where, .given = true };
    return clock_read(&first->when.at, found->text, err) ? first : NULL;
}

static const scene *open_scene(const command_context *c, const study **as_read, lux_error *err)
{
    if (c->line->file_count != 1)
        return command_scene(c, err); /* which says so */
    scene_options o = { .threads = command_threads(c), .layered = c->line->groups };
    const study *s  = study_read(c->a, c->line->files[0], c->line->variant, c->notices, err);
    *as_read        = s;
    if (s && s->when.given && s->when.series)
        s = at_first_moment(c, s, err);
    return s ? scene_new(c->a, s, &o, c->notices, err) : NULL;
}

static int check_command(const command_context *c, lux_error *err)
{
    findings f;
    const study *as_read = NULL;
    const scene *s       = open_scene(c, &as_read, err);
    group_sum *sums;
    if (!s || !sum_groups(c->a, s, &sums, err))
        return exit_code_of(err, true);
    f = (findings){ .study      = as_read,
                    .world      = world_statistics(s->world),
                    .textures   = (double)s->texture_bytes,
                    .picture    = bytes_of_picture((double)s->picture_bytes),
                    .name_width = name_width(s) };
    if (!daylight_report_of(c->a, as_read, s, &f.daylight, err))
        return exit_code_of(err, true);
    for (int g = 0; g < s->group_count; g++)
        f.lumens += sums[g].lumens;
    bool print = !c->line->json;
    if (!look_at_grids(c, s, &f, false, err) || !look_at_views(s, &f, false, err))
        return exit_code_of(err, true); /* before anything is called good */
    if (print) {
        print_world(s, &f);
        daylight_report_print(as_read, &f.daylight);
        print_portals(s);
        print_materials(s);
        print_lights(s, &f);
        print_groups(s, &f, sums);
        printf("results asked for%s\n",
               s->study->grid_count + s->study->view_count ? "" : ": none");
    }
    if (!look_at_grids(c, s, &f, print, err) || !look_at_views(s, &f, print, err))
        return exit_code_of(err, true);
    if (print)
        printf("memory     about %.1f MiB to run\n", bytes_to_run(&f) / mebi);
    else
        print_json(s, &f, sums);
    return EXIT_DONE;
}

const command command_check = {
    .name    = "check",
    .files   = "STUDY.yaml",
    .summary = "validates a study and all it names, predicts memory; simulates nothing",
    .help    = "",
    .options = " --variant --threads --json --quiet ",
    .run     = check_command,
};
