/* sim/cmd_cost.c -- lux4 cost: what accuracy costs in time on a study. */
#include "sim/command.h"
#include "sim/cost_write.h"

#include <math.h>

static const double usual_seconds = 600.0; /* where there is no --time */

static const char *const extensions[] = { ".csv", ".svg" };
enum { EXTENSIONS = 2 };

/* Results of the same study in its own folder make room for new ones. */
static bool check_output(const command_context *c, const study *s, lux_error *err)
{
    output_place o  = c->line->place;
    const char *csv = output_path(c->a, s, &o, "cost", ".csv", err);
    if (!csv)
        return false;
    o.overwrite |= !o.folder && cost_csv_is_of(csv, s);
    return output_check(s, &o, "cost", extensions, EXTENSIONS, err);
}

static bool write_files(const command_context *c, const study *s, const cost_result *r,
                        lux_error *err)
{
    const output_place *o = &c->line->place;
    const char *csv       = output_path(c->a, s, o, "cost", ".csv", err);
    const char *svg       = csv ? output_path(c->a, s, o, "cost", ".svg", err) : NULL;
    if (!svg || !cost_write_csv(csv, s, r, err) || !cost_plot(svg, s, r, err))
        return false;
    if (!c->line->json)
        printf("written: %s, %s\n", csv, svg);
    return true;
}

/* Met by any of the settings. */
static bool is_met(const cost_result *r)
{
    bool met = false;
    for (int i = 0; i < r->row_count; i++)
        met |= r->rows[i].reaches;
    return met;
}

static int cost_command(const command_context *c, lux_error *err)
{
    const command_line *l = c->line;
    const study *s        = command_study(c, err);
    if (!s || !check_output(c, s, err))
        return exit_code_of(err, true);
    cost_options o = { .run  = command_run_options(c, 1),
                       .plan = { .no        = l->off,
                                 .only      = l->only,
                                 .has_only  = l->has_only,
                                 .transport = l->transport } };
    if (isnan(l->seconds))
        o.run.deadline = c->begun + usual_seconds;
    cost_result r;
    if (!cost_run(c->a, s, &o, &r, c->notices, err))
        return exit_code_of(err, true);
    terminal_clear(c->terminal);
    if (l->json)
        cost_print_json(stdout, &r);
    else
        cost_print(stdout, &r);
    if (!write_files(c, s, &r, err))
        return exit_code_of(err, false);
    if (r.end != RUN_INTERRUPTED) /* that some settings ran less often is no failure */
        r.end = is_met(&r) ? RUN_DONE : RUN_LATE;
    return command_end(r.end, r.view ? "view" : "grid", r.what, err);
}

const command command_cost = {
    .name    = "cost",
    .files   = "STUDY.yaml",
    .summary = "what accuracy costs in time on this study: a table, a .csv and a .svg",
    .help =
        "Runs the study's first grid (or, of a study with views alone, its first view at a\n"
        "reduced size) by many settings, each three times in turns with different seeds,\n"
        "against a reference three times as accurate as the finest of them. RMS and worst:\n"
        "relative error, of a sensor's value or of a tenth of the average, whichever is more;\n"
        "`s for 1%`: the time to 1 % RMS, `never` where more samples do not help; `meets`: 95 %\n"
        "of the sensors have the study's accuracy. The whole takes --time, or ten minutes: the\n"
        "costliest settings are left out until it fits.\n",
    .options = " -o --overwrite --accuracy --time --variant --threads --seed --direct-only "
               "--json --quiet ",
    .run     = cost_command,
};
