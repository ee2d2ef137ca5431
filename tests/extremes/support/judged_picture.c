// SPDX-License-Identifier: MIT
// By tests/image/comparison.h: a pixel may differ where the oracle sees why.
#include "judged_picture.h"

#include "check.h"
#include "image/comparison.h"
#include "report.h"

PictureJudgment picture_judge(const Studio *studio, const Scene *scene, const Scene *exact,
                              const PictureSettings *settings)
{
    Error error = {0};
    Oracle oracle;
    Framebuffer picture, expected;
    const RenderSettings *render = &settings->render;
    require(oracle_make(&oracle, exact, &error), &error);
    const OracleView view = oracle_view(&oracle, &exact->viewpoints.data[0], render->width,
                                        render->height, render->max_level);
    picture_draw(&picture, studio, scene, settings);
    require(oracle_draw(&view, render->samples, 1, &expected, &error), &error);
    const Comparison comparison = comparison_make(&view, &picture, &expected, 1);
    const PictureJudgment judgment = {(size_t)render->width * render->height, comparison.differing,
                                      comparison.unexplained, picture_count_faults(&picture)};
    if (comparison.unexplained > 0)
        comparison_print(&comparison, "oracle");
    framebuffer_free(&picture);
    framebuffer_free(&expected);
    oracle_free(&oracle);
    return judgment;
}

size_t picture_report(const char *test, const char *details, const Studio *studio,
                      const Scene *scene, const PictureSettings *settings)
{
    const PictureJudgment judgment = picture_judge(studio, scene, scene, settings);
    return picture_report_judgment(test, details, &judgment);
}

size_t picture_report_judgment(const char *test, const char *details,
                               const PictureJudgment *judgment)
{
    char all[160];
    snprintf(all, sizeof all, "%s at_edges=%zu", details,
             judgment->differing - judgment->unexplained);
    return report_case(test, all, judgment->pixels, judgment->unexplained + judgment->faults);
}
