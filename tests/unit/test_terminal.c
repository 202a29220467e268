/* tests/unit/test_terminal.c -- the progress line says what it should and fits the terminal. */
#define _GNU_SOURCE
#include "sim/terminal.h"
#include "tests/test.h"

#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <unistd.h>

static const double NOT_YET = (double)NAN;

static const char *line(int columns, double share, double accuracy, double elapsed)
{
    static char text[256];
    terminal_line(text, sizeof text, columns, "view", share, accuracy, elapsed);
    return text;
}

static void assert_line(const char *want, double share, double accuracy, double elapsed)
{
    assert_string_equal(line((int)strlen(want) + 1, share, accuracy, elapsed), want);
}

TEST(the_line_shows_share_times_and_accuracy)
{
    assert_line("view [##------]  25%  1:00, 3:00 left, accuracy 14%", 0.25, 14.0, 60.0);
}

TEST(what_is_not_known_yet_is_not_said)
{
    assert_line("view [-----------------]   0%  0:03", 0.0, NOT_YET, 3.0);
}

TEST(hours_are_shown_as_hours)
{
    assert_non_null(strstr(line(80, 0.5, 0.5, 7265.0), "2:01:05, 2:01:05 left, accuracy 0.5%"));
}

TEST(the_line_fits_whatever_the_width)
{
    for (int columns = -1; columns < 300; columns++) {
        size_t length = strlen(line(columns, 0.33, 1.5, 1e9));
        assert_true(length <= (columns > 1 ? (size_t)columns - 1 : 0));
        assert_true(length < 256);
    }
    assert_true(strlen(line(80, NOT_YET, NOT_YET, 0.0)) < 80);
}

TEST(nothing_is_drawn_where_there_is_no_terminal)
{
    terminal t = { 0 };
    progress p = terminal_progress(&t, NULL);
    assert_null(p.draw);
    progress_begin(&p, "view");
    terminal_clear(&t);
    assert_null(terminal_open(true).stream);
}

TEST(the_line_is_drawn_on_a_terminal_and_cleared)
{
    int master = posix_openpt(O_RDWR | O_NOCTTY);
    if (master < 0 || grantpt(master) || unlockpt(master))
        skip();
    FILE *f          = fopen(ptsname(master), "r+");
    struct winsize w = { .ws_row = 24, .ws_col = 30 };
    if (!f || ioctl(fileno(f), TIOCSWINSZ, &w))
        skip();
    terminal t = { .stream = f };
    progress p = terminal_progress(&t, NULL);
    progress_begin(&p, "view");
    terminal_clear(&t);
    terminal_clear(&t); /* nothing is there any more */

    char got[256] = "";
    ssize_t n     = read(master, got, sizeof got - 1);
    assert_true(n > 0);
    const char *want = "\rview [-----------]   0%  0:00\033[K\r\033[K";
    for (ssize_t more = 0; (size_t)n < strlen(want) && (more = read(master, got + n, 8)) > 0;)
        n += more;
    assert_string_equal(got, want);
    fclose(f);
    close(master);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_line_shows_share_times_and_accuracy),
        cmocka_unit_test(what_is_not_known_yet_is_not_said),
        cmocka_unit_test(hours_are_shown_as_hours),
        cmocka_unit_test(the_line_fits_whatever_the_width),
        cmocka_unit_test(nothing_is_drawn_where_there_is_no_terminal),
        cmocka_unit_test(the_line_is_drawn_on_a_terminal_and_cleared),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
