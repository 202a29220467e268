/* tests/unit/test_probes.c -- tables of sensors, good and broken. */
#include "sim/probes.h"
#include "tests/test.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static arena memory;

static int forget(void **state)
{
    (void)state;
    arena_clear(&memory);
    return 0;
}

static probes good(const char *text)
{
    lux_error err = { 0 };
    probes p      = { 0 };
    if (!probes_parse(&memory, "p.csv", text, &p, &err))
        fail_msg("%s", err.text);
    return p;
}

TEST(rows_are_places_and_unit_normals)
{
    probes p = good("x,y,z,nx,ny,nz\n1,2.5,-3e1,0,0,1\n4,5,6,3,0,-4\n");
    assert_int_equal(p.count, 2);
    assert_true(p.position[0].x == 1.0 && p.position[0].y == 2.5 && p.position[0].z == -30.0);
    assert_true(p.normal[0].x == 0.0 && p.normal[0].y == 0.0 && p.normal[0].z == 1.0);
    assert_near(p.normal[1].x, 0.6, 1e-15);
    assert_near(p.normal[1].z, -0.8, 1e-15);
}

TEST(columns_stand_in_any_order)
{
    probes p = good("nz, ny ,nx,z,y,x\n1,2,3,4,5,6");
    assert_int_equal(p.count, 1);
    assert_true(p.position[0].x == 6.0 && p.position[0].y == 5.0 && p.position[0].z == 4.0);
    assert_near(p.normal[0].x, 3.0 / sqrt(14.0), 1e-15);
    assert_near(p.normal[0].y, 2.0 / sqrt(14.0), 1e-15);
}

TEST(spaces_comments_blank_lines_and_crlf_are_passed_over)
{
    probes p = good("\xef\xbb\xbf# probes\r\n\r\n  x , y,z,nx,ny, nz \r\n \t \r\n"
                    " 1 ,\t2, 3,0,0 , 1 \r\n# 9,9\r\n  # 8\r\n4,5,6,0,0,1\r\n\r\n");
    assert_int_equal(p.count, 2);
    assert_true(p.position[0].y == 2.0 && p.position[1].x == 4.0);
}

TEST(tiny_and_huge_normals_are_directions)
{
    probes p = good("x,y,z,nx,ny,nz\n0,0,0,3e-200,4e-200,0\n0,0,0,3e11,0,4e11\n");
    assert_near(p.normal[0].y, 0.8, 1e-15);
    assert_near(p.normal[1].z, 0.8, 1e-15);
}

TEST(broken_tables_are_refused_with_line_and_column)
{
    static const struct {
        const char *text, *says;
    } table[] = {
        { "", "p.csv: nothing in it, expected a row x,y,z,nx,ny,nz" },
        { "\n# x\n", "p.csv: nothing in it, expected a row x,y,z,nx,ny,nz" },
        { "1,2,3,0,0,1\n",
          "p.csv:1:1: expected each of the columns x,y,z,nx,ny,nz once, found `1`" },
        { "x,y,z,nx,ny,nZ\n",
          "p.csv:1:13: expected each of the columns x,y,z,nx,ny,nz once, found `nZ`" },
        { "x,y,x,nx,ny,nz\n",
          "p.csv:1:5: expected each of the columns x,y,z,nx,ny,nz once, found `x`" },
        { "x,y,z,nx,ny\n",
          "p.csv:1:12: expected a comma (columns x,y,z,nx,ny,nz), found the end of "
          "the line" },
        { "x,y,z,nx,ny,nz,e\n",
          "p.csv:1:15: expected the end of the line after six columns, found nothing before the "
          "comma" },
        { "x,y,z,nx,ny,nz\n", "p.csv: no row below the header, expected at least one" },
        { "x,y,z,nx,ny,nz\n1,2,3,0,0\n",
          "p.csv:2:10: expected a comma (columns x,y,z,nx,ny,nz), found the end of the line" },
        { "x,y,z,nx,ny,nz\n1,2,3,0,0,1,7\n",
          "p.csv:2:12: expected the end of the line after six columns, found nothing before the "
          "comma" },
        { "x,y,z,nx,ny,nz\n1,2,3,0,0,1\n1, abc,3,0,0,1\n",
          "p.csv:3:4: expected a number, found `abc`" },
        { "x,y,z,nx,ny,nz\n1,,3,0,0,1\n",
          "p.csv:2:3: expected a number, found nothing before the comma" },
        { "x,y,z,nx,ny,nz\n1,2x,3,0,0,1\n", "p.csv:2:3: expected a number, found `2x`" },
        { "x,y,z,nx,ny,nz\n1,\"2\",3,0,0,1\n", "p.csv:2:3: expected a number, found `\"2\"`" },
        { "x,y,z,nx,ny,nz\n1;2;3;0;0;1\n", "p.csv:2:1: expected a number, found `1;2;3;0;0;1`" },
        { "x,y,z,nx,ny,nz\n1,nan,3,0,0,1\n", "p.csv:2:3: expected a number, found `nan`" },
        { "x,y,z,nx,ny,nz\n1,inf,3,0,0,1\n", "p.csv:2:3: expected a number, found `inf`" },
        { "x,y,z,nx,ny,nz\n1,0x1,3,0,0,1\n", "p.csv:2:3: expected a number, found `0x1`" },
        { "x,y,z,nx,ny,nz\n1,1e999,3,0,0,1\n", "p.csv:2:3: expected a number, found `1e999`" },
        { "x,y,z,nx,ny,nz\n1,2e12,3,0,0,1\n",
          "p.csv:2:3: expected a number of at most 1e12, found `2e12`" },
        { "x,y,z,nx,ny,nz\n1,2,3,0,0,0\n", "p.csv:2:1: the normal has no length" },
        { "x,y,z,nx,ny,nz\n1,2,3,0,-0.0,1e-320\n", "p.csv:2:1: the normal has no length" },
        { "x,y,z,nx,ny,nz\n1,\x1b[31m,3,0,0,1\n", "p.csv:2:3: expected a number, found `?[31m`" },
        { "x,y,z,nx,ny,nz\naaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaaa,2",
          "p.csv:2:1: expected a number, found `aaaaaaaaaaaaaaaaaaaaaaa`" },
    };
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) {
        lux_error err = { 0 };
        probes p;
        assert_false(probes_parse(&memory, "p.csv", table[i].text, &p, &err));
        assert_string_equal(err.text, table[i].says);
        assert_int_equal(err.code, ERR_FORMAT);
    }
}

TEST(a_table_cut_or_bent_anywhere_is_read_or_refused)
{
    static const char whole[] = "# c\nx,y,z,nx,ny,nz\r\n1, 2.5,3,0,0,1\n\n-1e1,.5,5.,0,3,4\n";
    for (size_t size = 0; size < sizeof whole; size++)
        for (int bend = 0; bend < 256; bend += 5) {
            char *text    = calloc(sizeof whole + 1, 1); /* its own, for the sanitizer */
            lux_error err = { 0 };
            probes p;
            memcpy(text, whole, sizeof whole);
            text[size] = (char)bend;
            if (!probes_parse(&memory, "p.csv", text, &p, &err))
                assert_true(!strncmp(err.text, "p.csv:", 6) && !strpbrk(err.text, "\n\r\x1b"));
            free(text);
            arena_clear(&memory);
        }
}

TEST(more_than_four_million_rows_are_refused)
{
    static const char row[] = "0,0,0,0,0,1\n";
    size_t step = strlen(row), rows = 4000001;
    char *text = malloc(16 + rows * step);
    strcpy(text, "x,y,z,nx,ny,nz\n");
    for (size_t i = 0; i < rows; i++)
        memcpy(text + 15 + i * step, row, step + 1);
    lux_error err = { 0 };
    probes p;
    assert_false(probes_parse(&memory, "p.csv", text, &p, &err));
    assert_string_equal(err.text, "p.csv:4000002:1: more than 4000000 rows");
    free(text);
}

TEST(files_are_read_and_those_that_are_none_refused)
{
    lux_error err = { 0 };
    probes p      = { 0 };
    assert_false(probes_read(&memory, "tests", &p, &err));
    assert_int_equal(err.code, ERR_IO);
    assert_false(probes_read(&memory, "tests/no-such.csv", &p, &err));
    assert_int_equal(err.code, ERR_IO);

    char path[] = "/tmp/lux4-probes-XXXXXX";
    int file    = mkstemp(path);
    assert_true(write(file, "x,y,z,nx,ny,nz\n1,2,3,0,0,1\n", 27) == 27);
    assert_true(probes_read(&memory, path, &p, &err));
    assert_int_equal(p.count, 1);
    assert_true(write(file, "\0", 1) == 1);
    assert_false(probes_read(&memory, path, &p, &err));
    assert_non_null(strstr(err.text, ": a NUL byte, expected text"));
    close(file);
    unlink(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_teardown(rows_are_places_and_unit_normals, forget),
        cmocka_unit_test_teardown(columns_stand_in_any_order, forget),
        cmocka_unit_test_teardown(spaces_comments_blank_lines_and_crlf_are_passed_over, forget),
        cmocka_unit_test_teardown(tiny_and_huge_normals_are_directions, forget),
        cmocka_unit_test_teardown(broken_tables_are_refused_with_line_and_column, forget),
        cmocka_unit_test_teardown(a_table_cut_or_bent_anywhere_is_read_or_refused, forget),
        cmocka_unit_test_teardown(more_than_four_million_rows_are_refused, forget),
        cmocka_unit_test_teardown(files_are_read_and_those_that_are_none_refused, forget),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
