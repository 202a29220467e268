/* sim/main.c -- the program: finds the command, runs it, and is alone in printing its errors. */
#include "sim/accuracy.h"
#include "sim/command.h"
#include "sim/help_study.h"

#include <errno.h>
#include <signal.h>
#include <string.h>

/* A new command is one file and one line here. */
static const command *const commands[] = {
    &command_grid, &command_render, &command_daylight,   &command_check,
    &command_sun,  &command_sky,    &command_photometry, &command_material,
    &command_mix,  &command_plan,   &command_cost
};
enum { COMMANDS = sizeof commands / sizeof *commands };

/* Commands of the contract that are not built yet. */
static const char *const to_come[] = { "tone", "diff" };

static volatile bool stop; /* the one thing a signal handler may touch */

static void on_interrupt(int signal_number)
{
    stop = true;
    signal(signal_number, SIG_DFL); /* the second Ctrl-C is obeyed at once */
}

static const command *find_command(const char *name)
{
    for (int i = 0; i < COMMANDS; i++)
        if (!strcmp(commands[i]->name, name))
            return commands[i];
    return NULL;
}

static void print_usage(FILE *to)
{
    fputs("lux4 " LUX4_VERSION ": how much light arrives where, how accurate that is, and what it "
          "looks like\n\nusage: lux4 COMMAND FILE [options]\n\n",
          to);
    for (int i = 0; i < COMMANDS; i++)
        fprintf(to, "  %-12s %s\n", commands[i]->name, commands[i]->summary);
    fputs("\nlux4 help COMMAND, or lux4 COMMAND --help, tells more; lux4 help study: what a study\n"
          "may hold. lux4 --version\n",
          to);
}

static void print_help(const command *c)
{
    printf("usage: lux4 %s %s [options]\n\n%s\n\n", c->name, c->files, c->summary);
    if (c->help[0])
        printf("%s\n", c->help);
    puts("options:");
    command_options_print(stdout, c);
    puts("\nexit codes: 0 done; 1 failed on the way (disk full, no memory); 2 bad usage or input;\n"
         "3 accuracy not reached in the time given; 130 interrupted");
}

static int unknown_command(const char *name)
{
    for (size_t i = 0; i < sizeof to_come / sizeof *to_come; i++)
        if (!strcmp(to_come[i], name)) {
            fprintf(stderr, "lux4: `%s` is not supported yet\n", name);
            return EXIT_INPUT;
        }
    fprintf(stderr, "lux4: unknown command `%s` (lux4 help lists them)\n", name);
    return EXIT_INPUT;
}

static int help(int count, char **words)
{
    if (count == 0) {
        print_usage(stdout);
        return EXIT_DONE;
    }
    if (!strcmp(words[0], "study")) {
        help_study(stdout);
        return EXIT_DONE;
    }
    const command *c = find_command(words[0]);
    if (!c)
        return unknown_command(words[0]);
    print_help(c);
    return EXIT_DONE;
}

static void print_notices(const notices *n)
{
    for (const notice *line = n->first; line; line = line->next)
        fprintf(stderr, "lux4: warning: %s\n", line->text);
}

static int run(const command *c, int count, char **words)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    notices said  = { .a = &a };
    command_line l;
    int code = EXIT_INPUT;
    if (command_line_read(&a, c, count, words, &l, &err)) {
        terminal t              = terminal_open(l.quiet);
        progress p              = terminal_progress(&t, &stop);
        command_context context = { .line     = &l,
                                    .a        = &a,
                                    .notices  = &said,
                                    .terminal = &t,
                                    .progress = &p,
                                    .stop     = &stop,
                                    .begun    = clock_seconds() };
        code                    = c->run(&context, &err);
        terminal_clear(&t);
        fflush(stdout);
        if (!l.quiet)
            print_notices(&said);
    }
    if (err.text[0])
        fprintf(stderr, "lux4: %s\n", err.text);
    arena_clear(&a);
    return code;
}

/* What could not be printed is lost: that is an error as much as a lost file. */
static int close_output(int code)
{
    if (fflush(stdout) == 0 && !ferror(stdout))
        return code;
    fprintf(stderr, "lux4: cannot write the results: %s\n", strerror(errno));
    return EXIT_RUNTIME;
}

static bool wants_help(int count, char **words)
{
    for (int i = 0; i < count && strcmp(words[i], "--") != 0; i++)
        if (!strcmp(words[i], "--help") || !strcmp(words[i], "-h"))
            return true;
    return false;
}

int main(int argc, char **argv)
{
    signal(SIGINT, on_interrupt);
    signal(SIGTERM, on_interrupt);
    signal(SIGXFSZ, SIG_IGN); /* a write beyond the limit fails, instead of ending us */
    const char *name = argc > 1 ? argv[1] : "";
    if (!name[0]) {
        print_usage(stderr);
        return EXIT_INPUT;
    }
    if (!strcmp(name, "--version") || !strcmp(name, "version")) {
        puts("lux4 " LUX4_VERSION);
        return close_output(EXIT_DONE);
    }
    if (!strcmp(name, "help") || !strcmp(name, "--help") || !strcmp(name, "-h"))
        return close_output(help(argc - 2, argv + 2));
    const command *c = find_command(name);
    if (!c)
        return unknown_command(name);
    if (wants_help(argc - 2, argv + 2))
        return close_output(help(1, argv + 1));
    return close_output(run(c, argc - 2, argv + 2));
}
