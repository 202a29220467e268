/* sim/command_line.c -- the words of a command line, by one table of options. */
#include "core/text.h"
#include "sim/command.h"

#include <stdlib.h>
#include <string.h>

typedef struct option {
    const char *name, *value; /* value: NULL if it takes none */
    const char *help;         /* NULL: of the contract, and not built yet */
    bool own;                 /* of some commands; all others are taken by every command, so that
                                 scripts may pass them, though help names them only where they count */
    const char *only;         /* of this command, for which it stands in for that of all; NULL */
} option;

/* Every option that users are promised. Those that are not built yet are refused by name. */
static const option options[] = {
    { "--place", "PLACE", "where: degrees, degrees minutes seconds, UTM, MGRS", true },
    { "--time", "TIME", "when, in ISO 8601; with --day a date, with --year a year", true, "sun" },
    { "--zone", "ZONE", "whose clocks: an IANA name (Europe/Moscow), or +03:00", true },
    { "--altitude", "M", "metres above the sea (default 0)", true },
    { "--pressure", "HPA", "of the air, which bends the light (default: standard)", true },
    { "--temperature", "C", "of the air (default: standard)", true },
    { "--turbidity", "T", "Linke's, of the clear sky (default 3)", true },
    { "--day", NULL, "a table of the hours of that day", true },
    { "--year", NULL, "a table of the days of that year", true },
    { "-o", "DIR", "put the results there (default: out/ beside the study)" },
    { "--overwrite", NULL, "replace results that are there already" },
    { "--accuracy", "P%", "how near to the truth (grids: the study's, or else 2%; views: 10%)" },
    { "--time", "SECONDS", "stop after that time with what there is (exit code 3 if too early)" },
    { "--variant", "NAME", "the study with this one of its `variants` merged over it" },
    { "--threads", "N", "run on N threads (default: all processors)" },
    { "--seed", "N", "another number, another set of random samples (default 1)" },
    { "--direct-only", NULL, "leave interreflection out" },
    { "--save-maps", "FILE", "keep the maps of --transport maps there, or go by those it has",
      true },
    { "--transport", "T", "interreflection by path, maps or auto (default: as lux4 plan says)" },
    { "--no", "EFFECT,..", "leave effects out that lux4 plan lists (may stand several times)" },
    { "--only", "EFFECT,..", "simulate these alone; all: leave out nothing, needed or not" },
    { "--groups", NULL, "also a layer of each group of lamps, undimmed, for lux4 mix", true },
    { "--schedule", NULL, "also the luminaires: counts, watts, lm/W, W/m2", true },
    { "--date", "D[..D]", "this date, or all from one to another, in place of the study's `when`",
      true },
    { "--from", "H", "first time of the day, for instance 08:00", true },
    { "--to", "H", "last time of the day", true },
    { "--step", "MIN", "minutes from one time to the next (default: the study's, or else 60)",
      true },
    { "--factor", NULL, "the daylight factor in place of a series", true },
    { "--width", "PIXELS", "across the panorama (default 2048); it is half as high", true },
    { "--half", NULL, "write 16-bit floats" },
    { "--exposure", "EV", "brighter or darker preview, in stops" },
    { "--plot", "FILE.svg", "draw it, as said above", true },
    { "--swatch", "FILE.png", "render a ball of it", true },
    { "--write", "FILE", "convert to .ies or .ldt", true },
    { "--json", NULL, "results as one JSON object on stdout" },
    { "--quiet", NULL, "no progress bar, no warnings" },
    { "--resume", NULL, NULL },
    { "--tone", "", NULL },
    { "--false-color", "", NULL },
};
enum { OPTIONS = sizeof options / sizeof *options };

static bool counts_for(const command *c, const char *name)
{
    char between[40];
    snprintf(between, sizeof between, " %s ", name);
    return strstr(c->options, between) != NULL;
}

static bool is_for(const option *o, const command *c)
{
    return !o->only || !strcmp(o->only, c->name);
}

/* The first that is for the command. */
static const option *find(const command *c, const char *word, size_t length)
{
    for (int i = 0; i < OPTIONS; i++)
        if (is_for(&options[i], c) && strlen(options[i].name) == length &&
            !strncmp(options[i].name, word, length))
            return &options[i];
    return NULL;
}

void command_options_print(FILE *to, const command *c)
{
    for (int i = 0; i < OPTIONS; i++) {
        const option *o = &options[i];
        if (!o->help || !counts_for(c, o->name) || find(c, o->name, strlen(o->name)) != o)
            continue;
        char both[40];
        bool other = c->output && !strcmp(o->name, "-o");
        snprintf(both, sizeof both, "%s %s", o->name, other ? c->output : o->value ? o->value : "");
        fprintf(to, "  %-20s %s\n", both, other ? c->output_help : o->help);
    }
}

/* ---- values ---------------------------------------------------------------------------------- */

static bool number(const char *option_name, const char *text, double low, double high,
                   const char *wanted, double *out, lux_error *err)
{
    const char *end;
    if (!text_number(text, &end, out) || *end || !(*out >= low && *out <= high))
        return failed(err, ERR_ARGUMENT, "%s %s: expected %s", option_name, text, wanted);
    return true;
}

static bool whole(const char *option_name, const char *text, double low, double high,
                  const char *wanted, double *out, lux_error *err)
{
    if (!number(option_name, text, low, high, wanted, out, err))
        return false;
    if (*out != floor(*out))
        return failed(err, ERR_ARGUMENT, "%s %s: expected %s", option_name, text, wanted);
    return true;
}

static bool percent(const char *text, double *out, lux_error *err)
{
    static const double least = 1e-9; /* the same as a study's */
    const char *end;
    bool good = text_number(text, &end, out);
    while (good && *end == ' ')
        end++;
    if (!good || strcmp(end, "%") != 0 || !(*out >= least && *out <= 100.0))
        return failed(err, ERR_ARGUMENT, "--accuracy %s: expected a percentage, for instance 2%%",
                      text);
    *out /= 100.0;
    return true;
}

/* "sun,sky" as bits 1 << effect, added to *bits; `all` where that has a meaning. */
static bool effect_list(const char *option_name, const char *text, bool all_too, uint32_t *bits,
                        lux_error *err)
{
    for (const char *at = text;; at++) {
        size_t length = strcspn(at, ",");
        effect e      = effect_find(at, length);
        bool all      = all_too && length == 3 && !strncmp(at, "all", 3);
        if (e == EFFECTS && !all)
            return failed(err, ERR_ARGUMENT, "%s %s: `%.*s` is no effect (lux4 plan lists them)",
                          option_name, text, (int)(length < 40 ? length : 40), at);
        *bits |= all ? (1u << EFFECTS) - 1 : 1u << e;
        at += length;
        if (!*at)
            return true;
    }
}

static bool transport_named(const char *text, transport *out, lux_error *err)
{
    static const char *const names[] = {
        [TRANSPORT_AUTO] = "auto", [TRANSPORT_PATH] = "path", [TRANSPORT_MAPS] = "maps"
    };
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        if (!strcmp(text, names[i])) {
            *out = (transport)i;
            return true;
        }
    return failed(err, ERR_ARGUMENT, "--transport %s: expected path, maps or auto", text);
}

/* Of lux4 sun; *mine: the option is one of these. */
static bool take_sun(sun_line *s, const option *o, const char *value, bool *mine, lux_error *err)
{
    *mine = true;
    if (!strcmp(o->name, "--place"))
        s->place = value;
    else if (!strcmp(o->name, "--zone"))
        s->zone = value;
    else if (!strcmp(o->name, "--time") && o->only)
        s->time = value;
    else if (!strcmp(o->name, "--day"))
        s->day = true;
    else if (!strcmp(o->name, "--year"))
        s->year = true;
    else if (!strcmp(o->name, "--altitude"))
        return number(o->name, value, -500.0, 9000.0, "metres from -500 to 9000", &s->altitude_m,
                      err);
    else if (!strcmp(o->name, "--pressure"))
        return number(o->name, value, 0.0, 1200.0, "hPa from 0 to 1200", &s->pressure_hpa, err);
    else if (!strcmp(o->name, "--temperature"))
        return number(o->name, value, -100.0, 70.0, "degrees Celsius from -100 to 70",
                      &s->temperature_c, err);
    else if (!strcmp(o->name, "--turbidity"))
        return number(o->name, value, 1.0, 20.0, "Linke's turbidity, from 1 to 20", &s->turbidity,
                      err);
    else
        *mine = false;
    return true;
}

static bool take(command_line *l, const char *name, const char *value, lux_error *err)
{
    double n;
    if (!strcmp(name, "-o")) {
        if (!value[0])
            return failed(err, ERR_ARGUMENT, "-o: expected a folder");
        l->place.folder = value;
    } else if (!strcmp(name, "--accuracy")) {
        return percent(value, &l->accuracy, err);
    } else if (!strcmp(name, "--time")) {
        return number(name, value, 0.0, 1e9, "seconds, 0 or more", &l->seconds, err);
    } else if (!strcmp(name, "--exposure")) {
        return !strcmp(value, "auto") ||
               number(name, value, -30.0, 30.0, "stops from -30 to 30, or auto", &l->exposure_ev,
                      err);
    } else if (!strcmp(name, "--threads")) {
        if (!whole(name, value, 1.0, 256.0, "a whole number from 1 to 256", &n, err))
            return false;
        l->threads = (int)n;
    } else if (!strcmp(name, "--seed")) {
        if (!whole(name, value, 1.0, 4294967295.0, "a whole number from 1 to 4294967295", &n, err))
            return false;
        l->seed = (uint32_t)n;
    } else if (!strcmp(name, "--plot")) {
        l->plot = value;
    } else if (!strcmp(name, "--swatch")) {
        l->swatch = value;
    } else if (!strcmp(name, "--write")) {
        l->write = value;
    } else if (!strcmp(name, "--variant")) {
        l->variant = value;
    } else if (!strcmp(name, "--date")) {
        l->date = value;
    } else if (!strcmp(name, "--from")) {
        l->from = value;
    } else if (!strcmp(name, "--to")) {
        l->to = value;
    } else if (!strcmp(name, "--step")) {
        return number(name, value, 1.0 / 60.0, 1440.0, "minutes, a second to a day", &l->step_min,
                      err);
    } else if (!strcmp(name, "--factor")) {
        l->factor = true;
    } else if (!strcmp(name, "--overwrite")) {
        l->place.overwrite = true;
    } else if (!strcmp(name, "--direct-only")) {
        l->direct_only = true;
    } else if (!strcmp(name, "--save-maps")) {
        if (!value[0])
            return failed(err, ERR_ARGUMENT, "--save-maps: expected a file");
        l->maps   = value;
        l->groups = true; /* so that it serves for other dimmings */
    } else if (!strcmp(name, "--transport")) {
        return transport_named(value, &l->transport, err);
    } else if (!strcmp(name, "--no")) {
        return effect_list(name, value, false, &l->off, err);
    } else if (!strcmp(name, "--only")) {
        l->has_only = true;
        return effect_list(name, value, true, &l->only, err);
    } else if (!strcmp(name, "--groups")) {
        l->groups = true;
    } else if (!strcmp(name, "--schedule")) {
        l->schedule = true;
    } else if (!strcmp(name, "--width")) {
        const char *wanted = "an even number of pixels from 64 to 16384";
        if (!whole(name, value, 64.0, 16384.0, wanted, &n, err))
            return false;
        l->width = (int)n;
        return l->width % 2 == 0 ||
               failed(err, ERR_ARGUMENT, "%s %s: expected %s", name, value, wanted);
    } else if (!strcmp(name, "--half")) {
        l->half = true;
    } else if (!strcmp(name, "--json")) {
        l->json = true;
    } else if (!strcmp(name, "--quiet")) {
        l->quiet = true;
    }
    return true;
}

/* ---- words ----------------------------------------------------------------------------------- */

/* An option, with its value behind = or as the next word; *at moves on to the last word used. */
static bool read_option(const command *c, int count, char *const *words, int *at, command_line *out,
                        lux_error *err)
{
    const char *word   = words[*at];
    const char *equals = word[1] == '-' ? strchr(word, '=') : NULL;
    const option *o    = find(c, word, equals ? (size_t)(equals - word) : strlen(word));
    if (!o)
        return failed(err, ERR_ARGUMENT, "unknown option %s (lux4 help %s lists them)", word,
                      c->name);
    if (!o->help)
        return failed(err, ERR_UNSUPPORTED, "%s is not supported yet", o->name);
    if (o->own && !counts_for(c, o->name))
        return failed(err, ERR_ARGUMENT, "%s has no meaning for lux4 %s", o->name, c->name);
    const char *value = "", *wanted = o->value;
    if (c->output && !strcmp(o->name, "-o"))
        wanted = c->output;
    if (o->value && equals)
        value = equals + 1;
    else if (o->value && *at + 1 < count)
        value = words[++*at];
    else if (o->value)
        return failed(err, ERR_ARGUMENT, "%s: expected %s behind it", o->name, wanted);
    else if (equals)
        return failed(err, ERR_ARGUMENT, "%s takes no value", o->name);
    if (wanted && wanted == c->output && !value[0])
        return failed(err, ERR_ARGUMENT, "%s: expected %s behind it", o->name, wanted);
    bool mine;
    return take_sun(&out->sun, o, value, &mine, err) && (mine || take(out, o->name, value, err));
}

bool command_line_read(arena *a, const command *c, int count, char *const *words, command_line *out,
                       lux_error *err)
{
    const double unsaid = (double)NAN;
    *out                = (command_line){ .seed     = 1,
                                          .accuracy = unsaid,
                                          .seconds  = unsaid,
                                          .step_min = unsaid,
                                          .sun      = { .altitude_m    = unsaid,
                                                        .pressure_hpa  = unsaid,
                                                        .temperature_c = unsaid,
                                                        .turbidity     = unsaid } };
    const char **files  = arena_array(a, const char *, (size_t)count + 1, err);
    if (!files)
        return false;
    bool only_files = false;
    for (int i = 0; i < count; i++) {
        if (!only_files && !strcmp(words[i], "--"))
            only_files = true;
        else if (only_files || words[i][0] != '-' || !words[i][1])
            files[out->file_count++] = words[i];
        else if (!read_option(c, count, words, &i, out, err))
            return false;
    }
    out->files = files;
    return true;
}
