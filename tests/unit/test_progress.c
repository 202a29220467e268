/* tests/unit/test_progress.c -- progress is drawn in order, now and then, by one thread at a time.
 */
#include "core/parallel.h"
#include "core/progress.h"
#include "tests/test.h"

#include <string.h>
#include <time.h>

typedef struct log {
    int draws, inside, overlaps;
    double share;
    const char *label;
    double accuracy;
} log_book;

static void write_down(void *context, const char *label, double share, double accuracy_percent)
{
    log_book *l = context;
    l->overlaps += __atomic_add_fetch(&l->inside, 1, __ATOMIC_RELAXED) > 1;
    __atomic_add_fetch(&l->draws, 1, __ATOMIC_RELAXED);
    assert_true(share >= l->share || label != l->label);
    l->share    = share;
    l->label    = label;
    l->accuracy = accuracy_percent;
    __atomic_sub_fetch(&l->inside, 1, __ATOMIC_RELAXED);
}

static double now_s(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

TEST(without_a_drawer_nothing_happens)
{
    progress p = { 0 };
    progress_begin(NULL, "a");
    progress_update(NULL, 0.5, 1.0);
    progress_begin(&p, "a");
    progress_update(&p, 0.5, 1.0);
    assert_false(progress_stopped(NULL));
    assert_false(progress_stopped(&p));
}

TEST(a_stage_is_drawn_as_it_begins)
{
    log_book l = { .share = 1.0 };
    progress p = { .draw = write_down, .context = &l };
    progress_begin(&p, "grid");
    assert_int_equal(l.draws, 1);
    assert_true(l.share == 0.0 && isnan(l.accuracy));
    assert_string_equal(l.label, "grid");
    progress_update(&p, 0.5, 1.0); /* too early */
    assert_int_equal(l.draws, 1);
    p.due_ms = 0; /* as if time had passed */
    progress_update(&p, 0.5, 1.5);
    assert_true(l.share == 0.5 && l.accuracy == 1.5);
    p.due_ms = 0;
    progress_update(&p, 0.4, 1.0); /* a thread that is behind */
    assert_int_equal(l.draws, 2);
    progress_update(&p, 7.0, 1.0);
    assert_true(l.share == 1.0);
    progress_begin(&p, "view");
    assert_true(l.share == 0.0);
}

typedef struct crowd {
    progress *p;
    const log_book *l;
    double end_s;
} crowd;

static void update_until_drawn(void *context, int item, int thread)
{
    crowd *c = context;
    (void)item, (void)thread;
    while (__atomic_load_n(&c->l->draws, __ATOMIC_RELAXED) < 4 && now_s() < c->end_s)
        progress_update(c->p, 0.5, 1.0);
}

TEST(many_threads_draw_one_at_a_time_and_ten_times_a_second)
{
    log_book l     = { 0 };
    progress p     = { .draw = write_down, .context = &l };
    double began_s = now_s();
    crowd c        = { &p, &l, began_s + 10.0 };
    progress_begin(&p, "crowd");
    parallel_for(4, 4, update_until_drawn, &c, NULL);
    assert_int_equal(l.overlaps, 0);
    assert_int_equal(l.draws, 4); /* the beginning and three more, 0.1 s after each other */
    assert_true(now_s() - began_s >= 0.29);
}

TEST(a_stop_is_seen)
{
    volatile bool stop = false;
    progress p         = { .stop = &stop };
    assert_false(progress_stopped(&p));
    stop = true;
    assert_true(progress_stopped(&p));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_drawer_nothing_happens),
        cmocka_unit_test(a_stage_is_drawn_as_it_begins),
        cmocka_unit_test(many_threads_draw_one_at_a_time_and_ten_times_a_second),
        cmocka_unit_test(a_stop_is_seen),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
