/* sim/cmd_photometry.c -- lux4 photometry: what .ies and .ldt files say, drawn and converted. */
#include "sim/command.h"
#include "sim/photometry_report.h"

static int photometry_command(const command_context *c, lux_error *err)
{
    if (c->line->file_count == 0) {
        failed(err, ERR_ARGUMENT, "which files? (.ies, .ldt)");
        return EXIT_INPUT;
    }
    photometry_options o = { .json      = c->line->json,
                             .plot      = c->line->plot,
                             .write     = c->line->write,
                             .overwrite = c->line->place.overwrite };
    bool good = photometry_report(stdout, c->line->files, c->line->file_count, &o, c->notices, err);
    if (good && !o.json && o.plot)
        printf("written: %s\n", o.plot);
    if (good && !o.json && o.write)
        printf("written: %s\n", o.write);
    return good ? EXIT_DONE : exit_code_of(err, true);
}

const command command_photometry = {
    .name    = "photometry",
    .files   = "FILE...",
    .summary = "what .ies and .ldt files hold: figures, warnings, polar diagram, conversion",
    .help =
        "Beam and field angle are full angles, to half and a tenth of the largest intensity of\n"
        "each plane. The flux code is that of CIE 52. All are those of the luminaire as measured.\n"
        "--plot draws C0-C180 as a full line, C90-C270 as a broken one, in cd/klm where the "
        "lamps'\n"
        "lumens are known, else in cd.\n"
        "--write converts to LM-63-2002 (.ies) or EULUMDAT (.ldt). Light and opening keep their\n"
        "place in the room: as lengths lie along C0 in the one and along C90 in the other, length\n"
        "and width are exchanged. What a format has no word for is said.\n"
        "A file named by TILT= is read if it lies in the same folder.\n",
    .options = " --plot --write --overwrite --json --quiet ",
    .run     = photometry_command,
};
