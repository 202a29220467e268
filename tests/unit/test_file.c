/* tests/unit/test_file.c -- files are read whole or refused, written whole or not at all. */
#include "core/file.h"
#include "tests/test.h"

#include <dirent.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

static char folder[64]; /* of this test alone */

static const char *in_folder(const char *name)
{
    static char path[4][512];
    static int turn;
    turn = (turn + 1) % 4;
    snprintf(path[turn], sizeof path[turn], "%s/%s", folder, name);
    return path[turn];
}

static int make_folder(void **state)
{
    (void)state;
    strcpy(folder, "/tmp/lux4_file_XXXXXX");
    return mkdtemp(folder) ? 0 : -1;
}

static int names_in_folder(bool remove_them)
{
    DIR *d    = opendir(folder);
    int count = 0;
    for (struct dirent *e; (e = readdir(d));) {
        if (strcmp(e->d_name, ".") == 0 || strcmp(e->d_name, "..") == 0)
            continue;
        count++;
        if (remove_them)
            remove(in_folder(e->d_name));
    }
    closedir(d);
    return count;
}

static int remove_folder(void **state)
{
    (void)state;
    names_in_folder(true);
    return rmdir(folder);
}

static void put(const char *path, const char *text)
{
    FILE *f = fopen(path, "wb");
    fputs(text, f);
    fclose(f);
}

static void assert_read_fails(const char *path, size_t most, const char *why)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    size_t size;
    assert_null(file_read(&a, path, most, &size, &err));
    assert_int_equal(err.code, ERR_IO);
    char want[600];
    snprintf(want, sizeof want, "%s: %s", path, why);
    assert_string_equal(err.text, want);
    arena_clear(&a);
}

TEST(a_file_is_read_whole_with_a_nul_behind_it)
{
    arena a     = { 0 };
    size_t size = 0;
    put(in_folder("a"), "light\n");
    const char *bytes = file_read(&a, in_folder("a"), 6, &size, NULL);
    assert_non_null(bytes);
    assert_int_equal(size, 6);
    assert_string_equal(bytes, "light\n");
    put(in_folder("empty"), "");
    assert_string_equal(file_read(&a, in_folder("empty"), 6, &size, NULL), "");
    assert_int_equal(size, 0);
    arena_clear(&a);
}

TEST(what_cannot_be_read_is_refused_by_name)
{
    put(in_folder("a"), "1234567");
    assert_read_fails(in_folder("a"), 6, "has 7 bytes, at most 6 were expected");
    assert_read_fails(in_folder("none"), 6, "no such file");
    assert_read_fails(in_folder("a/b"), 6, "no such file");
    assert_read_fails("", 6, "no such file");
    assert_read_fails(folder, 6, "is a folder, a file was expected");
}

TEST(devices_and_pipes_are_refused_without_waiting)
{
    assert_int_equal(mkfifo(in_folder("pipe"), 0600), 0);
    assert_read_fails(in_folder("pipe"), 6, "is not a regular file");
    assert_read_fails("/dev/zero", 6, "is not a regular file");
}

TEST(a_file_larger_than_its_size_says_is_refused)
{
    if (access("/proc/self/maps", R_OK))
        skip();
    assert_read_fails("/proc/self/maps", 1 << 20, "changes while it is read");
}

TEST(no_memory_for_a_file_is_an_error)
{
    arena a       = { 0 };
    lux_error err = { 0 };
    size_t size;
    put(in_folder("a"), "1234567");
    memory_is_out = true;
    char *bytes   = file_read(&a, in_folder("a"), 7, &size, &err);
    memory_is_out = false;
    assert_null(bytes);
    assert_int_equal(err.code, ERR_MEMORY);
}

TEST(an_output_appears_when_it_is_committed)
{
    arena a = { 0 };
    output_file f;
    size_t size;
    put(in_folder("a"), "old");
    assert_true(file_create(&f, in_folder("a"), NULL));
    fputs("new one", f.stream);
    fflush(f.stream);
    assert_string_equal(file_read(&a, in_folder("a"), 99, &size, NULL), "old");
    assert_int_equal(names_in_folder(false), 2);
    assert_true(file_commit(&f, NULL));
    assert_string_equal(file_read(&a, in_folder("a"), 99, &size, NULL), "new one");
    assert_int_equal(names_in_folder(false), 1);
    arena_clear(&a);
}

TEST(a_discarded_output_leaves_nothing)
{
    output_file f;
    assert_true(file_create(&f, in_folder("a"), NULL));
    fputs("text", f.stream);
    file_discard(&f);
    assert_int_equal(names_in_folder(false), 0);
    file_discard(&f); /* twice does no harm */
}

TEST(two_outputs_of_one_name_do_not_meet)
{
    arena a = { 0 };
    output_file f, g;
    size_t size;
    assert_true(file_create(&f, in_folder("a"), NULL));
    assert_true(file_create(&g, in_folder("a"), NULL));
    assert_string_not_equal(f.temporary, g.temporary);
    fputs("f", f.stream);
    fputs("g", g.stream);
    assert_true(file_commit(&g, NULL));
    assert_true(file_commit(&f, NULL));
    assert_string_equal(file_read(&a, in_folder("a"), 99, &size, NULL), "f");
    assert_int_equal(names_in_folder(false), 1);
    arena_clear(&a);
}

TEST(a_reserved_name_is_free_and_is_committed)
{
    output_file f;
    lux_error err = { 0 };
    assert_true(file_reserve(&f, in_folder("a"), NULL));
    assert_null(f.stream);
    assert_int_equal(names_in_folder(false), 0);
    put(f.temporary, "by others");
    assert_true(file_commit(&f, NULL));
    assert_int_equal(access(in_folder("a"), F_OK), 0);
    assert_int_equal(names_in_folder(false), 1);

    assert_true(file_reserve(&f, in_folder("b"), NULL)); /* nobody writes it */
    assert_false(file_commit(&f, &err));
    assert_int_equal(err.code, ERR_IO);
}

TEST(the_longest_name_that_the_system_takes_is_written)
{
    char name[256];
    memset(name, 'n', 255);
    name[255] = '\0';
    output_file f;
    assert_true(file_create(&f, in_folder(name), NULL));
    assert_true(file_commit(&f, NULL));
    assert_int_equal(access(in_folder(name), F_OK), 0);
}

static void assert_create_fails(const char *path, const char *why)
{
    lux_error err = { 0 };
    output_file f;
    assert_false(file_create(&f, path, &err));
    assert_int_equal(err.code, ERR_IO);
    char want[600];
    snprintf(want, sizeof want, "%s: %s", path, why);
    assert_string_equal(err.text, want);
    assert_false(file_reserve(&f, path, NULL));
}

TEST(places_that_cannot_be_written_are_refused)
{
    assert_create_fails(folder, "cannot write: is a folder");
    assert_create_fails(in_folder("none/a"), "cannot write: no such folder");
    assert_create_fails(in_folder("none/"), "is not the name of a file");
    assert_create_fails("/dev/null", "cannot write: is not a regular file");
    assert_int_equal(names_in_folder(false), 0);
    if (access("/proc/1", F_OK) == 0) {
        lux_error err = { 0 };
        output_file f;
        assert_false(file_create(&f, "/proc/lux4", &err)); /* refuses root as well */
        assert_int_equal(err.code, ERR_IO);
    }
}

/* A limit on the size of files stands for the disk that is full. */
static void write_beyond_limit(size_t bytes, bool flushed, lux_error *err)
{
    struct rlimit before, limit;
    getrlimit(RLIMIT_FSIZE, &before);
    limit          = before;
    limit.rlim_cur = 10000;
    signal(SIGXFSZ, SIG_IGN);
    output_file f;
    bool created = file_create(&f, in_folder("a"), NULL);
    setrlimit(RLIMIT_FSIZE, &limit);
    for (size_t i = 0; created && i < bytes; i++)
        putc('x', f.stream);
    if (flushed)
        fflush(f.stream);
    bool committed = created && file_commit(&f, err);
    setrlimit(RLIMIT_FSIZE, &before);
    assert_true(created);
    assert_false(committed);
}

TEST(a_full_disk_is_an_error_and_leaves_the_old_file)
{
    for (int round = 0; round < 3; round++) {
        lux_error err = { 0 };
        put(in_folder("a"), "old");
        write_beyond_limit(round ? 100000 : 10001, round == 2, &err);
        assert_int_equal(err.code, ERR_IO);
        assert_non_null(strstr(err.text, "/a: cannot write: "));
        assert_int_equal(names_in_folder(false), 1);
        arena a = { 0 };
        size_t size;
        assert_string_equal(file_read(&a, in_folder("a"), 99, &size, NULL), "old");
        arena_clear(&a);
    }
}

TEST(folders_are_made_with_those_above_them)
{
    lux_error err = { 0 };
    assert_true(folder_make(in_folder("x/y//z/"), NULL));
    assert_true(folder_make(in_folder("x/y/z"), NULL));
    assert_true(folder_make("/", NULL));
    assert_true(folder_make("", NULL));
    put(in_folder("x/a"), "");
    assert_false(folder_make(in_folder("x/a/b"), &err));
    assert_non_null(strstr(err.text, "x/a: is a file, a folder was expected"));
    assert_false(folder_make(in_folder("x/a"), &err));
    remove(in_folder("x/y/z"));
    remove(in_folder("x/y"));
    remove(in_folder("x/a"));
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, make_folder, remove_folder)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(a_file_is_read_whole_with_a_nul_behind_it),
        IN_FOLDER(what_cannot_be_read_is_refused_by_name),
        IN_FOLDER(devices_and_pipes_are_refused_without_waiting),
        IN_FOLDER(a_file_larger_than_its_size_says_is_refused),
        IN_FOLDER(no_memory_for_a_file_is_an_error),
        IN_FOLDER(an_output_appears_when_it_is_committed),
        IN_FOLDER(a_discarded_output_leaves_nothing),
        IN_FOLDER(two_outputs_of_one_name_do_not_meet),
        IN_FOLDER(a_reserved_name_is_free_and_is_committed),
        IN_FOLDER(the_longest_name_that_the_system_takes_is_written),
        IN_FOLDER(places_that_cannot_be_written_are_refused),
        IN_FOLDER(a_full_disk_is_an_error_and_leaves_the_old_file),
        IN_FOLDER(folders_are_made_with_those_above_them),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
