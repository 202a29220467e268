/* tests/unit/test_photometry_files.c -- no photometric file, however broken, does harm. */
#include "tests/photometry_reading.h"

#include <dirent.h>
#include <stdio.h>
#include <strings.h>
#include <unistd.h>

static void check_finite(const photometry *p)
{
    for (int i = 0; i < p->plane_count * p->gamma_count; i++)
        assert_true(p->candela[i] >= 0.0f && p->candela[i] < INFINITY);
    for (int i = 0; i < p->plane_count; i++)
        assert_true(p->plane_deg[i] >= (i ? nextafterf(p->plane_deg[i - 1], 999) : 0.0f) &&
                    p->plane_deg[i] < 360.0f);
    photometry_figures f = photometry_figure(p, "t", &r.n);
    const double all[]   = { p->luminaire_lumens, p->lamp_lumens, p->watts,
                             f.maximum_cd,        f.lor,          f.lor_up,
                             f.efficacy,          f.beam_deg[0],  f.beam_deg[1],
                             f.field_deg[0],      f.field_deg[1], f.flux_code[0],
                             f.flux_code[3],      f.flux_code[4] };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++)
        assert_true(all[i] >= 0.0 && all[i] < HUGE_VAL);
}

/* What is done with each file at hand: p is NULL where it was refused. */
typedef void visitor(const char *path, const photometry *p, void *sum);

/* Visits the photometric files of the folders; false if one is not there. */
static bool visit_files(visitor *visit, void *sum)
{
    const char *folders[] = { "../shared/data/ies", "../shared/data/ldt",
                              "../shared/data/gltf/babylon_EXT_lights_ies" };
    for (int i = 0; i < 3; i++) {
        DIR *d = opendir(folders[i]);
        if (!d)
            return false;
        for (struct dirent *e; (e = readdir(d));) {
            char path[1024];
            const char *dot = strrchr(e->d_name, '.');
            snprintf(path, sizeof path, "%s/%s", folders[i], e->d_name);
            if (!dot || dot == e->d_name || (strcasecmp(dot, ".ies") && strcasecmp(dot, ".ldt")))
                continue;
            finish(NULL);
            r.n.a = &r.a;
            r.p   = photometry_read(&r.a, path, &r.n, &r.err);
            visit(path, r.p, sum);
        }
        closedir(d);
    }
    return true;
}

/* A refusal has a line and column: "path:3:1: found". */
static void check_read(const char *path, const photometry *p, void *sum)
{
    int *counts = sum, line, column;
    counts[p ? 0 : 1]++;
    if (p)
        check_finite(p);
    else if (strncmp(r.err.text, path, strlen(path)) ||
             sscanf(r.err.text + strlen(path), ":%d:%d: found", &line, &column) != 2)
        fail_msg("%s", r.err.text);
}

TEST(every_file_at_hand_is_read_or_refused_with_a_reason)
{
    int counts[2] = { 0 };
    if (!visit_files(check_read, counts))
        skip();
    assert_true(counts[0] >= 150 && counts[1] <= 2);
}

/* The opening's extent along C0, along C90 and down. */
static void extent(const photometry *p, float out[3])
{
    bool along = p->length_along_deg == 0.0f;
    out[0]     = along ? p->length : p->width;
    out[1]     = along ? p->width : p->length;
    out[2]     = p->height;
}

/* Whether EULUMDAT has a word for the opening; where it has none, sizes are still the same. */
static bool is_round_only_in_ies(const photometry *p)
{
    bool round = p->opening == OPENING_DISC || p->opening == OPENING_VERTICAL_CYLINDER;
    return p->opening >= OPENING_SPHERE || (round && p->length != p->width);
}

/* Candelas to the 9 digits that are written and the rounding of floats. */
static void check_round_trip(const char *path, const photometry *p, void *sum)
{
    int *count = sum;
    for (int ldt = 0; p && ldt < 2; ldt++) {
        arena a         = { 0 };
        lux_error err   = { 0 };
        const char *out = ldt ? "build/real.ldt" : "build/real.ies";
        if (!photometry_write(p, out, NULL, &err))
            fail_msg("%s", err.text);
        const photometry *q = photometry_read(&a, out, NULL, &err);
        if (!q)
            fail_msg("%s as %s: %s", path, out, err.text);
        double most = photometry_figure(p, path, NULL).maximum_cd;
        for (int i = 0; i < p->plane_count; i++)
            for (int j = 0; j < p->gamma_count; j++) {
                double c = (double)p->plane_deg[i], g = (double)p->gamma_deg[j];
                double is = photometry_candela(q, c, g), was = photometry_candela(p, c, g);
                if (!(fabs(is - was) <= 1e-6 * most))
                    fail_msg("%s as %s: %g cd at %g, %g, not %g", path, out, is, c, g, was);
            }
        float before[3], after[3];
        extent(p, before), extent(q, after);
        for (int k = 0; k < 3; k++)
            assert_near(after[k], before[k], 1e-6);
        if (!ldt || !is_round_only_in_ies(p))
            if (q->opening != p->opening && q->opening != OPENING_CYLINDER_ACROSS)
                fail_msg("%s as %s: a %s", path, out, opening_shape_name(q->opening));
        assert_near(q->luminaire_lumens, p->luminaire_lumens, 1e-6);
        assert_near(q->lamp_lumens, p->lamp_lumens, 1e-6);
        assert_near(q->watts, p->watts, 1e-6);
        arena_clear(&a);
        unlink(out);
        ++*count;
    }
}

TEST(every_file_at_hand_is_the_same_when_written_and_read_again)
{
    int count = 0;
    if (!visit_files(check_round_trip, &count))
        skip();
    assert_true(count >= 300);
}

/* Each text cut at each byte, and with each byte changed in three ways. */
TEST(cut_and_changed_texts_never_crash)
{
    const char *texts[] = {
        "IESNA:LM-63-1995\n[MANUFAC] a\nTILT=INCLUDE\n1 2 0 90 1 1\n1 -1 1 3 3 1 1 0 -1 0 1 1 9\n0 "
        "45 "
        "90\n0 45 90\n9 8 7\n6 5 4\n3 2 1\n",
        "IESNA:LM-63-2002\nTILT=NONE\n1 -1 1 3 3 3 2 0 0 0 1 1 1\n-90 0 90\n-90 0 90\n1 2 3 4 5 6 "
        "7 8 9",
        "Co\n2\n2\n4\n90\n3\n45\nR\nN\n1\nf\nd\n1\n0\n1\n9\n0\n0\n0\n0\n0\n1\n1\n1\n0\n1\n1\nL\n9\n"
        "3\n8\n5\n"
        "0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n0\n90\n180\n270\n0\n45\n90\n9\n8\n7\n6,5\n5\n4\n3\n2\n1\n",
    };
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        size_t size = strlen(texts[i]);
        char copy[1024];
        assert_non_null(read_text(texts[i]));
        for (size_t k = 0; k < size; k++) {
            if (read_bytes(texts[i], k))
                check_finite(r.p);
            const int flips[] = { 0x01, 0x10, 0x80 };
            for (int f = 0; f < 3; f++) {
                memcpy(copy, texts[i], size);
                copy[k] = (char)(copy[k] ^ flips[f]);
                if (read_bytes(copy, size))
                    check_finite(r.p);
                else
                    assert_true(r.err.text[0] != '\0');
            }
        }
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_file_at_hand_is_read_or_refused_with_a_reason),
        cmocka_unit_test(every_file_at_hand_is_the_same_when_written_and_read_again),
        cmocka_unit_test(cut_and_changed_texts_never_crash),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
