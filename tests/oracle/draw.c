// SPDX-License-Identifier: MIT
// Draws a picture with the oracle on all processors. Each thread repeatedly takes the next row, and
// pixels are independent.
#include "oracle/oracle.h"

#include <pthread.h>
#include <stdatomic.h>
#include <unistd.h>

#define THREADS_MAX 64

typedef struct {
    const OracleView *view;
    uint32_t samples, step;
    Framebuffer *framebuffer;
    atomic_uint next_row;
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

static void *draw_rows(void *context)
{
    Drawing *drawing = context;
    const uint32_t width = drawing->framebuffer->width, height = drawing->framebuffer->height;
    for (;;) {
        const uint32_t row = atomic_fetch_add(&drawing->next_row, 1);
        if (row >= height)
            return NULL;
        for (uint32_t column = 0; column < width; column++)
            draw_pixel(drawing, column, row,
                       drawing->framebuffer->pixels[(size_t)row * width + column]);
    }
}

bool oracle_draw(const OracleView *view, uint32_t samples, uint32_t step, Framebuffer *framebuffer,
                 Error *error)
{
    const uint32_t width = (view->width + step - 1) / step;
    const uint32_t height = (view->height + step - 1) / step;
    if (!framebuffer_make(framebuffer, width, height, error))
        return false;
    Drawing drawing = {.view = view, .samples = samples, .step = step, .framebuffer = framebuffer};
    pthread_t threads[THREADS_MAX];
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    int started = 0;
    while (started < processors - 1 && started < THREADS_MAX &&
           pthread_create(&threads[started], NULL, draw_rows, &drawing) == 0)
        started++;
    draw_rows(&drawing);
    while (started > 0)
        pthread_join(threads[--started], NULL);
    return true;
}
