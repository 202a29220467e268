/* sim/cmd_check.c -- lux4 check: reads a study and all that it names, and simulates nothing. */
#include "sim/camera.h"
#include "sim/command.h"

#include <string.h>

static const double mebi = 1024.0 * 1024.0;

/* What a grid or view of that many sensors or pixels keeps while it runs, bytes. */
static double bytes_of_sensors(double sensors) { return sensors * 350.0; }
static double bytes_of_pixels(double pixels) { return pixels * 520.0; }

typedef struct findings {
    world_stats world;
    double largest; /* bytes, of the grid or view that needs most */
    double lumens;  /* of all lamps that are not far away */
} findings;

/* With what the program takes in any case. */
static double bytes_to_run(const findings *f)
{
    return (double)f->world.bytes + f->largest + 8.0 * mebi;
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

static bool look_at_grids(const command_context *c, const scene *s, findings *f, bool print,
                          lux_error *err)
{
    for (int i = 0; i < s->study->grid_count; i++) {
        grid_result r;
        if (!grid_sensors(c->a, s, &s->study->grids[i], &r, err))
            return false;
        f->largest = fmax(f->largest, bytes_of_sensors(r.sensor_count));
        if (print && s->study->grids[i].points)
            printf("  grid %-20s %8d sensors, of %s\n", r.grid->name, r.sensor_count,
                   r.grid->points);
        else if (print)
            printf("  grid %-20s %8d sensors, %d x %d, %.3g x %.3g m apart, looking %s\n",
                   r.grid->name, r.sensor_count, r.columns, r.rows,
                   d3_length(r.grid->u) / r.columns, d3_length(r.grid->v) / r.rows,
                   direction_of(r.sensors[0].normal));
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
        if (print)
            printf("  view %-20s %4d x %d pixels%s%s\n", v->name, cam.width, cam.height,
                   v->camera ? ", camera " : "", v->camera ? v->camera : "");
    }
    return true;
}

static void print_materials(const scene *s)
{
    printf("materials                          reflectance R, G, B\n");
    for (int i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->material_info[i];
        if (!m->used)
            continue;
        printf("  %-32s %6.3f %6.3f %6.3f", m->name[0] ? m->name : "(unnamed)",
               (double)m->reflectance.x, (double)m->reflectance.y, (double)m->reflectance.z);
        if (m->emission.x > 0 || m->emission.y > 0 || m->emission.z > 0)
            printf("   glows, %g %g %g cd/m2", (double)m->emission.x, (double)m->emission.y,
                   (double)m->emission.z);
        printf("%s\n", m->overridden ? "   (by the study)" : "");
    }
}

/* A line for lamps that follow one another under one name. */
static void print_lights(const scene *s)
{
    if (s->light_count == 0)
        return;
    printf("lights                               number   lumens each\n");
    for (int i = 0; i < s->light_count;) {
        const scene_light *l = &s->light_info[i];
        int same             = 1;
        while (i + same < s->light_count && !strcmp(s->light_info[i + same].name, l->name) &&
               s->light_info[i + same].lumens == l->lumens)
            same++;
        if (isfinite(l->lumens))
            printf("  %-34s %6d %13.1f\n", l->name[0] ? l->name : "(unnamed)", same, l->lumens);
        else
            printf("  %-34s %6d      far away\n", l->name[0] ? l->name : "(unnamed)", same);
        i += same;
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

static void print_json(const scene *s, const findings *f)
{
    fputs("{\"study\":", stdout);
    json_string(stdout, s->study->path);
    printf(",\"triangles\":%llu,\"placed_triangles\":%llu,\"bytes_per_triangle\":",
           (unsigned long long)f->world.triangles, (unsigned long long)f->world.placed_triangles);
    json_number(stdout,
                f->world.triangles ? (double)f->world.bytes / (double)f->world.triangles : 0.0);
    printf(",\"materials\":%d,\"lights\":%d,\"lumens\":", s->material_count, s->light_count);
    json_number(stdout, f->lumens);
    printf(",\"grids\":%d,\"views\":%d,\"memory_bytes\":", s->study->grid_count,
           s->study->view_count);
    json_number(stdout, bytes_to_run(f));
    puts("}");
}

static int check_command(const command_context *c, lux_error *err)
{
    const scene *s = command_scene(c, err);
    if (!s)
        return exit_code_of(err, true);
    findings f = { .world = world_statistics(s->world) };
    for (int i = 0; i < s->light_count; i++)
        if (isfinite(s->light_info[i].lumens))
            f.lumens += s->light_info[i].lumens;
    bool print = !c->line->json;
    if (!look_at_grids(c, s, &f, false, err) || !look_at_views(s, &f, false, err))
        return exit_code_of(err, true); /* before anything is called good */
    if (print) {
        print_world(s, &f);
        print_materials(s);
        print_lights(s);
        if (s->light_count)
            printf("  all %.0f lm%s\n", f.lumens, s->study->maintenance_given ? " initially" : "");
        printf("results asked for%s\n",
               s->study->grid_count + s->study->view_count ? "" : ": none");
    }
    if (!look_at_grids(c, s, &f, print, err) || !look_at_views(s, &f, print, err))
        return exit_code_of(err, true);
    if (print)
        printf("memory     about %.1f MiB to run\n", bytes_to_run(&f) / mebi);
    else
        print_json(s, &f);
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
