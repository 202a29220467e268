/* sim/cmd_render.c -- lux4 render: the study's views as radiometric EXR and preview. */
#include "sim/command.h"
#include "sim/render.h"

static const char *const extensions[] = { ".exr", ".png" };
enum { EXTENSIONS = 2 };

static void print_view(const command_context *c, const view_result *r, const char *exr,
                       const char *png, bool first)
{
    if (c->line->json) {
        fputs(first ? "{\"views\":[{\"name\":" : ",{\"name\":", stdout);
        json_string(stdout, r->view->name);
        printf(",\"width\":%d,\"height\":%d,\"log_average_cd_m2\":", r->width, r->height);
        json_number(stdout, r->log_average);
        fputs(",\"accuracy_percent\":", stdout);
        json_number(stdout, 100.0 * r->reached);
        fputs(",\"exr\":", stdout);
        json_string(stdout, exr);
        fputs(",\"png\":", stdout);
        json_string(stdout, png);
        if (r->end == RUN_INTERRUPTED)
            fputs(",\"partial\":true", stdout);
        printf(",\"interval_valid\":%s", r->left_to_chance ? "false" : "true");
        printf(",\"seconds\":%.9g,\"rays\":%lld}", r->seconds, (long long)r->rays);
        return;
    }
    if (first)
        printf("%-16s %11s %15s %12s %9s %12s\n", "view", "pixels", "log-mean/cd/m2", "accuracy/%",
               "time/s", "rays/million");
    char pixels[32];
    snprintf(pixels, sizeof pixels, "%dx%d", r->width, r->height);
    printf("%-16s %11s %15.2f %12.1f %9.2f %12.1f\n", r->view->name, pixels, r->log_average,
           100.0 * r->reached, r->seconds, 1e-6 * (double)r->rays);
    if (r->left_to_chance)
        printf("  interval not valid: %s\n", r->left_to_chance);
    printf("  written: %s, %s\n", exr, png);
}

typedef struct totals {
    const struct illumination_map *map; /* that all views share; NULL */
    plan plan;
    int printed; /* views */
    int code;    /* EXIT_INACCURATE once a view was */
} totals;

static int run_view(const command_context *c, const scene *s, int index, totals *all,
                    lux_error *err)
{
    const study_view *v = &s->study->views[index];
    arena of_view       = { 0 };
    view_result r;
    run_options o   = command_run_options(c, s->study->view_count - index);
    const char *exr = output_path(c->a, s->study, &c->line->place, v->name, ".exr", err);
    const char *png =
        exr ? output_path(c->a, s->study, &c->line->place, v->name, ".png", err) : NULL;
    int code = EXIT_DONE;
    plan_apply(&all->plan, &o);
    if (!png || !command_maps(c, s, s->study->view_count, &o, &all->map, err) ||
        !view_run(&of_view, s, v, &o, &r, err))
        code = exit_code_of(err, false); /* files are read by now: maps are written */
    if (code == EXIT_DONE) {
        terminal_clear(c->terminal);
        if (!view_write_exr(exr, s, &r, c->line->half, c->notices, err) ||
            !view_write_png(png, &r, c->line->exposure_ev, err))
            code = exit_code_of(err, false);
        else
            print_view(c, &r, exr, png, all->printed++ == 0);
        if (code == EXIT_DONE && s->light_count && r.log_average == 0.0)
            notice_add(c->notices,
                       "view %s: all is black: surfaces are opaque from both sides; is the "
                       "eye outside of the room, or inside something solid?",
                       v->name);
        if (code == EXIT_DONE)
            code = command_end(r.end, "view", v->name, err);
    }
    arena_clear(&of_view);
    return code;
}

static int render_command(const command_context *c, lux_error *err)
{
    if (!command_transport_fits(c, err))
        return EXIT_INPUT;
    totals all     = { 0 };
    const scene *s = command_planned_scene(c, true, &all.plan, err);
    if (!s)
        return exit_code_of(err, true);
    if (s->study->view_count == 0) {
        failed(err, ERR_ARGUMENT, "%s: the study has no `views`", s->study->path);
        return EXIT_INPUT;
    }
    for (int i = 0; i < s->study->view_count; i++) {
        camera ignored;
        const study_view *v = &s->study->views[i];
        if (!camera_of_view(s, v, &ignored, err) ||
            !output_check(s->study, &c->line->place, v->name, extensions, EXTENSIONS, err))
            return exit_code_of(err, true);
    }
    if (!image_pictures_ready(err))
        return exit_code_of(err, false);

    int code = EXIT_DONE;
    for (int i = 0; i < s->study->view_count && code == EXIT_DONE; i++) {
        code = run_view(c, s, i, &all, err);
        if (code == EXIT_INACCURATE) /* the next one may do better */
            all.code = code, code = EXIT_DONE;
    }
    if (c->line->json)
        fputs(all.printed ? "]}\n" : "{\"views\":[]}\n", stdout);
    return code == EXIT_DONE ? all.code : code;
}

const command command_render = {
    .name    = "render",
    .files   = "STUDY.yaml",
    .summary = "the study's views: radiometric .exr and tone-mapped .png",
    .help    = "The EXR holds R G B in W/(sr m2) (times 179: cd/m2), illuminance.Y in lux on the\n"
               "surface seen, halfWidth.Y in cd/m2, Z in metres along the ray (0: nothing seen),\n"
               "normal.X/Y/Z and albedo.R/G/B. A view is done when 98 % of its pixels are within the\n"
               "accuracy asked for, of their value or of a tenth of the picture's log-average: 10 %\n"
               "unless --accuracy says otherwise (`accuracy` in the study is for grids).\n",
    .options = " -o --overwrite --accuracy --time --variant --threads --seed --direct-only "
               "--transport --save-maps --no --only --groups --half "
               "--exposure "
               "--json --quiet ",
    .run     = render_command,
};
