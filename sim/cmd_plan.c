/* sim/cmd_plan.c -- lux4 plan: which effects of light a study calls for, which not, and why. */
#include "sim/command.h"
#include "sim/daylight.h"

/* A study with views alone is planned for these. */
static int plan_command(const command_context *c, lux_error *err)
{
    const study *s  = command_study(c, err);
    scene_options o = { .threads = command_threads(c), .layered = c->line->groups };
    plan p;
    if (!s)
        return exit_code_of(err, true);
    bool views         = s->grid_count == 0 && s->view_count > 0;
    plan_options asked = command_plan_options(c, views);
    arena of_moments   = { 0 };
    bool series        = s->when.given && s->when.series;
    asked.series       = series;
    o.moments =
        series ? moments_of(&of_moments, s, &s->when, &o.moment_count, c->notices, err) : NULL;
    if (o.moment_count > MOST_MOMENTS_A_BATCH)
        o.moment_count = MOST_MOMENTS_A_BATCH; /* one scene holds no more; the others are alike */
    const scene *all = series && !o.moments ? NULL : scene_new(c->a, s, &o, c->notices, err);
    bool good        = all && plan_make(all, &asked, &p, c->notices, err);
    int code         = good ? EXIT_DONE : exit_code_of(err, true);
    terminal_clear(c->terminal);
    if (good && c->line->json)
        plan_print_json(&p);
    else if (good)
        plan_print(&p);
    plan of_views;
    asked.views = true;
    if (good && !c->line->json && !views && s->view_count > 0 &&
        plan_make(all, &asked, &of_views, NULL, err))
        plan_print_views(&of_views);
    arena_clear(&of_moments);
    return code;
}

const command command_plan = {
    .name    = "plan",
    .files   = "STUDY.yaml",
    .summary = "which effects of light the study calls for, which are off, why, and at what cost",
    .help =
        "For its grids, or its views if it has no grids. An effect is off where it is provably\n"
        "without effect, or where a bound on what it adds is small: all bounds together stay\n"
        "below a fifth of the accuracy asked for, and are added to half widths. --no and\n"
        "--only, here as for grid, render and daylight, have the last word. Simulates no more\n"
        "than direct light in rooms that are all but black, and a few samples by paths and by\n"
        "maps, which tell by the rays that they take which is there sooner.\n",
    .options = " --accuracy --variant --threads --direct-only --groups --transport --no --only "
               "--json --quiet ",
    .run     = plan_command,
};
