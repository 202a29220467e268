/* sim/cmd_grid.c -- lux4 grid: how much light arrives on the study's grids. */
#include "sim/command.h"
#include "sim/grid_write.h"
#include "sim/schedule.h"

#include <limits.h>
#include <math.h>
#include <string.h>

static const char *const extensions[] = { ".csv", ".exr" };
enum { EXTENSIONS = 2 };

typedef struct totals {
    const struct illumination_map *map; /* that all grids share; NULL */
    double seconds;
    int64_t rays;
    bool interval_valid;
    plan plan;
    double *averages; /* lx, of each grid; NAN: it did not run */
    int name_width;   /* of the table */
    int printed;
    int code; /* EXIT_INACCURATE once a grid was */
} totals;

/* ---- as a table ------------------------------------------------------------------------------ */

/* To so many digits, or in whole numbers where these are more: no 1.8e+05 lx. */
static void print_digits(double x, int digits)
{
    double least_whole = pow(10.0, digits) - 0.5;
    if (fabs(x) < least_whole)
        printf("%.*g", digits, x);
    else
        printf("%.0f", x);
}

static void print_requirement(const grid_requirement *q)
{
    const char *blank = q->unit[0] ? " " : "";
    printf("  %-10s asked %s", q->name, strcmp(q->name, "maximum") ? "" : "at most ");
    print_digits(q->asked, 6);
    printf("%s%s, got ", blank, q->unit);
    print_digits(q->got, 4);
    printf(" +- ");
    print_digits(q->half_width, 2);
    printf("%s%s: %s%s\n", blank, q->unit, q->met ? "met" : "MISSED",
           q->decided ? "" : " (not decided at this accuracy: ask for more)");
}

/* By which way the light of the average has come, if some has come by mirrors or was focused. */
static void print_classes(const grid_result *r)
{
    static const char *const names[] = { [CLASS_DIRECT]    = "direct",
                                         [CLASS_REFLECTED] = "reflected",
                                         [CLASS_MIRRORED]  = "in plane mirrors",
                                         [CLASS_FOCUSED]   = "focused" };
    if (!(r->classes[CLASS_MIRRORED].average > 0.0 || r->classes[CLASS_FOCUSED].average > 0.0))
        return;
    const char *between = "  of the average: ";
    for (int c = 0; c < LIGHT_CLASSES; c++) {
        printf("%s%s ", between, names[c]);
        print_digits(r->classes[c].average, 4);
        printf(" +- ");
        print_digits(r->classes[c].half_width, 2);
        between = ", ";
    }
    puts(" lx");
}

static void print_table(const scene *s, const grid_result *r, const totals *t)
{
    if (t->printed == 0) {
        print_words(stdout, "grid", t->name_width, INT_MAX);
        printf(" %8s %11s %11s %11s %8s %12s %9s\n", "sensors", "average/lx", "minimum/lx",
               "maximum/lx", "min/avg", "half-width/%", "time/s");
    }
    double worst = 100.0 * r->worst_half_width;
    print_words(stdout, r->grid->name, t->name_width, INT_MAX);
    printf(" %8d %11.1f %11.1f %11.1f %8.3f %12.2f %9.2f\n", r->sensor_count, r->average,
           r->minimum, r->maximum, r->uniformity, worst, r->seconds);
    if (r->grid->quantity != QUANTITY_PLANAR)
        printf("  %s\n", grid_quantity_name(r->grid->quantity));
    double m             = s->study->maintenance;
    bool electric        = scene_lamp_count(s) > 0 || s->glows;
    grid_summary initial = grid_initial(r, m);
    if (s->study->maintenance_given && electric && m != 1.0)
        printf("  %-*s %8s %11.1f %11.1f %11.1f %8s   (above: maintained, factor %g)\n",
               t->name_width - 2, "initial", "", initial.average, initial.minimum, initial.maximum,
               "", m);

    grid_requirement asked[MOST_REQUIREMENTS];
    int count = grid_requirements(r, asked);
    for (int i = 0; i < count; i++)
        print_requirement(&asked[i]);
    print_classes(r);
    command_grid_remarks(r, r->end, r->missed, r->asked, r->left_to_chance);
}

/* ---- as JSON --------------------------------------------------------------------------------- */

static void print_json(const grid_result *r, bool first)
{
    fputs(first ? "{\"grids\":[{\"name\":" : ",{\"name\":", stdout);
    json_string(stdout, r->grid->name);
    json_field_text("quantity", grid_quantity_name(r->grid->quantity));
    json_field("sensors", r->sensor_count);
    json_field("average_lx", r->average);
    json_field("minimum_lx", r->minimum);
    json_field("maximum_lx", r->maximum);
    json_field("uniformity", r->uniformity);
    json_field("average_half_width_lx", r->average_half_width);
    json_field("worst_half_width_percent", 100.0 * r->worst_half_width);
    json_field("sensors_missed", r->missed);
    static const char *const classes[] = { [CLASS_DIRECT]    = "direct",
                                           [CLASS_REFLECTED] = "reflected",
                                           [CLASS_MIRRORED]  = "mirrored",
                                           [CLASS_FOCUSED]   = "focused" };
    for (int i = 0; i < LIGHT_CLASSES; i++) {
        char key[40];
        snprintf(key, sizeof key, "average_%s_lx", classes[i]);
        json_field(key, r->classes[i].average);
        snprintf(key, sizeof key, "average_%s_half_width_lx", classes[i]);
        json_field(key, r->classes[i].half_width);
    }
    if (r->left_out_lm > 0.0)
        json_field("left_out_lm", r->left_out_lm);
    if (r->left_out)
        json_field("sensors_left_out", r->left_out);
    if (r->end == RUN_INTERRUPTED)
        fputs(",\"partial\":true", stdout);
    fputs(",\"requirements\":[", stdout);
    grid_requirement asked[MOST_REQUIREMENTS];
    int count = grid_requirements(r, asked);
    for (int i = 0; i < count; i++) {
        printf("%s{\"name\":\"%s\"", i ? "," : "", asked[i].name);
        json_field("asked", asked[i].asked);
        json_field("got", asked[i].got);
        json_field("half_width", asked[i].half_width);
        printf(",\"met\":%s,\"decided\":%s}", asked[i].met ? "true" : "false",
               asked[i].decided ? "true" : "false");
    }
    fputs("]}", stdout);
}

static void print_effects_json(const plan *p)
{
    const char *between = "";
    fputs(",\"effects\":[", stdout);
    for (int e = 0; e < EFFECTS; e++)
        if (p->effects[e].on) {
            printf("%s\"%s\"", between, effect_name((effect)e));
            between = ",";
        }
    putchar(']');
}

static void print_json_end(const scene *s, const schedule *list, const totals *t)
{
    printf("%s]", t->printed ? "" : "{\"grids\":[");
    json_field("seconds", t->seconds);
    json_field("rays", (double)t->rays);
    print_effects_json(&t->plan);
    if (list) {
        fputs(",\"schedule\":", stdout);
        schedule_print_json(stdout, s, list, t->averages);
    }
    printf(",\"interval_valid\":%s}\n", t->interval_valid ? "true" : "false");
}

/* ---- the command ----------------------------------------------------------------------------- */

static bool write_files(const command_context *c, const scene *s, const grid_result *r,
                        lux_error *err)
{
    const output_place *o = &c->line->place;
    const char *name      = r->grid->name;
    const char *csv       = output_path(c->a, s->study, o, name, ".csv", err);
    const char *exr       = csv ? output_path(c->a, s->study, o, name, ".exr", err) : NULL;
    if (!exr || !grid_write_csv(csv, s, r, err) || !grid_write_exr(exr, s, r, c->notices, err))
        return false;
    if (!c->line->json)
        printf("  written: %s, %s\n", csv, exr);
    return true;
}

static int run_one(const command_context *c, const scene *s, int index, totals *t, lux_error *err)
{
    grid_result r;
    arena of_grid = { 0 };
    run_options o = command_run_options(c, s->study->grid_count - index);
    int code      = EXIT_DONE;
    plan_apply(&t->plan, &o);
    if (!command_maps(c, s, s->study->grid_count, &o, &t->map, err) ||
        !grid_run(&of_grid, s, &s->study->grids[index], &o, &r, err))
        code = exit_code_of(err, false); /* files are read by now: maps are written */
    if (code == EXIT_DONE) {
        terminal_clear(c->terminal);
        if (c->line->json)
            print_json(&r, t->printed == 0);
        else
            print_table(s, &r, t);
        if (s->light_count && r.maximum == 0.0)
            notice_add(
                c->notices,
                "grid %s: no light arrives at all: do its sensors look away, or are they, or "
                "the lamps, outside of the room or inside something solid?",
                r.grid->name);
        t->printed++;
        t->averages[index] = r.average;
        t->seconds += r.seconds;
        t->rays += r.rays;
        t->interval_valid &= !r.left_to_chance;
        code = write_files(c, s, &r, err) ? command_end(r.end, "grid", r.grid->name, err)
                                          : exit_code_of(err, false);
    }
    arena_clear(&of_grid);
    return code;
}

static int run_all(const command_context *c, const scene *s, totals *t, lux_error *err)
{
    int code = EXIT_DONE;
    for (int i = 0; i < s->study->grid_count && code == EXIT_DONE; i++) {
        code = run_one(c, s, i, t, err);
        if (code == EXIT_INACCURATE) /* the next one may do better */
            t->code = code, code = EXIT_DONE;
    }
    return code == EXIT_DONE ? t->code : code;
}

static bool begin_totals(const command_context *c, const scene *s, totals *t, lux_error *err)
{
    int count         = s->study->grid_count;
    t->interval_valid = true;
    t->averages       = arena_array(c->a, double, (size_t)count, err);
    for (int i = 0; t->averages && i < count; i++) {
        t->averages[i] = (double)NAN;
        t->name_width  = print_width(s->study->grids[i].name, t->name_width);
    }
    return t->averages != NULL;
}

static int grid_command(const command_context *c, lux_error *err)
{
    if (!command_transport_fits(c, err))
        return EXIT_INPUT;
    totals t       = { 0 };
    const scene *s = command_planned_scene(c, false, &t.plan, err);
    if (!s)
        return exit_code_of(err, true);
    if (s->study->grid_count == 0) {
        failed(err, ERR_ARGUMENT, "%s: the study has no `grids`", s->study->path);
        return EXIT_INPUT;
    }
    if (!command_check_grids(s, &c->line->place, extensions, EXTENSIONS, err))
        return exit_code_of(err, true);

    schedule list;
    bool listed = c->line->schedule;
    if (!begin_totals(c, s, &t, err) || (listed && !schedule_make(c->a, s, &list, c->notices, err)))
        return exit_code_of(err, true);
    int code = run_all(c, s, &t, err);
    if (c->line->json)
        print_json_end(s, listed ? &list : NULL, &t);
    else if (t.printed && listed)
        schedule_print(stdout, s, &list, t.averages);
    if (!c->line->json && t.printed)
        printf("%.2f s, %.1f million rays\n", t.seconds, 1e-6 * (double)t.rays);
    return code;
}

const command command_grid = {
    .name    = "grid",
    .files   = "STUDY.yaml",
    .summary = "illuminance on the study's grids: a summary, and a .csv and .exr for each grid",
    .help = "Illuminance is maintained illuminance where the study has `maintenance`. A sensor is\n"
            "done when half of its 95 % confidence interval is at most the accuracy asked for,\n"
            "of its value or of a tenth of the grid's average, whichever is more.\n"
            "--schedule lists what is installed, initial and not dimmed, and its load: on the\n"
            "room's floor, or of a study without `room` on each grid that looks up.\n",
    .options = " -o --overwrite --accuracy --time --variant --threads --seed --direct-only "
               "--transport --save-maps --no --only --groups --schedule --json "
               "--quiet ",
    .run     = grid_command,
};
