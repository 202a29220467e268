/* tests/program.c -- see program.h. */
#define _GNU_SOURCE
#include "tests/program.h"

#include "tests/folder.h"
#include "tests/test.h"

#include <dirent.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

enum { PATH_SIZE = 4096 };

/* ---- where things are ------------------------------------------------------------------------ */

/* Our own path, ROOT/build/KIND/tests/cli/test_x, without the last `names` names. */
static const char *above_us(char *path, int names)
{
    ssize_t n = readlink("/proc/self/exe", path, PATH_SIZE - 1);
    assert_true(n > 0);
    path[n] = '\0';
    for (; names > 0; names--)
        *strrchr(path, '/') = '\0';
    return path;
}

const char *build_folder(void)
{
    static char path[PATH_SIZE];
    return above_us(path, 3);
}

const char *project_root(void)
{
    static char path[PATH_SIZE];
    return above_us(path, 5);
}

const char *path_in(const char *folder, const char *name)
{
    static char paths[8][PATH_SIZE];
    static int next;
    char *path = paths[next++ % 8];
    assert_true(snprintf(path, PATH_SIZE, "%s/%s", folder, name) < PATH_SIZE);
    return path;
}

/* ---- a run ----------------------------------------------------------------------------------- */

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void pause_a_little(void) { nanosleep(&(struct timespec){ .tv_nsec = 1000000 }, NULL); }

/* What the child does between fork() and the program. */
static void become(const program_desc *d, int out, int err)
{
    static char *words[MOST_WORDS + 1];
    const char *program = d->program ? d->program : path_in(build_folder(), "lux4");
    words[0]            = strdup(program);
    for (int i = 0; d->words[i]; i++)
        words[i + 1] = strdup(d->words[i]);
    if (d->out && d->out[0])
        out = open(d->out, O_WRONLY);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    if (d->out && !d->out[0])
        close(STDOUT_FILENO);
    struct rlimit most = { (rlim_t)d->most_file_bytes, (rlim_t)d->most_file_bytes };
    struct rlimit none = { 0, 0 };
    setrlimit(RLIMIT_CORE, &none);
    if ((d->folder && chdir(d->folder)) || (d->most_file_bytes && setrlimit(RLIMIT_FSIZE, &most)) ||
        (d->user && (setgid((gid_t)d->user) || setuid((uid_t)d->user))))
        _exit(126);
    execv(program, words);
    _exit(127);
}

/* Waits for its end, interrupting it on the way if that is asked for; its status. */
static int wait_for(const program_desc *d, pid_t child)
{
    double most = strstr(build_folder(), "san-") ? 150.0 : 30.0, begun = now_s(), seen = 0.0;
    int status, interrupts = d->until ? d->twice ? 2 : 1 : 0;
    while (waitpid(child, &status, WNOHANG) == 0) {
        if (now_s() - begun > most) {
            kill(child, SIGKILL);
            waitpid(child, &status, 0);
            fail_msg("%s %s: still runs after %.0f s", d->words[0], d->words[1], most);
        }
        if (interrupts && seen == 0.0 && access(d->until, F_OK) == 0)
            seen = now_s();
        if (interrupts && seen > 0.0 && now_s() - seen >= d->then_s) {
            kill(child, SIGINT);
            interrupts--;
        }
        pause_a_little();
    }
    return status;
}

static char *text_of_fd(int fd)
{
    off_t size = lseek(fd, 0, SEEK_END);
    char *text = calloc(1, (size_t)size + 1);
    assert_non_null(text);
    assert_int_equal(pread(fd, text, (size_t)size, 0), size);
    close(fd);
    return text;
}

void program_free(program_result *r)
{
    free(r->out);
    free(r->err);
    *r = (program_result){ 0 };
}

void program_run(const program_desc *d, program_result *r)
{
    program_free(r);
    int out = memfd_create("out", MFD_CLOEXEC), err = memfd_create("err", MFD_CLOEXEC);
    assert_true(out >= 0 && err >= 0);
    double begun = now_s();
    pid_t child  = fork();
    assert_true(child >= 0);
    if (child == 0)
        become(d, out, err);
    int status = wait_for(d, child);
    r->seconds = now_s() - begun;
    r->code    = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
    r->out     = text_of_fd(out);
    r->err     = text_of_fd(err);
    if (strstr(r->err, "Sanitizer") || strstr(r->err, "runtime error:"))
        fail_msg("%s", r->err);
}

void program_expect(int code, const program_desc *d, program_result *r)
{
    program_run(d, r);
    if (r->code != code)
        fail_msg("lux4 %s %s exits with %d, not %d: %s%s", d->words[0] ? d->words[0] : "",
                 d->words[0] && d->words[1] ? d->words[1] : "", r->code, code, r->err, r->out);
}

void assert_one_line(const program_result *r, const char *says)
{
    const char *line = r->err, *end = strchr(line, '\n');
    while (end && !strncmp(line, "lux4: warning: ", 15)) {
        line = end + 1;
        end  = strchr(line, '\n');
    }
    if (strncmp(line, "lux4: ", 6) != 0 || !end || end[1] || !strstr(line, says))
        fail_msg("stderr is no line \"lux4: ... %s ...\", but: %s", says, r->err);
}

void program_fails(int code, const char *says, const program_desc *d)
{
    program_result r = { 0 };
    program_expect(code, d, &r);
    assert_one_line(&r, says);
    assert_string_equal(r.out, "");
    program_free(&r);
}

/* ---- files ----------------------------------------------------------------------------------- */

char *folder_of_study(const char *yaml)
{
    char *folder = folder_new();
    folder_write(folder, "study.yaml", yaml);
    return folder;
}

bool there_is(const char *folder, const char *name)
{
    return access(path_in(folder, name), F_OK) == 0;
}

int count_names(const char *folder)
{
    DIR *d = opendir(folder);
    if (!d)
        return 0;
    int count = -2; /* . and .. */
    while (readdir(d))
        count++;
    closedir(d);
    return count;
}

char *bytes_of(const char *path, size_t *size)
{
    int fd = open(path, O_RDONLY);
    if (fd < 0)
        fail_msg("%s: cannot be read", path);
    *size = (size_t)lseek(fd, 0, SEEK_END);
    return text_of_fd(fd);
}

bool same_bytes(const char *path, const char *other)
{
    size_t size, other_size;
    char *bytes = bytes_of(path, &size), *others = bytes_of(other, &other_size);
    bool same = size == other_size && !memcmp(bytes, others, size);
    free(bytes);
    free(others);
    return same;
}

void assert_same_bytes(const char *path, const char *other)
{
    if (!same_bytes(path, other))
        fail_msg("%s and %s differ", path, other);
}

static void read_row(const char *path, const char *line, double row[CSV_COLUMNS])
{
    for (int i = 0; i < CSV_COLUMNS; i++) {
        char *end;
        row[i] = strtod(line, &end);
        if (end == line || *end != (i < CSV_COLUMNS - 1 ? ',' : '\n') || !isfinite(row[i]) ||
            (i >= ALL && row[i] < 0.0))
            fail_msg("%s: column %d of: %.120s", path, i + 1, line);
        line = end + 1;
    }
    assert_near(row[NX] * row[NX] + row[NY] * row[NY] + row[NZ] * row[NZ], 1.0, 1e-6);
    assert_near(row[DIRECT] + row[INDIRECT], row[ALL], 1e-7);
}

void csv_read(const char *path, csv *out)
{
    static const char header[] =
        "x,y,z,nx,ny,nz,illuminance_lx,direct_lx,indirect_lx,half_width_lx\n";
    size_t size;
    char *text       = bytes_of(path, &size);
    const char *line = text + strlen(header);
    out->count       = 0;
    out->partial     = false;
    if (strlen(text) != size || strncmp(text, header, strlen(header)) != 0)
        fail_msg("%s: begins with %.80s", path, text);
    for (; *line; line = strchr(line, '\n') + 1) {
        assert_non_null(strchr(line, '\n'));
        if (*line == '#')
            out->partial = true;
        else
            read_row(path, line, out->row[out->count++]);
    }
    free(text);
}
