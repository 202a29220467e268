/* tests/program.h -- the program as users run it: words in, exit code, output and files out. */
#ifndef TESTS_PROGRAM_H
#define TESTS_PROGRAM_H

#include <stdbool.h>
#include <stddef.h>

enum { MOST_WORDS = 32, CSV_COLUMNS = 10 };

typedef struct program_desc {
    const char *program;  /* NULL: the one that was built beside this test */
    const char *folder;   /* where it runs; NULL: here */
    const char *out;      /* a file that stdout goes to, "" for a closed one; NULL: captured */
    long most_file_bytes; /* RLIMIT_FSIZE; 0: no limit */
    const char *until;    /* it is interrupted when this file is there ... */
    double then_s;        /* ... and this many seconds have passed; NULL: it is not */
    bool twice;           /* interrupted again, as fast as can be */
    int user;             /* as whom it runs; 0: as ourselves */
    const char *words[MOST_WORDS]; /* ends with NULL */
} program_desc;

typedef struct program_result {
    int code; /* its exit code, or minus the signal that ended it */
    char *out, *err;
    double seconds;
} program_result;

/* Runs it. The test fails if it takes more than 30 s (as built for a sanitizer: 150 s), or if a
 * sanitizer complains. What r holds is freed by program_free(), or by the next run into it. */
void program_run(const program_desc *d, program_result *r);
void program_free(program_result *r);

/* lux4 of these words, run in a folder; the test fails if it does not exit with `code`. */
#define LUX4(folder_, code_, r_, ...)                                                              \
    program_expect(code_, &(program_desc){ .folder = (folder_), .words = { __VA_ARGS__ } }, r_)
void program_expect(int code, const program_desc *d, program_result *r);

/* lux4 fails with this exit code, prints no result, and says why in the one line on stderr, which
 * begins with "lux4: " and holds `says`. */
#define LUX4_FAILS(folder_, code_, says_, ...)                                                     \
    program_fails(code_, says_, &(program_desc){ .folder = (folder_), .words = { __VA_ARGS__ } })
void program_fails(int code, const char *says, const program_desc *d);

/* Fails the test unless stderr is one line, "lux4: ...", that holds `says`, behind any warnings. */
void assert_one_line(const program_result *r, const char *says);

/* The root of the project, and of what was built: both absolute. */
const char *project_root(void);
const char *build_folder(void);

/* ---- files that it leaves -------------------------------------------------------------------- */

/* A new folder (folder.h) that holds study.yaml. */
char *folder_of_study(const char *yaml);

/* FOLDER/NAME; good for the next seven calls. */
const char *path_in(const char *folder, const char *name);

bool there_is(const char *folder, const char *name);

/* How many names a folder holds, hidden ones too; 0 if there is no such folder. */
int count_names(const char *folder);

/* All its bytes with a '\0' behind; the test fails if it cannot be read. To be freed. */
char *bytes_of(const char *path, size_t *size);

void assert_same_bytes(const char *path, const char *other);
bool same_bytes(const char *path, const char *other);

/* Rows of a grid's CSV, `most` at most: fails the test unless header and numbers are as the
 * contract has them (finite; light not negative; illuminance the sum of its parts). */
typedef struct csv {
    double row[4096][CSV_COLUMNS];
    int count;
    bool partial;
} csv;
void csv_read(const char *path, csv *out);

enum { X, Y, Z, NX, NY, NZ, ALL, DIRECT, INDIRECT, HALF_WIDTH }; /* columns */

/* ---- JSON ------------------------------------------------------------------------------------ */

/* Whether text is one JSON value (RFC 8259) and white space. */
bool json_is_valid(const char *text);

/* The value at "grids.0.name" in valid JSON, as text from there on; NULL if there is none. */
const char *json_at(const char *text, const char *path);

/* The same as a number; the test fails if there is none. */
double json_number_at(const char *text, const char *path);

#endif
