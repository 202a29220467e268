/* sim/cmd_material.c -- lux4 material: what measured materials do with light, drawn and rendered.
 */
#include "sim/command.h"
#include "sim/material_report.h"

static int material_command(const command_context *c, lux_error *err)
{
    run_options run    = command_run_options(c, 1);
    material_options o = { .json      = c->line->json,
                           .plot      = c->line->plot,
                           .swatch    = c->line->swatch,
                           .overwrite = c->line->place.overwrite,
                           .run       = &run };
    bool good = material_report(stdout, c->line->files, c->line->file_count, &o, c->notices, err);
    terminal_clear(c->terminal);
    if (good && !o.json && o.plot)
        printf("written: %s\n", o.plot);
    if (good && !o.json && o.swatch)
        printf("written: %s\n", o.swatch);
    return good ? EXIT_DONE : exit_code_of(err, true);
}

const command command_material = {
    .name    = "material",
    .files   = "FILE...",
    .summary = "measured tables: albedo, energy, reciprocity, plot of the lobes, swatch",
    .help =
        "Files: tables of reflection (.brdf, MERL .binary) and BSDFs of glazing, blinds and\n"
        "fabrics (LBNL's .xml, whose front faces outside and whose back faces the room).\n"
        "Printed: what is reflected, of a BSDF also let through, of a beam that arrives so many\n"
        "degrees off the normal, and of diffuse light; the largest share of all, as measured;\n"
        "by what values are scaled so that no direction gives back more than arrives; how far\n"
        "ways there and back differ, |f(a,b) - f(b,a)|: the mean over the mean f, and the worst\n"
        "over the larger f of its pair. The rest is as simulated: completed and scaled.\n"
        "--plot draws, for beams 0, 30, 60 and 80 degrees off the normal, f cos in 1/sr in the\n"
        "plane of incidence (what of the beam leaves into a unit of solid angle; below the\n"
        "surface: let through), each lobe to its largest value, which the legend tells; and "
        "beside\n"
        "it the albedo against the angle.\n"
        "--swatch renders a ball of it, 1 m across, on a floor with squares of 25 cm, under a\n"
        "large lamp behind the left shoulder and a small bright one on the right: a preview, of\n"
        "less noise by --accuracy (here 100 % if not given).\n",
    .options = " --plot --swatch --overwrite --accuracy --time --threads --seed --json --quiet ",
    .run     = material_command,
};
