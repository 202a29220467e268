/* tests/unit/test_photometry_files.c -- no photometric file, however broken, does harm. */
#include "tests/photometry_reading.h"

#include <dirent.h>
#include <stdio.h>

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

/* None of some 150 public files crashes; what is read is finite. */
TEST(every_file_at_hand_is_read_or_refused)
{
    const char *folders[] = { "../shared/data/ies", "../shared/data/ldt" };
    int read = 0, refused = 0;
    for (int i = 0; i < 2; i++) {
        DIR *d = opendir(folders[i]);
        if (!d)
            skip();
        for (struct dirent *e; (e = readdir(d));) {
            char path[1024];
            snprintf(path, sizeof path, "%s/%s", folders[i], e->d_name);
            if (e->d_name[0] == '.')
                continue;
            finish(NULL);
            r.n.a = &r.a;
            r.p   = photometry_read(&r.a, path, &r.n, &r.err);
            read += r.p != NULL;
            refused += r.p == NULL;
            assert_true(r.p || strstr(r.err.text, path));
            if (r.p)
                check_finite(r.p);
        }
        closedir(d);
    }
    assert_true(read >= 150 && refused <= 2);
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
        cmocka_unit_test(every_file_at_hand_is_read_or_refused),
        cmocka_unit_test(cut_and_changed_texts_never_crash),
    };
    return cmocka_run_group_tests(tests, NULL, finish);
}
