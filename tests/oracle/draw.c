// SPDX-License-Identifier: MIT
// Draws a picture with the oracle on all processors, row by row.
#include "oracle/oracle.h"

#include "base/thread_pool.h"

typedef struct {
    const OracleView *view;
    uint32_t samples, step;
    Framebuffer *framebuffer;
} Drawing;

static void draw_pixel(const Drawing *drawing, uint32_t column, uint32_t row, float pixel[3])
{
    const uint32_t samples = drawing->samples;
    Vec3 sum = {0, 0, 0};
    for (uint32_t sample = 0; sample < samples * samples; sample++) {
        const double x = column * drawing->step + (sample % samples + 0.5) / samples;
        const double y = row * drawing->step + (sample / samples + 0.5) / samples;
        sum = vec3_add(sum, oracle_sample(drawing->view, x, y).color);
    }
    const double count = (double)samples * samples;
    pixel[0] = (float)(sum.x / count);
    pixel[1] = (float)(sum.y / count);
    pixel[2] = (float)(sum.z / count);
}

static void draw_row(void *context, uint32_t row)
{
    const Drawing *drawing = context;
    const uint32_t width = drawing->framebuffer->width;
    for (uint32_t column = 0; column < width; column++)
        draw_pixel(drawing, column, row,
                   drawing->framebuffer->pixels[(size_t)row * width + column]);
}

bool oracle_draw(const OracleView *view, uint32_t samples, uint32_t step, Framebuffer *framebuffer,
                 Error *error)
{
    const uint32_t width = (view->width + step - 1) / step;
    const uint32_t height = (view->height + step - 1) / step;
    if (!framebuffer_make(framebuffer, width, height, error))
        return false;
    Drawing drawing = {.view = view, .samples = samples, .step = step, .framebuffer = framebuffer};
    ThreadPool *pool = thread_pool_open(0);
    thread_pool_run(pool, height, draw_row, &drawing);
    thread_pool_close(pool);
    return true;
}
